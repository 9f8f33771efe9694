"""Stages of mend, one after another: untangling, the optimum of shape, the goal, sliding, and the certificate."""

from __future__ import annotations

from collections.abc import Callable, Generator, Iterator
from dataclasses import replace
from itertools import repeat
from typing import TypeVar

import numpy as np

from hexmend.boundary import SlidingBoundary
from hexmend.energy import MeshEnergy
from hexmend.energy.hex_energy import unpack_corners
from hexmend.iteration import Outcome, Step, map_steps
from hexmend.mesh.fixing import with_pinned
from hexmend.mesh.mesh import Mesh
from hexmend.mesh.solid_cells import corner_tetrahedra
from hexmend.parameters import AUTO
from hexmend.quality import ElementQuality, measure
from hexmend.quality.regressions import WORSE_BY
from hexmend.smoothers.base import Steps
from hexmend.smoothers.mend.certification import certify_hexes, curable_hexes
from hexmend.smoothers.mend.floors import BARRIER_SAFE
from hexmend.smoothers.mend.free_boundary import RETURN, FreeBoundary, tolerances_of
from hexmend.smoothers.mend.goals import STEP_OF_LEAST, Reached, reach_goal, step_floor
from hexmend.smoothers.mend.inversion import inverted_corners, locked_corners
from hexmend.smoothers.mend.messages import certified_message, freed_message
from hexmend.smoothers.mend.shape_stages import ShapeStages

T = TypeVar("T")


class Stages(ShapeStages):
    """Stages of a run of mend."""

    def steps(self, mesh: Mesh) -> Steps:
        if mesh.linear_motion is not None:
            mesh = mesh.with_points(mesh.constrained(mesh.points))
        yield Step(mesh.points)
        slides = self.settings.slides_on(mesh)
        intermediate = slides or self.goal != "shape"
        given = measure(mesh.points, mesh.elements)
        locked_at_start = locked_corners(mesh, given)
        mean = -np.inf if given.n_inverted else float(given.q.mean())
        del given  # large meshes have no memory for what is no longer needed
        if slides and mesh.target is not None:  # the boundary begins on the surface
            mesh = mesh.keeping_surface().with_points(self.settings.sliding(mesh).mesh.points)
            yield Step(mesh.points, intermediate=True, quality=measure(mesh.points, mesh.elements), begins=True)
        energy = self._energy(mesh, self.settings.norm_on(mesh))
        steps = self._shape(mesh, energy, intermediate or mesh.linear_motion is not None)
        del energy
        shape = yield from steps if intermediate else until_valid(steps, mesh)
        energy = self._sound(self._energy(mesh, self.settings.norm_on(mesh)), shape.points)
        if not intermediate:
            yield from certify_hexes(repeat(energy), shape.points)
            return shape.outcome
        starts = [mesh.points, shape.points]
        reached = yield from reach_goal(self.settings, energy, starts, mesh.points, mean)
        moved, energies = reached.points is not shape.points, repeat(energy)
        if slides:
            energies, reached = yield from self._slide(mesh, reached, mean)
        certified = yield from certify_hexes(energies, reached.points)
        if reached.boundary is not None and certified is not reached.points:
            exact = reached.boundary.exact(certified)
            is_valid = measure(exact, mesh.elements).n_invalid <= measure(certified, mesh.elements).n_invalid
            certified = exact if is_valid else reached.points
        sentences, quality = [reached.message], None
        if certified is not reached.points:
            sentences.append(
                certified_message(measure(reached.points, mesh.elements), measure(certified, mesh.elements))
            )
        if slides:
            quality = measure(certified, mesh.elements)
            sentences.append(freed_message(locked_at_start, inverted_corners(certified, mesh.elements, quality)))
        decision = " ".join(filter(None, sentences))
        if decision or moved:
            yield Step(certified, decision=decision, intermediate=True, quality=quality, active=reached.active)
        return Outcome.NO_IMPROVEMENT if moved else shape.outcome

    def sliding_boundary(self, mesh: Mesh) -> SlidingBoundary:
        """The boundary that slides; a tolerance in numbers says how far its sets too may move."""
        settings = self.settings
        holds = settings.surface_tolerance == AUTO
        return SlidingBoundary(
            mesh, settings.feature_angle, settings.absolute_tolerance(mesh), settings.slides, sets_hold=holds
        )

    def _slide(
        self, mesh: Mesh, fixed: Reached, mean: float
    ) -> Generator[Step, None, tuple[Iterator[MeshEnergy], Reached]]:
        """Move the boundary within its tolerance of the surface, from the result with the boundary fixed on.

        Returns energies of the boundary, with wider tolerances where none is given, and the result: that with the
        boundary fixed where hexes are not untangled within a tolerance that was given.
        """
        settings, hexes, points = self.settings, mesh.elements, fixed.points
        quality = measure(points, hexes)
        mesh = _holding_overlaps(mesh, points, quality)
        sliding = self.sliding_boundary(mesh)
        tolerances = tolerances_of(settings.surface_tolerance, settings.absolute_tolerance(mesh), mesh)
        free = FreeBoundary(sliding, quality.invalid, tolerances, settings.norm_on(mesh))
        is_sound, given = not quality.n_inverted, mesh.points if quality.n_inverted else points
        kept = quality if is_sound and (settings.balances or settings.maximises_jacobian) else None
        is_lower = _is_lower if settings.balances else _has_lower_jacobian
        wider = settings.surface_tolerance == AUTO
        if not is_sound:
            locked = locked_corners(free.mesh, quality)
            points, is_within = yield from free.untangle(points, locked, wider)
            if not is_within:
                return repeat(self._sound(free.fitted, points)), fixed._replace(points=points)
            free = free.allowing(points, everywhere=wider)
            around, points = free.returned(points, BARRIER_SAFE, 0.0)
            energy = around.fitted
        starts = [points]
        if is_sound:  # the shape improves faster along the surface itself
            width = max(tolerances.patches, 1e-9) * mesh.mean_edge_length
            energy = MeshEnergy.on_surface(sliding.with_band(width), settings.norm_on(mesh))
        if not (is_sound and settings.maximises_jacobian):
            shape = yield from keeping(kept, hexes, self._optimum(energy, points), is_lower)
            starts.append(shape.points)
        free = free.allowing(starts[-1], everywhere=True)
        energy = self._sound(free.fitted, starts[-1])
        reached = yield from keeping(kept, hexes, reach_goal(settings, energy, starts, given, mean, free), is_lower)
        free = reached.boundary or free
        quality = measure(reached.points, hexes)
        least, least_q = float(quality.scaled_jacobian.min()), float(quality.q.min())
        floor = step_floor(least) if least > 0 else least
        snapped, _ = free.snapped(
            reached.points, floor, least_q if settings.balances else (1 - STEP_OF_LEAST) * least_q
        )
        lower = kept is not None and is_lower(measure(snapped, hexes), kept)
        yield Step(snapped, intermediate=True, infeasible=lower)
        free = free.allowing(snapped, everywhere=True)
        fitted = (free.widened(factor).fitted for factor in (RETURN.wider if wider else repeat(1.0)))
        return (self._sound(each, snapped) for each in fitted), reached._replace(points=snapped, boundary=free)


