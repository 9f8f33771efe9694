"""First stage of mend: untangling by a barrier that hardens step by step (Wilson 5.2.2).

Inverted hexes have a finite energy while delta > 0 (3.2). A falling epsilon gives delta^2 = epsilon (epsilon - worst),
worst being the least determinant of the mesh. At each delta a few Newton steps of all nodes lower the energy; sweeps of
local Newton steps then work around the hexes that are still inverted.
"""

from __future__ import annotations

from collections.abc import Generator
from dataclasses import dataclass

import numpy as np

from hexmend.arrays import mask
from hexmend.energy import MeshEnergy
from hexmend.iteration import Step
from hexmend.mesh.mesh import Mesh
from hexmend.quality import ElementQuality, measure
from hexmend.smoothers.mend.inversion import corners_of_inverted, count_inverted, recentre_far_nodes
from hexmend.smoothers.mend.local_sweeps import local_sweeps
from hexmend.smoothers.mend.newton_steps import NEWTON, NewtonConfig


@dataclass(frozen=True)
class UntanglingConfig:
    """Settings of the stage.

    Parameters
    ----------
    initial_epsilon, min_epsilon : float
        The first epsilon, and the one at which the stage ends, in cubes of the mean edge length, or with a target in
        the volumes that hexes are to have.
    reduction : float
        Factor from one epsilon to the next.
    max_delta : float
        In cubes of the mean edge length; beyond it the energy of a flat hex is that of a cube.
    newton_steps : int
        Most steps of all nodes at one delta: an accurate minimum is of no use while delta is large.
    sweeps : int
        Sweeps of local Newton steps at one delta.
    few : float
        Share of inverted hexes below which mainly local sweeps are used.
    few_sweeps, few_period : int
        Below that share: sweeps per delta; steps of all nodes only at each `few_period`-th delta without progress.
    patience, faceted_patience : int
        Number of successive deltas without progress after which the stage ends; the second on a faceted surface, where
        the boundary that is free in space repairs what is left.
    newton : NewtonConfig
        Of the steps of all nodes.
    """

    initial_epsilon: float = 0.03
    min_epsilon: float = 1e-9
    reduction: float = 0.7
    max_delta: float = 0.5
    newton_steps: int = 3
    sweeps: int = 10
    few: float = 0.003
    few_sweeps: int = 50
    few_period: int = 3
    patience: int = 14
    faceted_patience: int = 7
    newton: NewtonConfig = NEWTON


@dataclass(frozen=True, eq=False)
class Untangled:
    """Result of the stage.

    Parameters
    ----------
    points : (n, 3) float64
    quality : ElementQuality
        Of the hexes at these points.
    omitted : (m,) uint8
        Bit t set: corner tetrahedron t of the hex is inverted still, or locked; later energies omit it.
    """

    points: np.ndarray
    quality: ElementQuality
    omitted: np.ndarray

    def left(self, locked: np.ndarray, energy: MeshEnergy) -> int:
        """Return the number of hexes that are inverted still, without those that are locked (m,) uint8."""
        return energy.count(self.omitted & ~locked)


@dataclass(frozen=True, eq=False)
class _Iterate:
    """Nodes at x (n, 3), in mean edge lengths, the hexes that are inverted there, and the least relative determinant.

    Those of `where` (k,) are inverted, `inverted` of them by corners that count.
    """

    x: np.ndarray
    points: np.ndarray
    quality: ElementQuality
    where: np.ndarray
    inverted: int
    worst: float

    @classmethod
    def at(cls, x: np.ndarray, energy: MeshEnergy, locked: np.ndarray) -> _Iterate:
        points = energy.to_mesh_units(x)
        return cls.of(x, points, measure(points, energy.mesh.hexes), energy, locked)

    @classmethod
    def of(
        cls, x: np.ndarray, points: np.ndarray, quality: ElementQuality, energy: MeshEnergy, locked: np.ndarray
    ) -> _Iterate:
        own = where = np.flatnonzero(quality.inverted)
        if energy.ranks.count > 1:
            own = where[energy.counted[where]]
        count, worst = count_inverted(points, energy.mesh.hexes, locked, own, energy.hex_sizes)
        return cls(x, points, quality, where, energy.ranks.sum(count), energy.ranks.least(worst))


def untangle(
    mesh: Mesh, energy: MeshEnergy, locked: np.ndarray, config: UntanglingConfig
) -> Generator[Step, None, Untangled]:
    """Untangle what can be untangled.

    Parameters
    ----------
    mesh : Mesh
        Its points are where the stage begins.
    energy : MeshEnergy
        Of this mesh, the locked corners omitted.
    locked : (m,) uint8
        Corners that fixed nodes lock in inversion.
    config : UntanglingConfig

    Yields
    ------
    Step
        After each step of all nodes and after the sweeps at each delta.
    """
    quality = measure(mesh.points, mesh.hexes)
    points = recentre_far_nodes(mesh, quality)
    if energy.ranks.any(points is not mesh.points):
        points = energy.ranks.complete(np.array(points))
        quality = measure(points, mesh.hexes)
        yield Step(points, intermediate=True, quality=quality, norm=energy.norm)
    now = _Iterate.of(energy.to_edge_units(points), points, quality, energy, locked)
    del points, quality  # large meshes have no memory for what is no longer needed
    epsilon, fewest, idle = config.initial_epsilon, now.inverted, 0
    patience = config.faceted_patience if energy.faceted else config.patience
    while now.inverted and idle < patience and epsilon > config.min_epsilon:
        worst = min(now.worst, 0.0)
        delta = min(config.max_delta, float(np.sqrt(epsilon * (epsilon - worst))))
        few = now.inverted < config.few * energy.n_hexes
        if not few or idle % config.few_period == config.few_period - 1:
            steps = _newton_steps(now, energy, locked, delta, config)
            del now
            now = yield from steps
        if now.inverted:
            sweeps = config.few_sweeps if few else config.sweeps
            x = local_sweeps(energy, now.x, mask(now.where, mesh.n_hexes), locked, delta, sweeps)
            now = _Iterate.at(x, energy, locked)
            diagnostics = {"delta": delta, "sweeps": sweeps}
            yield Step(now.points, diagnostics, intermediate=True, quality=now.quality, norm=energy.norm)
        idle = 0 if now.inverted < fewest else idle + 1
        fewest = min(fewest, now.inverted)
        epsilon *= config.reduction
    return Untangled(now.points, now.quality, corners_of_inverted(now.points, mesh.hexes, now.where) | locked)


def _newton_steps(
    now: _Iterate, energy: MeshEnergy, locked: np.ndarray, delta: float, config: UntanglingConfig
) -> Generator[Step, None, _Iterate]:
    """Step with all nodes at one delta until no hex is inverted or no step descends, `newton_steps` times at most."""
    direction = config.newton.direction()
    for _ in range(config.newton_steps):
        descent = config.newton.step(energy, now.x, delta, direction)
        if descent is None or descent.alpha == 0:
            break
        now, diagnostics = _Iterate.at(descent.x, energy, locked), descent.diagnostics(delta)
        del descent
        yield Step(now.points, diagnostics, intermediate=True, quality=now.quality, norm=energy.norm)
        if not now.inverted:
            break
    return now
