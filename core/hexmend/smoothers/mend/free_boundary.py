"""A boundary whose nodes move in space within a tolerance of their surface: energy, fit, untangling and the return."""

from __future__ import annotations

import copy
from collections.abc import Generator
from dataclasses import dataclass, replace

import numpy as np

from hexmend.arrays import as_immutable_owned, mask
from hexmend.boundary import SlidingBoundary
from hexmend.energy import MeshEnergy, ObjectiveNorm
from hexmend.energy.barriers.surface_fit import NO_LIMIT, FitTolerances, SurfaceFit
from hexmend.iteration import Step, map_steps
from hexmend.mesh.mesh import Mesh
from hexmend.optimise.floors.maximised_floor import FloorDirection, MaximisedFloor, Reward
from hexmend.optimise.floors.movable_hexes import MovableHexes
from hexmend.parameters import AUTO
from hexmend.quality import measure
from hexmend.smoothers.mend.floors import BARRIER_SAFE, FLOORS
from hexmend.smoothers.mend.newton_steps import newton_step
from hexmend.smoothers.mend.untangling import untangle

#: Tolerance of patches without one that is given, and of what is to be exact, in mean edge lengths.
AUTO_FIT, EXACT_FIT = 0.07, 0.01
#: Share of a tolerance that samples may use, as points between them are farther.
_SAMPLED = 0.85


@dataclass(frozen=True)
class ReturnConfig:
    """Settings of untangling with a free boundary, and of the return to its surface.

    Parameters
    ----------
    slopes : tuple of float
        Of the elastic ceilings while hexes are untangled, one after the other until they are; the last is the slope at
        which the return ends.
    reductions : (float, float)
        See `untangling.untangle`: a free boundary follows faster.
    steps : int
        Most Newton steps of a round of the return, after which the ceilings become twice as steep.
    wider : tuple of float
        Multiples of the tolerances, of which the smallest that is reached counts where none is given.
    """

    slopes: tuple[float, ...] = (3.0, 10.0, 30.0, 100.0, 1000.0)
    reductions: tuple[float, float] = (0.8, 0.8)
    steps: int = FLOORS.steps
    wider: tuple[float, ...] = (1.0, 3.0, 9.0, 20.0)


RETURN = ReturnConfig()


def tolerances_of(tolerance: float | str, absolute: float, mesh: Mesh) -> FitTolerances:
    """Return the tolerances that a setting asks for; `absolute` is its value in the unit of the mesh."""
    patches = AUTO_FIT if tolerance == AUTO else min(_SAMPLED * absolute / mesh.mean_edge_length, NO_LIMIT)
    return FitTolerances(patches, patches, min(patches, EXACT_FIT), tolerance != AUTO)


