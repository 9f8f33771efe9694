"""Stages of mend in which nodes leave the surface where it keeps hexes inverted or the minimum scaled Jacobian down."""

from __future__ import annotations

from collections.abc import Callable, Generator, Iterator, Sequence
from typing import TypeAlias

import numpy as np

from hexmend.boundary import SlidingBoundary
from hexmend.iteration import Step
from hexmend.optimise.maxmin.slp import MaxMinOptimiser
from hexmend.optimise.maxmin.slp_config import SLP
from hexmend.parameters import AUTO
from hexmend.quality import measure
from hexmend.smoothers.mend.maxmin import MAXMIN, NO_CORNERS
from hexmend.smoothers.mend.mend_settings import MendSettings
from hexmend.smoothers.mend.shape_optimum import ShapeOptimum
from hexmend.smoothers.mend.surface.detours import (
    MaxMinResult,
    improve_off_surface,
    raise_nearer,
    raise_to_the_end,
    raise_within_tolerance,
)
from hexmend.smoothers.mend.surface.release import RELEASE, Untangle, infeasible, untangle_released
from hexmend.smoothers.sliding_smoother import AUTO_TOLERANCE, UNLIMITED

#: Function that goes to the optimum of shape from some points (n, 3) on, with a boundary that slides.
OptimiseShape: TypeAlias = Callable[[SlidingBoundary, np.ndarray], Generator[Step, None, ShapeOptimum]]


