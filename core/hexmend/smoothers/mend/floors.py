"""Floors that rise: the highest minimum scaled Jacobian above a floor of q(H), and the best shape above both.

The floor of the scaled Jacobians is an unknown t, eliminated exactly (`MaximisedFloor`), whose reward grows as the
parameter of an interior point method does; the weight of the barrier stays.
"""

from __future__ import annotations

from collections.abc import Callable, Generator
from dataclasses import dataclass

import numpy as np

from hexmend.arrays import mask
from hexmend.energy import MeshEnergy
from hexmend.energy.barriers.surface_fit import SurfaceFit
from hexmend.energy.ranks import Ranks
from hexmend.iteration import ActiveSet, Step
from hexmend.optimise.descent import DESCENT, Descent
from hexmend.optimise.floors.maximised_floor import FloorDirection, MaximisedFloor, Reward
from hexmend.optimise.floors.movable_hexes import MovableHexes
from hexmend.optimise.floors.region import Region
from hexmend.optimise.search_direction import DampedDirection, TruncatedNewton
from hexmend.smoothers.mend.newton_steps import newton_step


@dataclass(frozen=True)
class FloorsConfig:
    """Settings of the stage.

    Parameters
    ----------
    weight : float
        Of the barrier, as a multiple of the shape energy of a hex.
    first_gap : float
        Between floor and least value; the reward of a higher floor is the weight divided by the gap.
    growth : float
        Of the reward, each time that nodes are centred: stretched hexes resist a rise, and the gap becomes smaller.
    band : float
        Width of the barrier.
    steps : int
        Most Newton steps of a round.
    centred : float
        Fall of the functional in a step, as a share of the barrier's weight, below which nodes are centred.
    accuracy : float
        The least has risen as far as it goes where it changes by no more than this share of it, or of 0.1, in a round,
        and is as near the floor.
    rings : int
        Layers of hexes around those near the floors whose nodes move.
    fit_share : float
        Weight of the fit as a share of that of the barrier.
    relax_weight : float
        Of the barriers while the shape improves above floors.
    """

    weight: float = 7.0
    first_gap: float = 0.02
    growth: float = 2.0
    band: float = 0.1
    steps: int = 12
    centred: float = 0.1
    accuracy: float = 5e-3
    rings: int = 2
    fit_share: float = 0.05
    relax_weight: float = 0.1


FLOORS = FloorsConfig()
#: Minimum scaled Jacobian above which the energy's barrier can be used.
BARRIER_SAFE = FLOORS.first_gap


class Values:
    """Minimum scaled Jacobians and qualities of the hexes that can be moved.

    Parameters
    ----------
    ranks : Ranks
    x : (n, 3) float64
        Positions, in mean edge lengths.
    jacobians, qualities : (m,) float64
        See `MovableHexes`.

    Attributes
    ----------
    jacobian, quality : float
        The least of them; inf where nothing can be moved.
    """

    def __init__(self, ranks: Ranks, x: np.ndarray, jacobians: np.ndarray, qualities: np.ndarray):
        self.x, self.jacobians, self.qualities = x, jacobians, qualities
        self.jacobian, self.quality = (ranks.least(float(of.min(initial=np.inf))) for of in (jacobians, qualities))


