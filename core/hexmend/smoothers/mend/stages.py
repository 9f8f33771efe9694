"""Stages of mend, one after another: untangling, the optimum of shape, sliding, and what its goal asks for."""

from __future__ import annotations

from collections.abc import Callable, Generator, Sequence
from dataclasses import replace
from itertools import islice

import numpy as np

from hexmend.boundary import SlidingBoundary
from hexmend.energy import SQUARES, MeshEnergy, ObjectiveNorm, energy_of
from hexmend.iteration import Outcome, Step
from hexmend.mesh.mesh import Mesh
from hexmend.optimise.maxmin.slp import ActiveCorners, MaxMinOptimiser
from hexmend.parameters import AUTO
from hexmend.quality import ElementQuality, measure
from hexmend.quality.regressions import WORSE_BY
from hexmend.smoothers.base import Steps
from hexmend.smoothers.mend.balance import balance, raise_jacobian
from hexmend.smoothers.mend.inversion import inverted_corners, locked_corners
from hexmend.smoothers.mend.leaving_surface import LeavingSurface
from hexmend.smoothers.mend.maxmin import MAXMIN, active_set, maximise_minimum
from hexmend.smoothers.mend.mend_settings import MendSettings
from hexmend.smoothers.mend.messages import freed_message, limit_message, omission_message
from hexmend.smoothers.mend.newton_steps import NewtonConfig
from hexmend.smoothers.mend.off_surface import MaxMinResult, raise_to_the_end
from hexmend.smoothers.mend.release import T, infeasible
from hexmend.smoothers.mend.shape_optimum import ShapeOptimum, ShapeOptimumConfig, optimise_shape
from hexmend.smoothers.mend.starts import raise_from_better, while_promising
from hexmend.smoothers.mend.time_step import maximise_time_step
from hexmend.smoothers.mend.untangling import Untangled, UntanglingConfig, untangle


