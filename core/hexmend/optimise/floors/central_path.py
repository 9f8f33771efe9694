"""Central path: floors of the scaled Jacobian and of q(H) rise, and Newton steps keep all hexes away from them.

The least of many functions is raised by a sequence of smooth problems (method of centres, Huard 1967): minimise the
energy plus a logarithmic barrier of floors below the present least; then raise the floors by a share of the distance
that all values have won, and repeat. Far from the floors there is only the energy, which keeps the mesh smooth.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from hexmend.arrays import mask
from hexmend.energy import MeshEnergy
from hexmend.kernels.line_search import LineSearch
from hexmend.optimise.descent import descend
from hexmend.optimise.floors.movable_hexes import MovableHexes
from hexmend.optimise.floors.region import Region
from hexmend.optimise.search_direction import TruncatedNewton, TruncatedNewtonConfig


@dataclass(frozen=True)
class CentralPathConfig:
    """Settings of the path.

    Parameters
    ----------
    jacobian_gap, quality_gap : float
        Distance of the first floors from the present least.
    jacobian_band, quality_band : float
        First width of the bands above the floors in which the barrier acts.
    band_factor, min_band_share : float
        Factor of the bands from one floor to the next, and share of the first at which they stay.
    max_hexes, few_hexes : float, int
        Share of the hexes that are in a band at most, and number of them that always may be.
    share : float
        Share of the distance between the floor and the least by which a floor rises.
    weight : float
        Of the barrier.
    newton_steps : int
        Most Newton steps at one floor.
    centred : float
        Slope, as a share of the weight, at which nodes are centred.
    min_gain, window : float, int
        The path ends where so many successive floors raise the least by less than this, as a share of it or of 0.1.
    max_floors : int
        Most floors.
    rings : int
        Layers of hexes around those in the bands whose nodes move with them.
    whole : float
        Share of the mesh from which on all its nodes move.
    whole_sliding : float
        The same where its boundary slides: nodes around such a part slide with it, which raises the least further.
    max_step : float
        Longest move of a node in a step, in mean lengths of its edges.
    solver_iterations : int
        Most iterations of conjugate gradients for a direction.
    """

    jacobian_gap: float = 0.05
    quality_gap: float = 0.05
    jacobian_band: float = 0.2
    quality_band: float = 0.1
    band_factor: float = 0.8
    min_band_share: float = 0.1
    max_hexes: float = 0.1
    few_hexes: int = 1000
    share: float = 0.9
    weight: float = 10.0
    newton_steps: int = 8
    centred: float = 1e-2
    min_gain: float = 5e-3
    window: int = 2
    max_floors: int = 25
    rings: int = 2
    whole: float = 0.5
    whole_sliding: float = 0.25
    max_step: float = 1.5
    solver_iterations: int = 200


PATH = CentralPathConfig()

_SEARCH = LineSearch(backtrack_factor=0.5)


@dataclass(frozen=True)
class Least:
    """Minimum scaled Jacobian and least q(H) of what can be moved, or floors of them; -inf: no floor."""

    jacobian: float
    quality: float


class CentralPath:
    """Nodes on their way to higher floors.

    Parameters
    ----------
    energy : MeshEnergy
        Pulls where the barrier does not; corners that are inverted at `points` are omitted.
    points : (n, 3) float64
        Where the path begins.
    config : CentralPathConfig, optional

    Attributes
    ----------
    x : (n, 3) float64
        The present positions, in mean edge lengths.
    newton_steps, solver_iterations : int
        Counts of Newton steps and of iterations of conjugate gradients.
    """

    def __init__(self, energy: MeshEnergy, points: np.ndarray, config: CentralPathConfig = PATH):
        self.energy, self.config = energy, config
        self.x = energy.to_edge_units(points)
        self.newton_steps = self.solver_iterations = 0
        hexes = MovableHexes(energy)
        self._jacobians, self._qualities = hexes.jacobians(self.x), hexes.qualities(self.x)
        self._hexes, self._region = hexes, None

    @property
    def points(self) -> np.ndarray:
        """The present positions in the mesh's unit, (n, 3)."""
        return self.energy.to_mesh_units(self.x)

    @property
    def least(self) -> Least:
        """The present least values; inf where nothing can be moved."""
        values = self._jacobians, self._qualities
        return Least(*(self.energy.ranks.least(float(of.min(initial=np.inf))) for of in values))

    def move_to(self, x: np.ndarray) -> None:
        """Go to other positions, (n, 3) in mean edge lengths, such as earlier ones."""
        self._region = None
        self._take(self._hexes, x)

    def rise(self, target: Least, config: CentralPathConfig | None = None) -> Iterator[Least]:
        """Raise the least values together until both reach their targets or rise no more.

        Parameters
        ----------
        target : Least
            -inf: not raised, and without a floor.
        config : CentralPathConfig, optional
            Settings of this rise.

        Yields
        ------
        Least
            After each floor.
        """
        config, least, target = config or self.config, self.least, self._without_values(target)
        floors = Least(
            min(least.jacobian - config.jacobian_gap, target.jacobian),
            min(least.quality - config.quality_gap, target.quality),
        )
        history = [least]
        for number in range(config.max_floors):
            scale = max(config.band_factor**number, config.min_band_share)
            self._centre(floors, scale, config.weight, config)
            least = self.least
            yield least
            history.append(least)
            if least.jacobian >= target.jacobian and least.quality >= target.quality:
                break
            if number >= config.window and not _gains(history[-1 - config.window], least, target, config.min_gain):
                break
            floors = Least(
                _next(floors.jacobian, least.jacobian, target.jacobian, config.share),
                _next(floors.quality, least.quality, target.quality, config.share),
            )

    def minimise_above(self, floors: Least, weights: tuple[float, ...]) -> Iterator[Least]:
        """Minimise the energy above floors, which lie below the present least values.

        Parameters
        ----------
        floors : Least
        weights : tuple of float
            Of the barrier, falling: at the end it acts close to the floors alone.

        Yields
        ------
        Least
            After the minimum with each weight.
        """
        floors = self._without_values(floors)
        for weight in weights:
            self._centre(floors, 1.0, weight, self.config)
            yield self.least

    def _without_values(self, floors: Least) -> Least:
        """Return floors, or targets, without one of q(H) where no hex has that value."""
        return floors if self.least.quality < np.inf else Least(floors.jacobian, -np.inf)

    def _centre(self, floors: Least, scale: float, weight: float, config: CentralPathConfig) -> None:
        """Minimise the energy with the barrier of floors, in the part of the mesh where it acts."""
        bands = (
            _band(self.energy, self._jacobians - floors.jacobian, scale * config.jacobian_band, config),
            _band(self.energy, self._qualities - floors.quality, scale * config.quality_band, config),
        )
        energy, hexes, x = self._around(floors, bands, config)
        energy = energy.with_barrier(hexes.barrier(floors.jacobian, floors.quality, *bands, weight))
        direction = TruncatedNewton(TruncatedNewtonConfig(config.solver_iterations, loosest=0.1))
        for _ in range(config.newton_steps):
            step = descend(energy, x, 0.0, direction, _SEARCH, config.max_step)
            if step is None or step.alpha == 0:
                break
            self.newton_steps += 1
            self.solver_iterations += step.direction.solver_iterations
            x = step.x
            if -step.slope < config.centred * weight:
                break
        self._take(hexes, x)

    def _around(
        self, floors: Least, bands: tuple[float, float], config: CentralPathConfig
    ) -> tuple[MeshEnergy, MovableHexes, np.ndarray]:
        """Energy, hexes and positions of the part of the mesh around the hexes in the bands, or of the whole."""
        near = (self._jacobians < floors.jacobian + bands[0]) | (self._qualities < floors.quality + bands[1])
        mesh, core = self.energy.mesh, near
        for _ in range(config.rings):
            core = self.energy.ranks.complete(mask(mesh.hexes[core], mesh.n_nodes))[mesh.hexes].any(axis=1)
        whole = config.whole_sliding if self.energy.limits_moves else config.whole
        if not self.energy.has_parts or self.energy.count(core) > whole * self.energy.n_hexes:
            self._region = None
            return self.energy, self._hexes, self.x
        self._region = Region(self.energy, np.flatnonzero(core), self.x)
        return self._region.energy, MovableHexes(self._region.energy), self._region.inside(self.x)

    def _take(self, hexes: MovableHexes, x: np.ndarray) -> None:
        """Take over the positions of the part that was moved, and its values."""
        if self._region is None:
            self.x, self._jacobians, self._qualities = x, hexes.jacobians(x), hexes.qualities(x)
            return
        self.x, at = self._region.merged(self.x, x), self._region.hexes
        self._jacobians[at], self._qualities[at] = hexes.jacobians(x), hexes.qualities(x)


def _band(energy: MeshEnergy, distances: np.ndarray, band: float, config: CentralPathConfig) -> float:
    """Narrow a band until not too many of these distances from a floor, (m,), are in it."""
    limit = max(config.few_hexes, int(config.max_hexes * energy.n_hexes))
    if limit >= energy.n_hexes or energy.count(distances < band) <= limit:
        return band
    return max(energy.smallest(distances, limit, band), config.min_band_share * band)


def _next(floor: float, least: float, target: float, share: float) -> float:
    """Raise a floor towards the least value by a share of their distance, no higher than its target."""
    return target if target == -np.inf else min(floor + share * (least - floor), target)


def _gains(before: Least, now: Least, target: Least, share: float) -> bool:
    """Return True if a value that is below its target has risen by more than a share of itself."""
    pairs = (before.jacobian, now.jacobian, target.jacobian), (before.quality, now.quality, target.quality)
    return any(new < goal and new - old > share * max(abs(new), 0.1) for old, new, goal in pairs)