class Floors:
    """Nodes on their way to higher floors.

    Parameters
    ----------
    energy : MeshEnergy
        Pulls where the barriers do not; corners that are inverted at `points` are omitted.
    points : (n, 3) float64
        Where they begin.
    movable : callable
        Makes the values of the hexes that rise.

    Attributes
    ----------
    values : Values
        At the present positions.
    reward : float
        Of the last round.
    touched : (m,) bool
        Hexes near the floors of a round so far.
    """

    def __init__(
        self,
        energy: MeshEnergy,
        points: np.ndarray,
        movable: Callable[[MeshEnergy], MovableHexes] = MovableHexes,
        config: FloorsConfig = FLOORS,
    ):
        self.energy, self._config, self._movable, self._hexes = energy, config, movable, movable(energy)
        self.reward = config.weight / config.first_gap
        self.touched = np.zeros(energy.mesh.n_elements, dtype=bool)
        self.move_to(energy.to_edge_units(points))

    @property
    def points(self) -> np.ndarray:
        """The present positions in the mesh's unit, (n, 3)."""
        return self.energy.to_mesh_units(self.values.x)

    def active_set(self) -> ActiveSet:
        """Find the corners that hold the floor down, by their multipliers: the shares of the reward."""
        config = self._config
        gap = config.accuracy * config.first_gap
        maximised = MaximisedFloor(self.energy, Reward(config.weight / gap, config.weight, config.band), self._hexes)
        hexes, nodes, shares = maximised.multipliers(self.values.x)
        heavy = np.flatnonzero((shares > 0) & (2 * shares >= shares.max(initial=0.0)))
        heavy = heavy[np.argsort(-shares[heavy], kind="stable")]
        return ActiveSet(hexes[heavy], nodes[heavy], self._hexes.locked_below(self.values.x, self.values.jacobian))

    def move_to(self, x: np.ndarray) -> None:
        """Go to positions x (n, 3) in mean edge lengths."""
        self.values = self._values(x)

    def values_at(self, points: np.ndarray) -> Values:
        """Find the values at points (n, 3)."""
        return self._values(self.energy.to_edge_units(points))

    def _values(self, x: np.ndarray) -> Values:
        return Values(self.energy.ranks, x, self._hexes.jacobians(x), self._hexes.qualities(x))

    def continued(self, energy: MeshEnergy, points: np.ndarray) -> Floors:
        """Return the nodes at points (n, 3) of an energy of the same hexes, with the reward that was reached."""
        other = Floors(energy, points, self._movable, self._config)
        other.reward, other.touched = self.reward, self.touched
        return other

    def rise(self, quality_floor: float = -np.inf, enough: float = np.inf) -> Generator[Step, None, None]:
        """Raise the minimum scaled Jacobian above a floor of q(H), to which q(H) rises first where it is lower.

        It may be lower for some steps; it ends where it was highest.

        Parameters
        ----------
        quality_floor : float
        enough : float
            It ends where the minimum scaled Jacobian has reached this.

        Yields
        ------
        Step
            After each Newton step.
        """
        best = self.values
        if not best.jacobian < np.inf:  # no corner can be moved
            return
        for step in self._rounds(quality_floor, enough):
            is_kept = self.values.quality >= min(quality_floor, best.quality)
            best = self.values if is_kept and self.values.jacobian >= best.jacobian else best
            yield step
        if best is not self.values:
            self.values = best
            yield self._step()

    def _rounds(self, quality_floor: float, enough: float) -> Generator[Step, None, None]:
        """Centre the nodes with one reward after the other; see `rise`."""
        config, least, t = self._config, self.values.jacobian, -np.inf
        while True:
            gap = config.weight / self.reward
            floor = min(quality_floor, self.values.quality - gap)
            reward = Reward(self.reward, config.weight, config.band, floor)
            least_before, t_before, small = least, t, config.accuracy * max(least, 0.1)
            t, is_centred = yield from self._centre(reward, enough)
            least = self.values.jacobian
            if least >= enough and self.values.quality >= quality_floor:
                return
            if abs(least - least_before) < small and least - t < small:
                return
            if is_centred or t - t_before < small:
                self.reward *= config.growth

    def relax(self, jacobian: float, quality: float, everywhere: bool = False) -> Generator[Step, None, None]:
        """Improve the shape above floors of the scaled Jacobians and of q(H), which are below the present values.

        Where hexes have moved while floors rose, and near the floors; or `everywhere`.
        """
        config, band, values = self._config, self._config.band, self.values
        near = self.touched | (values.jacobians < jacobian + band) | (values.qualities < quality + band)
        near |= everywhere
        energy, hexes, region = self._around(near)
        x = values.x if region is None else region.inside(values.x)
        barrier = hexes.barrier(jacobian, quality, band, band, config.relax_weight)
        above = _fitted(energy, config.fit_share * config.relax_weight).with_barrier(barrier)
        direction = TruncatedNewton()
        for _ in range(config.steps):
            step = self._descend(above, x, direction)
            if step is None:
                break
            x = step.x
            self._take(region, hexes, x)
            yield self._step(**step.diagnostics(0.0))
            if -step.slope < config.centred * config.relax_weight:
                break

    def _centre(self, reward: Reward, enough: float) -> Generator[Step, None, tuple[float, bool]]:
        """Minimise with one reward, around the floor, until the least has reached `enough`.

        Returns the floor, and whether nodes are centred.
        """
        config, values = self._config, self.values
        near = values.jacobians < values.jacobian + reward.band
        near |= values.qualities < reward.quality_floor + reward.band
        self.touched |= near
        energy, hexes, region = self._around(near)
        maximised = MaximisedFloor(_fitted(energy, config.fit_share * config.weight), reward, hexes)
        direction = FloorDirection(maximised)
        x, is_centred = values.x if region is None else region.inside(values.x), False
        for _ in range(config.steps):
            step = self._descend(maximised.as_energy, x, direction)
            fall = 0.0 if step is None else step.value - maximised.value(step.x)
            is_centred = fall < config.centred * config.weight and (step is None or step.backtracks == 0)
            if step is None:
                break
            x = step.x
            self._take(region, hexes, x)
            yield self._step(gap=reward.gap, **step.diagnostics(0.0))
            if is_centred or self.values.jacobian >= enough:
                break
        return maximised.floor(x).t, is_centred

    def _descend(self, energy: MeshEnergy, x: np.ndarray, direction: DampedDirection) -> Descent | None:
        """Take a step; None where there is none, or a short one: nodes are as centred as they can be."""
        step = newton_step(energy, x, 0.0, direction)
        if step is None or step.alpha < DESCENT.short:
            return None
        if step.backtracks > 1:
            direction.shortened()
        return step

    def _around(self, near: np.ndarray) -> tuple[MeshEnergy, MovableHexes, Region | None]:
        """Energy and hexes of the part of the mesh around some hexes (m,) bool; of the whole without a part."""
        energy, mesh = self.energy, self.energy.mesh
        for _ in range(self._config.rings):
            near = energy.ranks.complete(mask(mesh.elements[near], mesh.n_nodes))[mesh.elements].any(axis=1)
        if not energy.motion.has_parts or 2 * energy.count(near) > energy.n_hexes:
            return energy, self._hexes, None
        region = Region(energy, mask(mesh.elements[near], mesh.n_nodes), self.values.x)
        return region.energy, self._movable(region.energy), region

    def _take(self, region: Region | None, hexes: MovableHexes, x: np.ndarray) -> None:
        """Take over the positions of the part that was moved, with the values of its hexes."""
        if region is None:
            self.move_to(x)
            return
        merged = region.merged(self.values.x, x)
        jacobians, qualities = self.values.jacobians.copy(), self.values.qualities.copy()
        jacobians[region.hexes] = self._hexes.jacobians_of(merged, region.hexes)  # corners at the rim count too
        qualities[region.hexes] = hexes.qualities(x)
        self.values = Values(self.energy.ranks, merged, jacobians, qualities)

    def _step(self, **diagnostics: float) -> Step:
        """The step to the present positions."""
        values = self.values
        given = {"least": values.jacobian, "least_q": values.quality}
        return Step(self.points, given | diagnostics, intermediate=True, norm=self.energy.norm)


def _fitted(energy: MeshEnergy, weight: float) -> MeshEnergy:
    """Return an energy with another weight of the barrier of its fit to a surface, if it has one."""
    fit = energy.surface
    return energy.with_surface(fit.with_weights(weight)) if isinstance(fit, SurfaceFit) else energy