def _holding_overlaps(mesh: Mesh, points: np.ndarray, quality: ElementQuality) -> Mesh:
    """Return the mesh at points (n, 3) with the nodes pinned of inverted corners that are so wherever they are."""
    overlapping = np.zeros(mesh.n_elements, dtype=bool)
    overlapping[mesh.topology.overlapping_corners.items // 8] = True
    hopeless = quality.inverted & overlapping & ~curable_hexes(mesh, quality)
    corners = unpack_corners(inverted_corners(points, mesh.elements, quality))[hopeless]
    if not corners.any():
        return mesh
    nodes = corner_tetrahedra(mesh.elements[hopeless])[corners].ravel()
    return with_pinned(mesh.keeping_surface().with_points(points), nodes)


def until_valid(steps: Generator[Step, None, T], mesh: Mesh) -> Generator[Step, None, T]:
    """Yield steps, as intermediate ones while hexes are invalid that can become valid: these are made so afterwards."""

    def judged(step: Step) -> Step:
        quality = step.quality if step.quality is not None else measure(step.points, mesh.elements)
        curable = not step.intermediate and curable_hexes(mesh, quality).any()
        return replace(step, quality=quality, intermediate=step.intermediate or bool(curable))

    return map_steps(steps, judged)


def _is_lower(now: ElementQuality, kept: ElementQuality) -> bool:
    """Return True if a hex is inverted, or one of the least values is lower."""
    pairs = (now.q, kept.q), (now.scaled_jacobian, kept.scaled_jacobian)
    return now.n_inverted > 0 or any(new.min() < old.min() - WORSE_BY for new, old in pairs)


def _has_lower_jacobian(now: ElementQuality, kept: ElementQuality) -> bool:
    """Return True if a hex is inverted, or the minimum scaled Jacobian is lower."""
    return now.n_inverted > 0 or now.scaled_jacobian.min() < kept.scaled_jacobian.min()


def keeping(
    kept: ElementQuality | None,
    hexes: np.ndarray,
    steps: Generator[Step, None, T],
    is_lower: Callable[[ElementQuality, ElementQuality], bool] = _is_lower,
) -> Generator[Step, None, T]:
    """Yield steps of a mesh with hexes (m, 8); a step is infeasible while a figure is below its kept value."""
    if kept is None:
        return steps

    def judged(step: Step) -> Step:
        quality = step.quality if step.quality is not None else measure(step.points, hexes)
        return replace(step, quality=quality, infeasible=step.infeasible or is_lower(quality, kept))

    return map_steps(steps, judged)
