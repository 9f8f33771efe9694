"""Stages of mend, one after another: untangling, the optimum of shape, sliding, and what its goal asks for."""

from __future__ import annotations

from collections.abc import Callable, Generator, Sequence
from dataclasses import replace

import numpy as np

from hexmend.arrays import mask
from hexmend.iteration import Outcome, Step
from hexmend.mesh.mesh import Mesh
from hexmend.optimise.maxmin.slp_config import SLP
from hexmend.quality import ElementQuality, measure
from hexmend.quality.regressions import WORSE_BY
from hexmend.smoothers.base import Steps
from hexmend.smoothers.mend.balance import balance
from hexmend.smoothers.mend.certification import certify_hexes, curable_hexes
from hexmend.smoothers.mend.inversion import inverted_corners, locked_corners
from hexmend.smoothers.mend.maxmin import active_set
from hexmend.smoothers.mend.messages import certified_message, freed_message, limit_message
from hexmend.smoothers.mend.surface.detours import MaxMinResult
from hexmend.smoothers.mend.surface.leaving_surface import LeavingSurface
from hexmend.smoothers.mend.surface.maxmin_stages import MaxMinStages
from hexmend.smoothers.mend.surface.release import T, infeasible
from hexmend.smoothers.mend.time_step import maximise_time_step


class Stages(MaxMinStages):
    """Stages of a run of mend."""

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
        steps = self._shape(mesh, energy, intermediate or mesh.linear_motion is not None)
        del energy  # large meshes have no memory for what is no longer needed
        shape = yield from steps if intermediate else until_valid(steps, mesh)
        if not intermediate:
            yield from self._certify(mesh, shape.points, None, None)
            return shape.outcome
        sliding = None
        kept = None  # quality of the result with the boundary fixed, which is that of the run until sliding is better
        at_rest = [mesh.points, shape.points]  # with the boundary fixed
        if slides:
            fixed, given, kept = yield from self._raise_fixed(mesh, at_rest, given)
            sliding = self.sliding_boundary(mesh)
            mesh = sliding.mesh
            starts = yield from keeping(kept, mesh.hexes, self.start_sliding(sliding, at_rest, fixed is not None))
            shape, candidates = starts.shape or shape, starts.points
            leaving, result = yield from self._raise_within_tolerances(sliding, at_rest, starts, fixed)
        else:
            candidates, leaving = at_rest, None
            result = yield from self._maxmin_stage(mesh, candidates, None)
        if self.settings.maximises_jacobian and result.least > 0:
            result = yield from self._improve_shape(mesh, leaving, result)
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
        certified = yield from self._certify(mesh, points, leaving, result)
        if certified is not points:
            sentences.append(certified_message(measure(points, mesh.hexes), measure(certified, mesh.hexes)))
            points = certified
        if slides:
            quality = measure(points, mesh.hexes)
            sentences.append(freed_message(locked_at_start, inverted_corners(points, mesh.hexes, quality)))
        decision = " ".join(filter(None, sentences))
        if decision or kept is not None or outcome is Outcome.NO_IMPROVEMENT:
            yield Step(points, decision=decision, intermediate=True, quality=quality, active=active)
        return outcome

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

    def _certify(
        self, mesh: Mesh, points: np.ndarray, leaving: LeavingSurface | None, result: MaxMinResult | None
    ) -> Generator[Step, None, np.ndarray]:
        """Make hexes valid that are invalid between positive corners, from points (n, 3) on.

        Where the boundary holds them, its nodes at these hexes leave the surface within the tolerance.
        """
        around = None if leaving is None else leaving.boundary(result)
        energy = self._sound_energy(mesh if around is None else around.mesh, points, around)
        points = yield from certify_hexes(energy, points)
        if leaving is None:
            return points
        left = curable_hexes(around.mesh, measure(points, mesh.hexes))
        for wider, limit in leaving.released(result, mask(mesh.hexes[left], mesh.n_nodes)):
            energy = self._sound_energy(wider.mesh, points, wider)
            found = yield from infeasible(certify_hexes(energy, points), every=1)
            fewer = measure(found, mesh.hexes).n_invalid < measure(points, mesh.hexes).n_invalid
            if fewer and leaving.deviation(found) <= limit * (1 + SLP.band_excess):
                points = found
                yield Step(points, intermediate=True)
            if not curable_hexes(around.mesh, measure(points, mesh.hexes)).any():
                break
        return points


def until_valid(steps: Generator[Step, None, T], mesh: Mesh) -> Generator[Step, None, T]:
    """Yield steps, as intermediate ones while hexes are invalid that can become valid: these are made so afterwards."""
    while True:
        try:
            step = next(steps)
        except StopIteration as end:
            return end.value
        quality = step.quality if step.quality is not None else measure(step.points, mesh.hexes)
        curable = not step.intermediate and curable_hexes(mesh, quality).any()
        yield replace(step, quality=quality, intermediate=step.intermediate or bool(curable))


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
