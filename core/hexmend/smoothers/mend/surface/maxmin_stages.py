"""Stages of mend that raise the minimum scaled Jacobian, within one tolerance of the surface after another."""

from __future__ import annotations

from collections.abc import Generator, Sequence
from dataclasses import replace

import numpy as np

from hexmend.boundary import SlidingBoundary
from hexmend.iteration import Step
from hexmend.mesh.mesh import Mesh
from hexmend.optimise.floors.central_path import PATH
from hexmend.optimise.maxmin.corner_set import least_movable
from hexmend.optimise.maxmin.slp import MaxMinOptimiser
from hexmend.optimise.maxmin.slp_config import SLP
from hexmend.optimise.maxmin.slp_step import ActiveCorners
from hexmend.parameters import AUTO
from hexmend.smoothers.mend.balance import improve_above_least, raise_jacobian
from hexmend.smoothers.mend.maxmin import MAXMIN, maximise_minimum
from hexmend.smoothers.mend.shape_stages import ShapeStages, SlidingStarts
from hexmend.smoothers.mend.surface.detours import MaxMinResult, raise_to_the_end
from hexmend.smoothers.mend.surface.leaving_surface import LeavingSurface
from hexmend.smoothers.mend.surface.release import infeasible
from hexmend.smoothers.mend.surface.starts import improve_within_reach, raise_from_better