class LeavingSurface:
    """Nodes that leave the surface, within the tolerance of a run.

    Parameters
    ----------
    settings : MendSettings
        The method with its parameters.
    sliding : SlidingBoundary
    untangled, optimise_shape : callable
        Stages of the run that it needs.
    best : MaxMinResult, optional
        The best result within other tolerances: the run ends where it becomes clear that it does not come higher.
    """

    def __init__(
        self,
        settings: MendSettings,
        sliding: SlidingBoundary,
        untangled: Untangle,
        optimise_shape: OptimiseShape,
        best: MaxMinResult | None = None,
    ):
        self.settings, self.sliding, self.mesh = settings, sliding, sliding.mesh
        self._untangled, self._optimise_shape = untangled, optimise_shape
        self._nearly: MaxMinOptimiser | None = None  # with the fewest inverted hexes, where some may be left
        self.widened = False  # distances beyond the least one were tried
        self._best = best

    def untangle(
        self, optimum: np.ndarray, candidates: Sequence[np.ndarray]
    ) -> Generator[Step, None, MaxMinResult | None]:
        """Let nodes leave the surface where the best of some points (n, 3) on it leave hexes inverted.

        None where no hex is inverted, or nodes must not leave the surface, or some hexes stay inverted.
        """
        hexes = self.mesh.hexes
        starts = sorted(candidates, key=lambda points: measure(points, hexes).n_inverted)
        if not measure(starts[0], hexes).n_inverted or not self._tolerance > 0:
            return None
        limits, fewest = self._limits, len(hexes)
        trials = [(optimum, limits[:1], True)]
        trials += [(start, limits[:1], False) for start in starts[: RELEASE.starts]] + [(starts[0], limits[1:], False)]
        for start, within, others_stay in trials:
            if fewest <= RELEASE.few or not within:  # linear programs do better
                break
            self.widened = self.widened or within[0] > limits[0]
            points, released = yield from untangle_released(self.sliding, start, self._untangled, within, others_stay)
            inverted = measure(points, hexes).n_inverted
            if inverted < fewest and released.size:
                fewest, self._nearly = inverted, self._with_released(points, released)
            if not inverted and not (others_stay and self._nearly.corners.active_minimum < MAXMIN.barrier_safe):
                return (yield from self._raise_untangled(points, released))
        return None

    def smaller_tolerance(self, result: MaxMinResult | None) -> float | None:
        """A tolerance below that of the run, in mean edge lengths, within which the least may be higher; else None.

        A run on the surface begins in the same band within 0.3 and 0.1, so that only the smallest tolerance can bring
        more. Where hexes are still inverted, or nodes have been released, any smaller one can. Only a tolerance in
        numbers has smaller ones: otherwise it is as large as it needs to be.
        """
        if self.settings.surface_tolerance in (AUTO, UNLIMITED):
            return None
        edge = self.mesh.mean_edge_length
        smaller = [share for share in RELEASE.smaller if share * edge * (1 + SLP.band_excess) < self._tolerance]
        if not smaller:
            return None
        failed = result is None or not result.least > 0
        return smaller[-1] if failed or self.widened or result.optimiser.envelope.released.any() else smaller[0]

    def raise_least(
        self, start: np.ndarray, result: MaxMinResult, tolerance: float
    ) -> Generator[Step, None, MaxMinResult]:
        """Let nodes leave the surface, from points `start` (n, 3) on, where the result on it is low.

        Their distance from it is one of `tolerances`.
        """
        wanted = MAXMIN.acceptable
        wanted = wanted if self.settings.maximises_jacobian else min(wanted, MAXMIN.barrier_safe)
        if not tolerance > 0 or result.least >= wanted:
            return (yield from raise_to_the_end(result))
        optimiser = MaxMinOptimiser(self.mesh, start, self.sliding)
        if measure(result.optimiser.points, self.mesh.hexes).n_inverted:
            self.widened = self.widened or len(self._limits) > 1
            starts = [optimiser] if self._nearly is None else [self._nearly, optimiser]
            lowest = 0.0 if self._best is not None and self._best.least > 0 else -np.inf
            return (yield from improve_off_surface(starts, self._limits, result, wanted, lowest=lowest))
        nearer = [share * self.mesh.mean_edge_length for share in MAXMIN.off_surface_tolerances]
        reached = result.optimiser.envelope.max_deviation / (1 + SLP.band_excess)
        limits = [limit for limit in nearer if reached <= limit < MAXMIN.distinct * tolerance]
        return (yield from improve_off_surface([optimiser], [*limits, tolerance], result, wanted))

    def boundary(self, result: MaxMinResult | None) -> SlidingBoundary:
        """The boundary with the nodes free that left the surface, in the band of a result; as it was without one."""
        if result is None:
            return self.sliding
        envelope, width = result.optimiser.envelope, self._width(result)
        if envelope.released.any():
            return envelope.sliding.without_nodes(np.flatnonzero(envelope.off_surface), width)
        return self.sliding.with_band(width) if width > self.sliding.max_deviation else self.sliding

    def released(self, result: MaxMinResult | None, nodes: np.ndarray) -> Iterator[tuple[SlidingBoundary, float]]:
        """Yield the boundary with some more nodes (n,) bool free as far as they may be, and their greatest distance.

        First within the band of a result, then at the distances that are tried where hexes are inverted.
        """
        around, width = self.boundary(result), 0.0 if result is None else self._width(result)
        freed = np.flatnonzero(nodes & around.leavable)
        limits = sorted({max(limit, width) for limit in self._limits}) if self._tolerance > 0 else []
        for limit in limits:
            if freed.size or limit > width:
                yield around.without_nodes(freed, limit), limit

    def deviation(self, points: np.ndarray) -> float:
        """Return the largest distance of the boundary at points (n, 3) from the surface, in the mesh's unit."""
        return MaxMinOptimiser(self.mesh, points, self.sliding).envelope.largest_deviation(points)

    def returned(self, result: MaxMinResult, points: np.ndarray) -> Generator[Step, None, MaxMinOptimiser]:
        """Go on from a result to points (n, 3), whose boundary returns to the band of the result if it is outside.

        Where it does not return, the optimiser stays at the result.
        """
        optimiser, limit = result.optimiser.fork(), self._width(result)
        optimiser.move_to(points)
        with optimiser.envelope.relaxed(limit):
            yield from (step.step(infeasible=True) for step in optimiser.return_to_band(limit))
        if optimiser.envelope.largest_deviation(optimiser.points, limit) > limit * (1 + SLP.band_excess):
            optimiser.move_to(result.optimiser.points)
        return optimiser

    def _width(self, result: MaxMinResult) -> float:
        """Distance of boundary and surface in the band of a result, or that of its points where they are outside."""
        envelope = result.optimiser.envelope
        far = envelope.largest_deviation(result.optimiser.points, envelope.max_deviation)
        return max(far * (1 + SLP.band_excess), envelope.max_deviation)

    def _raise_untangled(self, points: np.ndarray, released: np.ndarray) -> Generator[Step, None, MaxMinResult]:
        """Go to the optimum of shape and raise the least from points (n, 3) whose nodes (k,) left the surface."""
        sliding, tolerance = self.sliding, self.tolerances[0]
        far = MaxMinOptimiser(self.mesh, points, sliding).envelope.largest_deviation(points)
        enough = (limit for limit in self._limits if far <= limit * (1 + SLP.band_excess))
        limit = min(enough, default=far)
        shape = yield from infeasible(self._optimise_shape(sliding.without_nodes(released, limit), points))
        optimiser = self._with_released(shape.points, released)
        optimiser.envelope.limit_to(limit)
        if not self.settings.maximises_jacobian and optimiser.corners.active_minimum >= MAXMIN.barrier_safe:
            return MaxMinResult(optimiser, NO_CORNERS)
        nearer = [smaller for smaller in self._limits if smaller < limit]
        if nearer:
            result = yield from infeasible(raise_within_tolerance(optimiser, limit, MAXMIN.programs_between))
            result = yield from raise_nearer(result, nearer)
            limit = min(limit, result.optimiser.envelope.max_deviation)
            yield result.step()
        else:
            result = yield from raise_within_tolerance(optimiser, limit, MAXMIN.programs_between)
        if not limit < tolerance or result.least >= MAXMIN.acceptable:
            return result
        return (yield from raise_within_tolerance(optimiser, tolerance, MAXMIN.programs_between))

    def _with_released(self, points: np.ndarray, released: np.ndarray) -> MaxMinOptimiser:
        optimiser = MaxMinOptimiser(self.mesh, points, self.sliding)
        optimiser.release_nodes(released)
        return optimiser

    @property
    def tolerances(self) -> list[float]:
        """Distances from the surface that nodes may have where it holds the least down, ascending.

        The larger begins at what is reached within the smaller, so that a larger tolerance ends no lower.
        """
        smaller, tolerance = AUTO_TOLERANCE * self.mesh.mean_edge_length, self._tolerance
        return [smaller, tolerance] if tolerance > smaller * (1 + SLP.band_excess) else [tolerance]

    def sliding_tolerance(self, tolerance: float) -> float:
        """Tolerance for quads while nodes slide, for one of `tolerances`: without a limit, the last has none."""
        unlimited = self.settings.surface_tolerance == UNLIMITED and tolerance == self.tolerances[-1]
        return np.inf if unlimited else tolerance

    @property
    def least_to_reach(self) -> float:
        """Least that the central path has to reach on the surface, so that linear programs can exceed the best."""
        if self._best is None or self._best.optimiser.envelope.released.any():
            return -np.inf
        return MAXMIN.share_in_reach * self._best.least

    @property
    def may_leave(self) -> bool:
        """Nodes leave the surface where it holds the minimum scaled Jacobian down: that is the goal, and some can."""
        return self.settings.maximises_jacobian and self._tolerance > 0 and bool(self.sliding.leavable.any())

    @property
    def nearly_untangled(self) -> bool:
        """Few hexes or none are inverted where nodes have left the surface at the least distance."""
        return self._nearly is not None and measure(self._nearly.points, self.mesh.hexes).n_inverted <= RELEASE.few

    @property
    def _limits(self) -> list[float]:
        """Distances from the surface that the boundary may have where hexes are inverted, ascending."""
        limits = [share * self.mesh.mean_edge_length for share in RELEASE.steps]
        if self.settings.surface_tolerance in (AUTO, UNLIMITED):
            return limits
        tolerance = self.settings.absolute_tolerance(self.mesh)
        return [*(limit for limit in limits if limit < tolerance), tolerance]

    @property
    def _tolerance(self) -> float:
        """Distance from the surface that nodes may have where it holds the least down."""
        tolerance = self.settings.absolute_tolerance(self.mesh)
        return tolerance if tolerance < np.inf else RELEASE.steps[-1] * self.mesh.mean_edge_length
