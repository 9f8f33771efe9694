"""A boundary whose nodes move in space within a tolerance of their surface: energy, fit, untangling and the return."""

from __future__ import annotations

import copy
from collections.abc import Generator
from dataclasses import dataclass

import numpy as np

from hexmend.arrays import as_immutable_owned, mask
from hexmend.boundary import SlidingBoundary
from hexmend.boundary.classification import NodeClass
from hexmend.energy import MeshEnergy, ObjectiveNorm, energy_of
from hexmend.energy.surface_fit import FitTolerances, SurfaceFit
from hexmend.iteration import Step
from hexmend.mesh.mesh import Mesh
from hexmend.optimise.descent import descend
from hexmend.optimise.floors.maximised_floor import FloorDirection, MaximisedFloor, Reward
from hexmend.optimise.floors.movable_hexes import MovableHexes
from hexmend.optimise.search_direction import TruncatedNewton, TruncatedNewtonConfig
from hexmend.parameters import AUTO
from hexmend.quality import measure
from hexmend.smoothers.mend.floors import BARRIER_SAFE, FLOORS, Floors
from hexmend.smoothers.mend.inversion import count_inverted
from hexmend.smoothers.mend.newton_steps import NEWTON, SEARCH

#: Tolerance of patches without one that is given, and of what is to be exact, in mean edge lengths.
AUTO_FIT, EXACT_FIT = 0.07, 0.01
#: Share of a tolerance that samples may use, as points between them are farther.
_SAMPLED = 0.85
#: Tolerance that stands for none.
_UNLIMITED = 1e3


@dataclass(frozen=True)
class ReturnConfig:
    """Settings of untangling with a free boundary, and of the return to its surface.

    Parameters
    ----------
    slopes : tuple of float
        Of the elastic ceilings while hexes are untangled, one after the other until they are.
    epsilon : float
        First e of delta² = e (e - worst), in cubes of the mean edge length (Garanzha).
    falls : (float, float)
        Least and greatest share by which e falls in a step.
    max_delta : float
    steps : int
        Most Newton steps of untangling.
    reward : (float, float, float)
        `Reward` of the least while the boundary returns.
    rounds, steps_per_round : int
        Of the return.
    rising : float
        The ceilings become twice as steep where the least rises by no more than this share of it, or of 0.1.
    greatest_slope : float
    wider : tuple of float
        Multiples of the tolerances, of which the smallest that is reached counts where none is given.
    """

    slopes: tuple[float, ...] = (3.0, 10.0, 30.0, 100.0)
    epsilon: float = 0.03
    falls: tuple[float, float] = (0.1, 0.5)
    max_delta: float = 0.5
    steps: int = 120
    reward: tuple[float, float, float] = (300.0, 0.02, 0.2)
    rounds: int = 40
    steps_per_round: int = 3
    rising: float = 0.05
    greatest_slope: float = 1000.0
    wider: tuple[float, ...] = (1.0, 3.0, 9.0, 20.0)


RETURN = ReturnConfig()


def tolerances_of(tolerance: float | str, absolute: float, mesh: Mesh) -> FitTolerances:
    """Return the tolerances that a setting asks for; `absolute` is its value in the unit of the mesh."""
    patches = AUTO_FIT if tolerance == AUTO else min(_SAMPLED * absolute / mesh.mean_edge_length, _UNLIMITED)
    return FitTolerances(patches, patches, min(patches, EXACT_FIT), tolerance != AUTO)


