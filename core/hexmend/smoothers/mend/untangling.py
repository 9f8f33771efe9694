"""First stage of mend: untangling by a barrier that hardens step by step (Wilson 5.2.2).

Inverted hexes have a finite energy while delta > 0 (3.2). A falling epsilon gives delta^2 = epsilon (epsilon - worst),
worst being the least determinant of the mesh (Garanzha 2000); at each delta one Newton step lowers the energy.
"""

from __future__ import annotations

from collections.abc import Generator
from dataclasses import dataclass

import numpy as np

from hexmend.energy import MeshEnergy
from hexmend.iteration import Step
from hexmend.mesh.mesh import Mesh
from hexmend.optimise.search_direction import TruncatedNewton
from hexmend.quality import ElementQuality, measure
from hexmend.smoothers.mend.inversion import corners_of_inverted, count_inverted, recentre_far_nodes
from hexmend.smoothers.mend.newton_steps import newton_step

#: First epsilon, in cubes of the mean edge length, or with a target in the volumes that hexes are to have.
EPSILON = 0.03
#: Factors of epsilon from one step to the next with a boundary that is fixed: what a step can follow, and one that is
#: damped, and so shorter.
REDUCTIONS = 0.9, 0.975
#: Greatest delta, in cubes of the mean edge length: beyond it the energy of a flat hex is that of a cube.
MAX_DELTA = 1.0
#: Successive steps without fewer inverted hexes after which the stage ends.
PATIENCE = 40


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
        return cls.of(x, points, measure(points, energy.mesh.elements), energy, locked)

    @classmethod
    def of(
        cls, x: np.ndarray, points: np.ndarray, quality: ElementQuality, energy: MeshEnergy, locked: np.ndarray
    ) -> _Iterate:
        own = where = np.flatnonzero(quality.inverted)
        if energy.ranks.count > 1:
            own = where[energy.counted[where]]
        count, worst = count_inverted(points, energy.mesh.elements, locked, own, energy.hex_sizes)
        return cls(x, points, quality, where, energy.ranks.sum(count), energy.ranks.least(worst))


def untangle(
    mesh: Mesh,
    energy: MeshEnergy,
    locked: np.ndarray,
    reductions: tuple[float, float] = REDUCTIONS,
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
    reductions : (float, float)
        Factors of epsilon after a step that is not damped, and after one that is.

    Yields
    ------
    Step
        After each Newton step.
    """
    quality = measure(mesh.points, mesh.elements)
    points = recentre_far_nodes(mesh, quality)
    if energy.ranks.any(points is not mesh.points):
        points = energy.ranks.complete(np.array(points))
        quality = measure(points, mesh.elements)
        yield Step(points, intermediate=True, quality=quality, norm=energy.norm)
    now = _Iterate.of(energy.to_edge_units(points), points, quality, energy, locked)
    del points, quality  # large meshes have no memory for what is no longer needed
    fewest, idle, epsilon, direction = now.inverted, 0, EPSILON, TruncatedNewton()
    while now.inverted and idle < PATIENCE:
        delta = min(MAX_DELTA, float(np.sqrt(epsilon * (epsilon - min(now.worst, 0.0)))))
        descent = newton_step(energy, now.x, delta, direction)
        if descent is None:
            break
        del now
        now, diagnostics = _Iterate.at(descent.x, energy, locked), descent.diagnostics(delta)
        epsilon *= reductions[0] if descent.direction.shift == 0 else reductions[1]
        del descent
        yield Step(now.points, diagnostics, intermediate=True, quality=now.quality, norm=energy.norm)
        idle = 0 if now.inverted < fewest else idle + 1
        fewest = min(fewest, now.inverted)
    return Untangled(now.points, now.quality, corners_of_inverted(now.points, mesh.elements, now.where) | locked)