class Stages:
    """Stages of a run of mend.

    Parameters
    ----------
    settings : MendSettings
        The method with its parameters.
    """

    def __init__(self, settings: MendSettings):
        self.settings, self.goal = settings, settings.goal

    def steps(self, mesh: Mesh) -> Steps:
        if mesh.linear_motion is not None:
            mesh = mesh.with_points(mesh.constrained(mesh.points))
        yield Step(mesh.points)
        slides = self.settings.slides_on(mesh)
        intermediate = slides or self.goal != "shape"
        given, locked_at_start = mesh.points, locked_corners(mesh, measure(mesh.points, mesh.hexes))
        if slides and mesh.target is not None:  # the boundary begins on the surface
            mesh = mesh.keeping_surface().with_points(self.settings.sliding(mesh).mesh.points)
            given = mesh.points
            yield Step(given, intermediate=True, quality=measure(given, mesh.hexes), begins=True)
        energy = self._energy(mesh, self.settings.first_norm_on(mesh))
        shape = yield from self._shape(mesh, energy, intermediate or mesh.linear_motion is not None)
        if not intermediate:
            return shape.outcome
        fixed_optimum, sliding, fixed = shape.points, None, None  # the optimum with the boundary fixed
        kept = None  # quality of the result with the boundary fixed, which is that of the run until sliding is better
        candidates = [mesh.points, fixed_optimum]
        if slides:
            fixed, given, kept = yield from self._raise_fixed(mesh, candidates, given)
            sliding = self.sliding_boundary(mesh)
            mesh = sliding.mesh
            optimiser = MaxMinOptimiser(mesh, fixed_optimum, sliding)
            steps = maximise_minimum(optimiser, MAXMIN.barrier_safe)  # by sliding, until the barrier can be used
            yield from keeping(kept, mesh.hexes, islice(steps, MAXMIN.untangling_iterations))
            candidates.append(optimiser.points)
            others = candidates if fixed is not None and self.settings.maximises_jacobian else []
            start = self._start_at_shape(sliding, optimiser.points, others)
            shape = (yield from keeping(kept, mesh.hexes, start)) or shape
            candidates.append(shape.points)
        if sliding is None:
            leaving, result = None, (yield from self._maxmin_stage(mesh, candidates, None))
        else:
            leaving = LeavingSurface(self.settings, sliding, self._untangled, self._sliding_shape)
            leaving, result = yield from self._raise_within_tolerances(leaving, fixed_optimum, candidates, fixed)
        if self.goal == "time-step":
            result = yield from maximise_time_step(mesh, candidates, sliding, result)
        points = shape.points if result is None else result.optimiser.points
        outcome = shape.outcome if result is None else Outcome.NO_IMPROVEMENT
        active, sentences, quality = None, [], None
        if self.settings.balances:
            points, message = yield from self._balance(mesh, points, given, leaving, result, kept)
            sentences.append(message)
        if self.settings.maximises_minimum:
            active = active_set(result.optimiser, result.active)
            sentences.append(limit_message(result.optimiser, result.active))
        if slides:
            quality = measure(points, mesh.hexes)
            sentences.append(freed_message(locked_at_start, inverted_corners(points, mesh.hexes, quality)))
        decision = " ".join(filter(None, sentences))
        if decision or kept is not None or outcome is Outcome.NO_IMPROVEMENT:
            yield Step(points, decision=decision, intermediate=True, quality=quality, active=active)
        return outcome

    def _energy(self, mesh: Mesh, norm: ObjectiveNorm, sliding: SlidingBoundary | None = None) -> MeshEnergy:
        """The energy of a mesh, whose boundary is fixed or slides."""
        return energy_of(mesh, norm, sliding)

    def _raise_fixed(
        self, mesh: Mesh, candidates: Sequence[np.ndarray], given: np.ndarray
    ) -> Generator[Step, None, tuple[MaxMinResult | None, np.ndarray, ElementQuality | None]]:
        """Raise with the boundary fixed, from the last of some points (n, 3), what sliding is to end no lower than.

        Returns the result of raising the minimum scaled Jacobian, the points whose figures the result is not to lower,
        `given` unless the goal is balanced, and their quality then.
        """
        optimum = candidates[-1]
        if measure(optimum, mesh.hexes).n_inverted:
            return None, given, None
        fixed = yield from self._maxmin_stage(mesh, candidates, None)
        if not self.settings.balances:
            return fixed, given, None
        balanced = yield from balance(self._sound_energy(mesh, optimum, None), optimum, given)
        return fixed, balanced.points, measure(balanced.points, mesh.hexes)

    def _balance(
        self,
        mesh: Mesh,
        points: np.ndarray,
        given: np.ndarray,
        leaving: LeavingSurface | None,
        result: MaxMinResult | None,
        kept: ElementQuality | None,
    ) -> Generator[Step, None, tuple[np.ndarray, str]]:
        """Raise the floors from points (n, 3) on; points whose figures are not to fall, and the quality that is kept.

        Returns the points, and a sentence about the floors.
        """
        around, begin = None if leaving is None else leaving.boundary(result), None if kept is None else given
        energy = self._sound_energy(mesh if around is None else around.mesh, points, around)
        steps = balance(energy, points, given, begin=begin)
        if leaving is None or result is None:
            balanced = yield from keeping(kept, mesh.hexes, steps)
            return balanced.points, balanced.message
        balanced = yield from infeasible(steps, every=1)  # steps with released nodes may leave their band
        returned = yield from infeasible(leaving.returned(result, balanced.points))
        return returned.points, balanced.message

    def _raise_within_tolerances(
        self,
        leaving: LeavingSurface,
        optimum: np.ndarray,
        candidates: Sequence[np.ndarray],
        fixed: MaxMinResult | None,
    ) -> Generator[Step, None, tuple[LeavingSurface, MaxMinResult | None]]:
        """Raise the least within the tolerance, then within less where it may come higher; see `_raise_sliding`.

        Returns the better result, and the boundary that it was reached with.
        """
        result, near = (yield from self._raise_sliding(leaving, optimum, candidates, fixed)), leaving
        while self.settings.maximises_jacobian and (near := near.within_less(result)):
            nearer = yield from self._raise_sliding(near, optimum, candidates, fixed)
            if nearer is not None and (result is None or nearer.least > result.least):
                leaving, result = near, nearer
        return leaving, result

    def _raise_sliding(
        self,
        leaving: LeavingSurface,
        optimum: np.ndarray,
        candidates: Sequence[np.ndarray],
        fixed: MaxMinResult | None,
    ) -> Generator[Step, None, MaxMinResult | None]:
        """Raise the least on the surface from the best of some points (n, 3), then with nodes that leave it.

        Nodes leave it from points `optimum` (n, 3) on. The result is no lower than `fixed`, that with the boundary
        fixed; None where nothing is to be raised.
        """
        result = yield from leaving.untangle(optimum, candidates)
        if result is None:
            result = yield from self._maxmin_stage(leaving.mesh, candidates, leaving.sliding, fixed)
            if result is None:
                return None
        on_surface = not result.optimiser.envelope.released.any() and not leaving.nearly_untangled
        direct, tried, released = result, leaving.sliding.max_deviation, None
        for tolerance in leaving.tolerances:
            bands = [band for band in self._bands(leaving.mesh, tolerance) if band > tried]
            if bands and on_surface:
                begun = released is not None
                direct, higher = yield from self._raise_in_wider_bands(leaving.sliding, optimum, direct, bands, begun)
                result = result if begun and not higher.gains(result.least) else higher
                tried = bands[-1]
            result = yield from leaving.raise_least(optimum, result, tolerance)
            on_surface = on_surface and not result.optimiser.envelope.released.any()
            if self.settings.maximises_jacobian and result is not released:
                result = released = yield from self._raise_released(leaving, result)
        return result

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

    def _shape(self, mesh: Mesh, energy: MeshEnergy, intermediate: bool) -> Generator[Step, None, ShapeOptimum]:
        """Untangle a mesh, then go to the optimum of shape."""
        locked = locked_corners(mesh, measure(mesh.points, mesh.hexes))
        energy = energy.with_objective(energy.norm, locked)
        untangled = yield from self._untangle(mesh, energy, locked)
        left = untangled.left(locked, energy)
        if left and energy.norm.p < SQUARES.p and not energy.faceted:
            # Squares weigh the worst hexes more, and untangle some meshes that sums do not.
            again = yield from self._untangle(mesh, energy.with_objective(SQUARES, locked), locked)
            untangled = again if again.left(locked, energy) < left else untangled
        points, omitted = untangled.points, untangled.omitted
        if energy.ranks.any(omitted) and not self.settings.slides_on(mesh):
            decision = omission_message(energy.count(locked), energy.count(omitted & ~locked))
            yield Step(points, decision=decision, intermediate=True, quality=untangled.quality, norm=energy.norm)
        energy = energy.with_objective(energy.norm, omitted)
        config = ShapeOptimumConfig(newton=NewtonConfig(self.settings.solver_iterations, deflated=True))
        steps = optimise_shape(energy, points, self.settings.p_limit, intermediate, config)
        del untangled, points  # large meshes have no memory for what is no longer needed
        return (yield from steps)

    def _sound_energy(self, mesh: Mesh, points: np.ndarray, sliding: SlidingBoundary | None) -> MeshEnergy:
        """The energy that floors are added to, without the corners that are inverted at these points."""
        inverted = inverted_corners(points, mesh.hexes, measure(points, mesh.hexes))
        mean = ObjectiveNorm(1.0, self.settings.offset)
        energy = self._energy(mesh, self.settings.first_norm_on(mesh) if self.settings.balances else mean, sliding)
        return energy.with_objective(energy.norm, inverted)

    def _sliding_shape(self, sliding: SlidingBoundary, points: np.ndarray) -> Generator[Step, None, ShapeOptimum]:
        """Untangle a mesh whose boundary slides, from points (n, 3) on, then go to the optimum of shape."""
        energy = self._energy(sliding.mesh, self.settings.first_norm_on(sliding.mesh), sliding)
        return (yield from self._shape(sliding.mesh.with_points(points), energy, True))

    def _start_at_shape(
        self, sliding: SlidingBoundary, points: np.ndarray, others: Sequence[np.ndarray]
    ) -> Generator[Step, None, ShapeOptimum | None]:
        """Go to the optimum of shape from points (n, 3) on; None where its least is lower than at another start."""
        steps = self._sliding_shape(sliding, points)
        return (yield from while_promising(steps, sliding.mesh, others, MAXMIN.shape_patience))

    def _maxmin_stage(
        self,
        mesh: Mesh,
        candidates: Sequence[np.ndarray],
        sliding: SlidingBoundary | None,
        fixed: MaxMinResult | None = None,
    ) -> Generator[Step, None, MaxMinResult | None]:
        """Raise the minimum scaled Jacobian from the best of some points (n, 3), where it is the goal or not sound.

        None where shape is the goal and the least is sound. The result is no lower than `fixed`, that with the boundary
        fixed.
        """
        optimisers = (MaxMinOptimiser(mesh, points, sliding) for points in candidates)
        best = max(optimisers, key=lambda optimiser: optimiser.corners.active_minimum)
        if not self.settings.maximises_jacobian and not best.corners.active_minimum < MAXMIN.barrier_safe:
            return None
        target = np.inf if self.settings.maximises_jacobian else MAXMIN.barrier_safe
        reached = None if fixed is None else MaxMinOptimiser(mesh, fixed.optimiser.points, sliding)

        def raise_least(optimiser: MaxMinOptimiser) -> Generator[Step, None, ActiveCorners]:
            groups = MAXMIN.max_groups
            if self.settings.maximises_jacobian and optimiser.corners.active_minimum > 0:
                energy = self._sound_energy(mesh, optimiser.points, sliding)
                optimiser.improve_to((yield from raise_jacobian(energy, optimiser.points)))
                groups = 1
            return (yield from maximise_minimum(optimiser, target, groups=groups))

        return (yield from raise_from_better(best, reached, raise_least, MAXMIN.trial_iterations))

    def _bands(self, mesh: Mesh, tolerance: float) -> list[float]:
        """Distances from the surface that quads of the boundary may have while nodes slide, ascending."""
        narrower, widest = np.array(MAXMIN.bands) * mesh.mean_edge_length, MAXMIN.surface_share * tolerance
        if not self.settings.maximises_jacobian:
            return [widest]
        widest = max(widest, min(narrower[0], MAXMIN.first_share * tolerance))
        return [*narrower[narrower < (1 - MAXMIN.worth_widening) * widest], widest]

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

    def _raise_released(self, leaving: LeavingSurface, result: MaxMinResult) -> Generator[Step, None, MaxMinResult]:
        """Raise along the central path where nodes have left the surface, then to the end."""
        if not result.optimiser.envelope.released.any() or not result.least > 0:
            return result
        around = leaving.boundary(result)
        energy = self._sound_energy(around.mesh, result.optimiser.points, around)
        points = yield from infeasible(raise_jacobian(energy, result.optimiser.points))
        optimiser = yield from infeasible(leaving.returned(result, points))
        if not optimiser.corners.movable_minimum > MAXMIN.returned_share * result.least:
            return result
        higher = yield from infeasible(raise_to_the_end(MaxMinResult(optimiser, None)))
        if not higher.least > result.least:
            return result
        yield higher.step()
        return higher

    def _untangle(self, mesh: Mesh, energy: MeshEnergy, locked: np.ndarray) -> Generator[Step, None, Untangled]:
        config = UntanglingConfig(self.settings.initial_epsilon, newton=NewtonConfig(self.settings.solver_iterations))
        return (yield from untangle(mesh, energy.without_size(), locked, config))

    def _untangled(self, sliding: SlidingBoundary, points: np.ndarray) -> Generator[Step, None, np.ndarray]:
        """Untangle a mesh whose boundary slides, from points (n, 3) on."""
        mesh = sliding.mesh.with_points(points)
        locked = locked_corners(mesh, measure(points, mesh.hexes))
        energy = self._energy(mesh, self.settings.first_norm_on(mesh), sliding)
        energy = energy.with_objective(self.settings.norm, locked)
        return (yield from self._untangle(mesh, energy, locked)).points


def _is_lower(now: ElementQuality, kept: ElementQuality) -> bool:
    """Return True if a hex is inverted, or one of the least values is lower."""
    pairs = (now.q, kept.q), (now.scaled_jacobian, kept.scaled_jacobian)
    return now.n_inverted > 0 or any(new.min() < old.min() - WORSE_BY for new, old in pairs)


def keeping(
    kept: ElementQuality | None,
    hexes: np.ndarray,
    steps: Generator[Step, None, T],
    is_lower: Callable[[ElementQuality, ElementQuality], bool] = _is_lower,
) -> Generator[Step, None, T]:
    """Yield steps of a mesh with hexes (m, 8), as infeasible ones while a figure is lower than one that is kept."""
    if kept is None:
        return (yield from steps)
    while True:
        try:
            step = next(steps)
        except StopIteration as end:
            return end.value
        quality = step.quality if step.quality is not None else measure(step.points, hexes)
        yield replace(step, quality=quality, infeasible=step.infeasible or is_lower(quality, kept))