class FreeBoundary:
    """The mesh of a sliding boundary whose nodes move in space, and the fit to the surface.

    Nodes of corners, straight curves and flat patches keep these exactly, but for those that may leave them.

    Parameters
    ----------
    sliding : SlidingBoundary
    invalid : (m,) bool
        Hexes whose boundary nodes may be anywhere near the surface, whatever their curve or patch.
    tolerances : FitTolerances
    norm : ObjectiveNorm
    leaving : (n,) bool, optional
        Nodes that may leave their corner, straight curve or flat patch, within the tolerance; all that may by default.

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
        invalid: np.ndarray,
        tolerances: FitTolerances,
        norm: ObjectiveNorm,
        leaving: np.ndarray | None = None,
    ):
        mesh, moves = sliding.mesh, tolerances.patches > 0
        self.sliding, self._given = sliding, (invalid, tolerances, norm)
        reaches, near = mask(mesh.elements[invalid], mesh.n_nodes), tolerances.patches < NO_LIMIT
        if leaving is None:  # without a limit corners and flat patches would dissolve
            leaving = sliding.leavable & (near | reaches)
        leaving = leaving & moves
        curved = mask(sliding.curved_nodes, mesh.n_nodes) & ~leaving
        self.mesh = sliding.linear_mesh_without(leaving)
        if not moves:
            self.mesh = self.mesh.with_fixed(self.mesh.fixed | curved)
        self.free = (leaving | curved) & moves & ~self.mesh.fixed
        released = reaches & sliding.leavable & self.free
        self.energy = MeshEnergy(self.mesh, norm)
        fit = SurfaceFit(sliding, self.free, released, tolerances, self.energy.unit)
        self.fit = fit.with_weights(FLOORS.fit_share)

    def returned(self, points: np.ndarray, jacobian: float, quality: float) -> tuple[FreeBoundary, np.ndarray]:
        """Return the nodes of corners, straight curves and flat patches from points (n, 3), where `snapped` lets them.

        Returns the boundary in which these are exact and the others free, and the points.
        """
        sliding, (invalid, tolerances, norm) = self.sliding, self._given
        exact = self.free & ~mask(sliding.curved_nodes, self.mesh.n_nodes)
        found, back = self.snapped(points, jacobian, quality, exact)
        narrower = FreeBoundary(sliding, invalid, tolerances, norm, exact & ~back)
        return narrower.allowing(found, everywhere=True), found

    def _with(self, fit: SurfaceFit, omitted: np.ndarray) -> MeshEnergy:
        """Return the energy with a fit, without some corners (m,) uint8."""
        return self.energy.with_objective(self.energy.norm, omitted).with_surface(fit)

    def _maximised(self, fit: SurfaceFit, omitted: np.ndarray) -> MaximisedFloor:
        """Return that energy with the least as an unknown, as where floors begin to rise."""
        energy = self._with(fit, omitted)
        reward = Reward(FLOORS.weight / FLOORS.first_gap, FLOORS.weight, FLOORS.band)
        return MaximisedFloor(energy, reward, MovableHexes(energy))

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

    def snapped(
        self, points: np.ndarray, jacobian: float, quality: float, nodes: np.ndarray | None = None
    ) -> tuple[np.ndarray, np.ndarray]:
        """Put as many nodes exactly on their corner, curve or patch as hexes and tolerances allow.

        Nodes that are to be exact go there in any case. Of the others those go by which no hex falls below the floors,
        or becomes invalid, and no sample exceeds its tolerance.

        Parameters
        ----------
        points : (n, 3) float64
        jacobian, quality : float
            Floors of the scaled Jacobians and of q(H), for hexes that are above them.
        nodes : (n,) bool, optional
            Of these nodes; of all that are free by default.

        Returns
        -------
        points : (n, 3) float64
        back : (n,) bool
            Nodes that are there.
        """
        sliding, hexes, n = self.sliding, self.mesh.elements, self.mesh.n_nodes
        there, slides = sliding.start.copy(), mask(sliding.nodes, n)
        there[slides] = sliding.project(points[slides], np.flatnonzero(slides))
        back, before = (self.free if nodes is None else nodes).copy(), measure(points, hexes)
        x = self.energy.to_edge_units(points)
        while True:
            found = np.where(back[:, None], there, points)
            now = measure(found, hexes)
            bad = now.invalid & ~before.invalid
            pairs = (now.scaled_jacobian, before.scaled_jacobian, jacobian), (now.q, before.q, quality)
            for new, old, floor in pairs:
                bad |= new < np.minimum(old, floor)
            out = mask(hexes[bad], n) | self.fit.exceeding(found / self.energy.unit, x)
            out &= back & ~sliding.confined
            if not out.any():
                return as_immutable_owned(found), back
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
        start = self.mesh.with_points(points)
        for slope in config.slopes[:-1]:
            energy = self._with(self.fit.without_diagonals().with_weights(slope=slope), locked)
            shape = energy.without_size()
            steps = untangle(start, shape, locked, config.reductions)
            untangled = yield from map_steps(steps, lambda step: replace(step, infeasible=True))  # off the surface
            if untangled.left(locked, energy):
                continue
            x = energy.to_edge_units(untangled.points)
            x = yield from self._returned(x, locked, slope, config.wider if wider else config.wider[:1], config)
            if x is not None:
                return self.energy.to_mesh_units(x), True
        return points, False

    def _returned(
        self, x: np.ndarray, locked: np.ndarray, slope: float, wider: tuple[float, ...], config: ReturnConfig
    ) -> Generator[Step, None, np.ndarray | None]:
        """Return within the tolerances, which the least may rise in, while the ceilings become steeper.

        Of the positions within the smallest multiple of the tolerances that is reached those with the highest least are
        returned; None where none is.
        """
        fit = self.fit.without_diagonals()
        best: list[tuple[float, np.ndarray | None]] = [(0.0, None)] * len(wider)
        while slope < config.slopes[-1] and not best[0][0] > BARRIER_SAFE:
            maximised = self._maximised(fit.with_weights(slope=slope), locked)
            direction = FloorDirection(maximised)
            for _ in range(config.steps):
                step = newton_step(maximised.as_energy, x, 0.0, direction)
                if step is None or step.alpha == 0:
                    break
                x = step.x
                yield Step(self.energy.to_mesh_units(x), intermediate=True, infeasible=True)
            least = float(maximised.hexes.corners(x).min(initial=np.inf))
            best = [
                (least, x) if fit.is_within(x, factor) and least > reached[0] else reached
                for factor, reached in zip(wider, best, strict=True)
            ]
            slope *= 2
        sound = [found for least, found in best if least > BARRIER_SAFE]
        return next((found for found in (*sound, *(found for _, found in best)) if found is not None), None)