class MaxMinStages(ShapeStages):
    """Stages that raise the minimum scaled Jacobian: boundary fixed, sliding in wider and wider bands, or left."""

    def sliding_boundary(self, mesh: Mesh) -> SlidingBoundary:
        """The boundary in the narrowest band; a tolerance in numbers says how far its sets too may move."""
        settings = self.settings
        sets_hold = settings.surface_tolerance == AUTO
        return SlidingBoundary(
            mesh,
            settings.feature_angle,
            self._bands(mesh, settings.absolute_tolerance(mesh))[0],
            settings.slides,
            sets_hold,
        )

    def _raise_within_tolerances(
        self,
        sliding: SlidingBoundary,
        at_rest: Sequence[np.ndarray],
        starts: SlidingStarts,
        fixed: MaxMinResult | None,
    ) -> Generator[Step, None, tuple[LeavingSurface, MaxMinResult | None]]:
        """Raise the least within the tolerance, then within smaller ones where it may come higher.

        Parameters
        ----------
        sliding : SlidingBoundary
        at_rest : sequence of (n, 3) float64
            Points with the boundary fixed, the optimum of shape last.
        starts : SlidingStarts
        fixed : MaxMinResult, optional
            With the boundary fixed.

        Returns
        -------
        LeavingSurface, MaxMinResult
            The best result, see `_raise_sliding`, and the boundary that it was reached with.
        """
        leaving = LeavingSurface(self.settings, sliding, self._untangled, self._sliding_shape)
        result, near = (yield from self._raise_sliding(leaving, at_rest, starts, fixed)), leaving
        while self.settings.maximises_jacobian and (smaller := near.smaller_tolerance(result)):
            settings = replace(self.settings, surface_tolerance=smaller)
            band = self._bands(sliding.mesh, settings.absolute_tolerance(sliding.mesh))[0]
            near = LeavingSurface(settings, sliding.with_band(band), self._untangled, self._sliding_shape, result)
            starts = yield from self.start_sliding(near.sliding, at_rest, fixed is not None)
            nearer = yield from self._raise_sliding(near, at_rest, starts, fixed)
            if nearer is not None and (result is None or nearer.is_better_than(result)):
                leaving, result = near, nearer
        return leaving, result

    def _raise_sliding(
        self,
        leaving: LeavingSurface,
        at_rest: Sequence[np.ndarray],
        starts: SlidingStarts,
        fixed: MaxMinResult | None,
    ) -> Generator[Step, None, MaxMinResult | None]:
        """Raise the least on the surface from the best of some starts, then with nodes that leave it.

        Nodes leave it from the last points of `at_rest` on. The result is no lower than `fixed`, that with the boundary
        fixed; None where nothing is to be raised, or the best result within other tolerances is out of reach.
        """
        optimum, candidates = at_rest[-1], starts.points
        result = yield from leaving.untangle(optimum, candidates)
        if result is None:
            wanted, to_reach = MAXMIN.acceptable if leaving.may_leave else -np.inf, leaving.least_to_reach
            stage = self._maxmin_stage(leaving.mesh, candidates, leaving.sliding, fixed, max(wanted, to_reach))
            result = yield from stage
            if result is None or (result.active is None and to_reach > wanted):
                return None
        was_left = result.active is None  # the surface, before the least was as high there as it can be
        result = yield from self._raise_on_and_off(leaving, optimum, result)
        if was_left and not result.optimiser.envelope.released.any():
            result = yield from self._maxmin_stage(leaving.mesh, [result.optimiser.points], leaving.sliding)
            result = yield from self._raise_on_and_off(leaving, optimum, result)
        if starts.passed_over and not result.least > 0:
            shape = yield from self._sliding_shape(leaving.sliding, candidates[-1])
            slid = yield from self._maxmin_stage(leaving.mesh, [*candidates, shape.points], leaving.sliding)
            result = slid if slid is not None and slid.is_better_than(result) else result
        return result

    def _raise_on_and_off(
        self, leaving: LeavingSurface, optimum: np.ndarray, result: MaxMinResult
    ) -> Generator[Step, None, MaxMinResult]:
        """Raise the least further from a result, in wider bands on the surface, then with nodes that leave it."""
        on_surface = self.settings.maximises_jacobian and not leaving.nearly_untangled
        on_surface = on_surface and not result.optimiser.envelope.released.any() and result.active is not None
        direct, tried, released = result, leaving.sliding.max_deviation, None
        for tolerance in leaving.tolerances:
            bands = self._bands(leaving.mesh, leaving.sliding_tolerance(tolerance))
            bands = [band for band in bands if band > tried * (1 + SLP.band_excess)]
            if bands and on_surface:
                begun = released is not None
                direct, higher = yield from self._raise_in_wider_bands(leaving.sliding, optimum, direct, bands, begun)
                result = result if begun and not higher.gains(result.least) else higher
                tried = bands[-1]
            result = yield from leaving.raise_least(optimum, result, tolerance)
            on_surface = on_surface and not result.optimiser.envelope.released.any()
            if self.settings.maximises_jacobian:
                result = released = yield from self._raise_released(leaving, result, tolerance, result is released)
        return result

    def _maxmin_stage(
        self,
        mesh: Mesh,
        candidates: Sequence[np.ndarray],
        sliding: SlidingBoundary | None,
        fixed: MaxMinResult | None = None,
        wanted: float = -np.inf,
    ) -> Generator[Step, None, MaxMinResult | None]:
        """Raise the minimum scaled Jacobian from the best of some points (n, 3), where it is the goal or not sound.

        None where shape is the goal and the least is sound. The result is no lower than `fixed`, that with the boundary
        fixed. It names no active corners where it becomes clear that the central path does not reach `wanted`.
        """
        minima = [least_movable(mesh, points) for points in candidates]
        start = int(np.argmax(minima))
        if not self.settings.maximises_jacobian and not minima[start] < MAXMIN.barrier_safe:
            return None
        best = MaxMinOptimiser(mesh, candidates[start], sliding)
        target = np.inf if self.settings.maximises_jacobian else MAXMIN.barrier_safe
        reached = None if fixed is None else MaxMinOptimiser(mesh, fixed.optimiser.points, sliding)

        def raise_least(optimiser: MaxMinOptimiser) -> Generator[Step, None, ActiveCorners | None]:
            groups = MAXMIN.max_groups
            if self.settings.maximises_jacobian and 0 < optimiser.corners.active_minimum < np.inf:
                energy = self._sound_energy(mesh, optimiser.points, sliding)
                steps = raise_jacobian(energy, optimiser.points)
                if not (yield from improve_within_reach(optimiser, steps, wanted, PATH.max_floors)):
                    return None
                groups = 1
            return (yield from maximise_minimum(optimiser, target, groups=groups))

        return (yield from raise_from_better(best, reached, raise_least, MAXMIN.trial_iterations))

    def _improve_shape(
        self, mesh: Mesh, leaving: LeavingSurface | None, result: MaxMinResult
    ) -> Generator[Step, None, MaxMinResult]:
        """Improve the shape above the least values of a result; programs regain what that costs of the least.

        Nodes that do not limit the least are where its rise has left them. Returns `result` where the least is lower by
        more than programs leave.
        """
        around = None if leaving is None else leaving.boundary(result)
        energy = self._sound_energy(mesh if around is None else around.mesh, result.optimiser.points, around)
        points = yield from infeasible(improve_above_least(energy, result.optimiser.points), every=1)
        if leaving is None:
            optimiser = result.optimiser.fork()
            optimiser.move_to(points)
        else:
            optimiser = yield from infeasible(leaving.returned(result, points))
        with optimiser.envelope.relaxed(optimiser.envelope.max_deviation):
            active = yield from infeasible(maximise_minimum(optimiser, patient_below=result.least))
        improved = MaxMinResult(optimiser, active)
        if improved.least < result.least - MAXMIN.regained:
            return result
        yield improved.step()
        return improved

    def _bands(self, mesh: Mesh, tolerance: float) -> list[float]:
        """Distances from the surface that quads of the boundary may have while nodes slide, ascending."""
        narrower, widest = np.array(MAXMIN.bands) * mesh.mean_edge_length, MAXMIN.surface_share * tolerance
        if not self.settings.maximises_jacobian:
            return [widest]
        widest = max(widest, min(narrower[0], MAXMIN.first_share * tolerance))
        return [*narrower[narrower < MAXMIN.distinct * widest], widest]

    def _raise_in_wider_bands(
        self,
        sliding: SlidingBoundary,
        points: np.ndarray,
        direct: MaxMinResult,
        bands: Sequence[float],
        anyway: bool,
    ) -> Generator[Step, None, tuple[MaxMinResult, MaxMinResult]]:
        """Let quads of the boundary be further from its surface, where that raises the least by much.

        Each band, ascending, begins at the result of the narrower one, which does not depend on those that follow. A
        band raises nothing where the least is at a maximum that the narrower one does not limit. For points (n, 3) see
        `_raise_once_more`, which comes last; with `anyway` where no band raises the least, too.

        Returns the result without that, where still wider bands begin, and the result with it.
        """
        narrow = direct
        for band in bands:
            if direct.optimiser.at_maximum and not direct.optimiser.band_limits:
                break
            wide = sliding.with_band(band)
            higher = yield from infeasible(self._maxmin_stage(sliding.mesh, [direct.optimiser.points], wide))
            if not higher.gains(direct.least):
                break
            direct = higher
            yield direct.step()
        if direct.least < MAXMIN.acceptable or (direct is narrow and not anyway):  # nodes leave where it is too low
            return direct, direct
        return direct, (yield from self._raise_once_more(sliding.with_band(bands[-1]), points, direct))

    def _raise_once_more(
        self, wide: SlidingBoundary, points: np.ndarray, result: MaxMinResult
    ) -> Generator[Step, None, MaxMinResult]:
        """Raise once more in a wider band.

        This begins at the optimum of shape in that band, where that is higher; it is reached from points (n, 3) on.
        Otherwise it begins at the result, unless linear programs have shown that no step from there raises the least.
        Where the band matters, the goal `shape`, whose band is that one, may end higher otherwise.
        """
        candidates = [result.optimiser.points]
        shape = yield from infeasible(self._start_at_shape(wide, points, candidates))
        if shape is not None:
            candidates.append(shape.points)
        elif result.optimiser.at_maximum:
            return result
        higher = yield from infeasible(self._maxmin_stage(wide.mesh, candidates, wide))
        if not higher.least > result.least:
            return result
        yield higher.step()
        return higher

    def _raise_released(
        self, leaving: LeavingSurface, result: MaxMinResult, tolerance: float, only_wider: bool
    ) -> Generator[Step, None, MaxMinResult]:
        """Raise the least where nodes have left the surface: within the tolerance, if that gains enough.

        Otherwise it is raised in the band of the result, unless `only_wider` says that it was already.
        """
        if not result.optimiser.envelope.released.any() or not result.least > 0:
            return result
        if result.optimiser.envelope.max_deviation * (1 + SLP.band_excess) < tolerance:
            wide = result.optimiser.fork()
            wide.envelope.limit_to(tolerance)
            higher = yield from self._raise_along_path(leaving, MaxMinResult(wide, None))
            if higher is not None and higher.gains(result.least, MAXMIN.worth_leaving):
                yield higher.step()
                return higher
        higher = None if only_wider else (yield from self._raise_along_path(leaving, result))
        if higher is None or not higher.least > result.least:
            return result
        yield higher.step()
        return higher

    def _raise_along_path(
        self, leaving: LeavingSurface, start: MaxMinResult
    ) -> Generator[Step, None, MaxMinResult | None]:
        """Raise along the central path from a start in its band, then to the end; None where the path ends too low."""
        around = leaving.boundary(start)
        energy = self._sound_energy(around.mesh, start.optimiser.points, around)
        points = yield from infeasible(raise_jacobian(energy, start.optimiser.points))
        optimiser = yield from infeasible(leaving.returned(start, points))
        if not optimiser.corners.movable_minimum > MAXMIN.returned_share * start.least:
            return None
        return (yield from infeasible(raise_to_the_end(MaxMinResult(optimiser, None))))