class FreeBoundary:
    """The mesh of a sliding boundary whose nodes move in space, and the fit to the surface.

    Nodes on flat patches, and those on straight curves that are to be exact, keep these exactly.

    Parameters
    ----------
    sliding : SlidingBoundary
    inverted : (m,) bool
        Hexes whose boundary nodes may be anywhere near the surface, whatever their curve or patch.
    tolerances : FitTolerances
    norm : ObjectiveNorm
    features : (n,) bool, optional
        Nodes of corners, curves and flat patches that move within the tolerance of these.

    Attributes
    ----------
    mesh : Mesh
        With the nodes free that move.
    energy : MeshEnergy
        Of this mesh, without the fit.
    fit : SurfaceFit
        With the barrier of its tolerances.
    """

    def __init__(
        self,
        sliding: SlidingBoundary,
        inverted: np.ndarray,
        tolerances: FitTolerances,
        norm: ObjectiveNorm,
        features: np.ndarray | None = None,
    ):
        mesh, moves = sliding.mesh, tolerances.patches > 0
        self.sliding, self._given = sliding, (inverted, tolerances, norm)
        leavable = sliding.leavable & moves
        released = mask(mesh.hexes[inverted], mesh.n_nodes) & leavable
        self.features = features = np.zeros(mesh.n_nodes, dtype=bool) if features is None else features & leavable
        around = sliding.without_nodes(np.flatnonzero(released | features), np.inf)
        self.mesh = around.linear_mesh
        curved = mask(around.curved_nodes, mesh.n_nodes)
        if not moves:
            self.mesh = self.mesh.with_fixed(self.mesh.fixed | curved)
        self.free = (released | features | curved) & moves & ~self.mesh.fixed
        self.energy = energy_of(self.mesh, norm)
        fit = SurfaceFit(sliding, self.free, released, tolerances, self.energy.unit)
        self.fit = fit.with_weights(FLOORS.relax_fit)

    def with_features(self, points: np.ndarray) -> FreeBoundary | None:
        """Return the boundary with more corners and curves free: at the lowest hexes at points (n, 3), and around them.

        None where these have no others.
        """
        hexes, n, (inverted, tolerances, norm) = self.mesh.hexes, self.mesh.n_nodes, self._given
        if not tolerances.patches:
            return None
        jacobians = Floors(self.energy, points).values.jacobians
        low = jacobians < jacobians.min() + FLOORS.bands[0]
        low = mask(hexes[low], n)[hexes].any(axis=1)
        features = mask(hexes[low], n) & self.sliding.leavable & (self.sliding.node_class != NodeClass.INSIDE)
        features &= ~self.free
        if not features.any():
            return None
        wider = FreeBoundary(self.sliding, inverted, tolerances, norm, self.features | features)
        return wider.allowing(points, everywhere=True)

    def _with(self, fit: SurfaceFit, omitted: np.ndarray) -> MeshEnergy:
        """Return the energy with a fit, without some corners (m,) uint8."""
        return self.energy.with_objective(self.energy.norm, omitted).with_surface(fit)

    def _maximised(self, fit: SurfaceFit, omitted: np.ndarray, config: ReturnConfig) -> MaximisedFloor:
        """Return that energy with the least as an unknown."""
        energy = self._with(fit, omitted)
        return MaximisedFloor(energy, Reward(*config.reward), MovableHexes(energy))

    @property
    def fitted(self) -> MeshEnergy:
        """The energy with the fit."""
        return self.energy.with_surface(self.fit)

    def allowing(self, points: np.ndarray, everywhere: bool) -> FreeBoundary:
        """Return the boundary with tolerances that allow points (n, 3): of warped quads alone, or everywhere."""
        other = copy.copy(self)
        x = self.energy.to_edge_units(points)
        other.fit = self.fit.allowing(x, np.full_like(self.fit.diagonal, True) if everywhere else self.fit.diagonal)
        return other

    def widened(self, factor: float) -> FreeBoundary:
        """Return the boundary with tolerances larger by a factor, but for those of what is to be exact."""
        other = copy.copy(self)
        other.fit = self.fit.widened(factor)
        return other

    def exact(self, points: np.ndarray) -> np.ndarray:
        """Return points (n, 3) with the nodes that are to be exact on their curve or patch."""
        nodes = np.flatnonzero(self.sliding.confined & self.free)
        if not nodes.size:
            return points
        found = points.copy()
        found[nodes] = self.sliding.project(points[nodes], nodes)
        return as_immutable_owned(found)

    def snapped(self, points: np.ndarray, share: float) -> np.ndarray:
        """Return points (n, 3) with as many nodes exactly on their corner, curve or patch as the hexes allow.

        Nodes that are to be exact are there in any case. Of the others those return at whose hexes no scaled Jacobian
        and no q(H) falls below a share of the least values.
        """
        sliding, hexes, n = self.sliding, self.mesh.hexes, self.mesh.n_nodes
        there, slides = sliding.start.copy(), mask(sliding.nodes, n)
        there[slides] = sliding.project(points[slides], np.flatnonzero(slides))
        there = np.where(self.free[:, None], there, points)
        back, before = self.free.copy(), measure(points, hexes)
        while True:
            found = np.where(back[:, None], there, points)
            now = measure(found, hexes)
            bad = now.invalid & ~before.invalid
            for new, old in (now.scaled_jacobian, before.scaled_jacobian), (now.q, before.q):
                bad |= new < old.min() - (1 - share) * abs(old.min())
            out = back & mask(hexes[bad], n) & ~sliding.confined
            if not out.any():
                return as_immutable_owned(found)
            back &= ~out

    def untangle(
        self, points: np.ndarray, locked: np.ndarray, wider: bool, config: ReturnConfig = RETURN
    ) -> Generator[Step, None, tuple[np.ndarray, bool]]:
        """Untangle from points (n, 3) on, then return within the tolerances.

        Parameters
        ----------
        points : (n, 3) float64
        locked : (m,) uint8
            Corners that fixed nodes lock.
        wider : bool
            Tolerances may be exceeded where hexes stay inverted otherwise.

        Returns
        -------
        (n, 3) float64
            `points` where hexes stay inverted, or do not return.
        bool
            True if no hex is inverted, within the tolerances or wider ones.
        """
        start = self.energy.to_edge_units(points)
        for slope in config.slopes:
            x = yield from self._untangled(start, locked, slope, config)
            if x is not None:
                x = yield from self._returned(x, locked, slope, config.wider if wider else config.wider[:1], config)
            if x is not None:
                return self.energy.to_mesh_units(x), True
        return points, False

    def _untangled(
        self, x: np.ndarray, locked: np.ndarray, slope: float, config: ReturnConfig
    ) -> Generator[Step, None, np.ndarray | None]:
        """Untangle by Newton steps while delta falls (Garanzha); None where hexes stay inverted."""
        hexes, epsilon = self.mesh.hexes, config.epsilon
        energy = self._with(self.fit.without_diagonals().with_weights(slope=slope), locked)
        direction = TruncatedNewton(TruncatedNewtonConfig(loosest=FLOORS.loosest))
        for _ in range(config.steps):
            quality = measure(x, hexes)
            inverted, worst = count_inverted(x, hexes, locked, np.flatnonzero(quality.inverted), energy.hex_sizes)
            if not inverted:
                return x
            delta = min(config.max_delta, float(np.sqrt(epsilon * (epsilon - worst))))
            step = descend(energy, x, delta, direction, SEARCH, NEWTON.max_step)
            if step is None:
                return None
            fall = 1 - energy.value(step.x, delta) / step.value
            epsilon *= 1 - float(np.clip(fall, *config.falls))
            x = step.x
            yield self._step(x, delta=delta)
        return None

    def _returned(
        self, x: np.ndarray, locked: np.ndarray, slope: float, wider: tuple[float, ...], config: ReturnConfig
    ) -> Generator[Step, None, np.ndarray | None]:
        """Return within the tolerances while the least rises; the ceilings become steeper where it does not.

        Of the positions within the smallest multiple of the tolerances that is reached those with the highest least are
        returned; None where none is.
        """
        fit, last = self.fit.without_diagonals(), -1.0
        best: list[tuple[float, np.ndarray | None]] = [(0.0, None)] * len(wider)
        for _ in range(config.rounds):
            maximised = self._maximised(fit.with_weights(slope=slope), locked, config)
            direction = FloorDirection(maximised, TruncatedNewton(TruncatedNewtonConfig(loosest=FLOORS.loosest)))
            for _ in range(config.steps_per_round):
                step = descend(maximised.as_energy, x, 0.0, direction, SEARCH, NEWTON.max_step)
                if step is None or step.alpha == 0:
                    break
                x = step.x
            yield self._step(x)
            least = float(maximised.hexes.corners(x).min(initial=np.inf))
            rises, last = least > last + config.rising * max(last, 0.1), least
            best = [
                (least, x) if fit.is_within(x, factor) and least > reached[0] else reached
                for factor, reached in zip(wider, best, strict=True)
            ]
            if rises:
                continue
            if best[0][0] > BARRIER_SAFE or slope >= config.greatest_slope:
                break
            slope *= 2
        sound = [found for least, found in best if least > BARRIER_SAFE]
        return next((found for found in (*sound, *(found for _, found in best)) if found is not None), None)

    def _step(self, x: np.ndarray, **diagnostics: float) -> Step:
        return Step(self.energy.to_mesh_units(x), diagnostics, intermediate=True, infeasible=True)
