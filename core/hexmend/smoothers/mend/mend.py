"""Mend: untangling, the optimum of shape, and the least scaled Jacobian, each a stage in a module of its own."""

from __future__ import annotations

from collections.abc import Generator, Sequence
from dataclasses import dataclass
from itertools import islice

import numpy as np

from hexmend.boundary import SlidingBoundary
from hexmend.boundary.features import AUTO
from hexmend.energy import MeshEnergy, ObjectiveNorm, energy_of
from hexmend.iteration import Outcome, Step
from hexmend.mesh.mesh import Mesh
from hexmend.optimise.maxmin.slp import ActiveCorners, MaxMinOptimiser
from hexmend.parameters import parameter
from hexmend.quality import ElementQuality, measure
from hexmend.quality.corner_heights import least_heights
from hexmend.smoothers.base import Steps, method, objective_of_sound
from hexmend.smoothers.base_optimiser import ObjectiveSmoother
from hexmend.smoothers.mend.inversion import inverted_corners, locked_corners
from hexmend.smoothers.mend.maxmin import MAXMIN, NO_CORNERS, active_set, maximise_minimum
from hexmend.smoothers.mend.messages import freed_message, limit_message, omission_message
from hexmend.smoothers.mend.newton_steps import NewtonConfig
from hexmend.smoothers.mend.off_surface import MaxMinResult, improve_off_surface, raise_within_tolerance
from hexmend.smoothers.mend.release import RELEASE, infeasible, untangle_released
from hexmend.smoothers.mend.shape_optimum import ShapeOptimum, ShapeOptimumConfig, optimise_shape
from hexmend.smoothers.mend.starts import raise_from_better
from hexmend.smoothers.mend.time_step import maximise_time_step
from hexmend.smoothers.mend.untangling import Untangled, UntanglingConfig, untangle

#: Share by which least q and least scaled Jacobian may both fall where a mesh has a target.
_TARGET_FALL = 0.05


@method
@dataclass(frozen=True)
class Mend(ObjectiveSmoother):
    """Untangle with a barrier that hardens step by step, then optimise, by truncated Newton steps of all free nodes."""

    name = "mend"
    title = "Mend"
    help = "Untangles as far as the fixed nodes allow, then finds the optimum of shape or of the worst corner."
    source = "Wilson 5.2.2 and 5.2.4; truncated Newton: Dembo and Steihaug 1983"
    bytes_per_hex = 2200
    keeps_linear_motion = True

    goal: str = parameter(
        "shape",
        choices=("shape", "scaled-jacobian", "time-step"),
        help="shape: minimise (3.3); scaled-jacobian: then also maximise the least scaled Jacobian; time-step: or the "
        "smallest explicit time step, the least height of a hex.",
    )
    max_p: float = parameter(
        1.0, low=1, high=32, help="If higher than p, p is doubled at the optimum up to this value, for the worst hexes."
    )
    initial_epsilon: float = parameter(
        0.03,
        low=1e-6,
        high=1,
        unit="mean edge length³",
        help="e of the first delta, δ² = e (e − worst determinant); it falls until no hex is inverted.",
    )
    guard: bool = parameter(
        False, help="Keep the best iterate that lowers neither the least q(H) nor the least scaled Jacobian."
    )
    solver_iterations: int = parameter(
        200, low=1, high=10**6, help="Iteration limit of conjugate gradients for a Newton step."
    )

    @property
    def norm(self) -> ObjectiveNorm:
        """The highest p and the offset: the objective at whose optimum a run ends.

        Steps with a lower p record the objective with that p instead. Steps that raise the least scaled Jacobian do not
        minimise an energy: they record this one, for comparison, and it may rise.
        """
        return ObjectiveNorm(max(self.p, self.max_p), self.offset)

    @property
    def maximises_jacobian(self) -> bool:
        """The least scaled Jacobian is the goal."""
        return self.goal == "scaled-jacobian"

    @property
    def maximises_minimum(self) -> bool:
        """The least value of a measure of corners is the goal."""
        return self.goal != "shape"

    def steps(self, mesh: Mesh) -> Steps:
        if mesh.linear_motion is not None:
            mesh = mesh.with_points(mesh.constrained(mesh.points))
        yield Step(mesh.points)
        slides = self.slides_on(mesh)
        intermediate = slides or self.maximises_minimum
        quality = measure(mesh.points, mesh.hexes)
        locked_at_start = locked_corners(mesh, quality)
        if slides and mesh.target is not None:  # the boundary begins on the surface
            mesh = mesh.keeping_surface().with_points(self.sliding(mesh).mesh.points)
            quality = measure(mesh.points, mesh.hexes)
        energy = energy_of(mesh, ObjectiveNorm(self.p, self.offset))
        shape = yield from self._shape(mesh, energy, quality, intermediate or mesh.linear_motion is not None)
        if not intermediate:
            return shape.outcome
        fixed_optimum, sliding, fixed = shape.points, None, None  # the optimum with the boundary fixed
        candidates = [mesh.points, fixed_optimum]
        if slides:
            if not measure(fixed_optimum, mesh.hexes).n_inverted:  # sliding ends no lower than the fixed boundary
                fixed = yield from self._maxmin_stage(mesh, candidates, None)
            max_deviation = MAXMIN.surface_share * self.absolute_tolerance(mesh)
            sliding = SlidingBoundary(mesh, self.feature_angle, max_deviation, self.slides)
            mesh = sliding.mesh
            optimiser = MaxMinOptimiser(mesh, fixed_optimum, sliding)
            steps = maximise_minimum(optimiser, MAXMIN.barrier_safe)  # by sliding, until the barrier can be used
            yield from islice(steps, MAXMIN.untangling_iterations)
            shape = yield from self._sliding_shape(sliding, optimiser.points)
            candidates += [optimiser.points, shape.points]
        result = None
        if sliding is not None:
            result = yield from self._untangle_off_surface(sliding, candidates)
        if result is None:
            result = yield from self._maxmin_stage(mesh, candidates, sliding, fixed)
        if sliding is not None:
            result = yield from self._raise_off_surface(sliding, fixed_optimum, result)
        if self.goal == "time-step":
            result = yield from maximise_time_step(mesh, candidates, sliding, result)
        points = shape.points if result is None else result.optimiser.points
        outcome = shape.outcome if result is None else Outcome.NO_IMPROVEMENT
        active, sentences, quality = None, [], None
        if self.maximises_minimum:
            active = active_set(result.optimiser, result.active)
            sentences.append(limit_message(result.optimiser, result.active))
        if slides:
            quality = measure(points, mesh.hexes)
            sentences.append(freed_message(locked_at_start, inverted_corners(points, mesh.hexes, quality)))
        decision = " ".join(filter(None, sentences))
        if decision or outcome is Outcome.NO_IMPROVEMENT:
            yield Step(points, decision=decision, intermediate=True, quality=quality, active=active)
        return outcome

    def _shape(
        self, mesh: Mesh, energy: MeshEnergy, quality: ElementQuality, intermediate: bool
    ) -> Generator[Step, None, ShapeOptimum]:
        """Untangle a mesh whose hexes have this quality, then go to the optimum of shape."""
        newton, locked = NewtonConfig(self.solver_iterations), locked_corners(mesh, quality)
        energy = energy.with_objective(energy.norm, locked)
        untangled = yield from self._untangle(mesh, energy, quality, locked)
        points, omitted = untangled.points, untangled.omitted
        if omitted.any() and not self.slides_on(mesh):
            decision = omission_message(omitted, locked)
            yield Step(points, decision=decision, intermediate=True, quality=untangled.quality, norm=energy.norm)
        energy = energy.with_objective(energy.norm, omitted)
        config = ShapeOptimumConfig(newton=newton)
        return (yield from optimise_shape(energy, points, self.max_p, intermediate, config))

    def _sliding_shape(self, sliding: SlidingBoundary, points: np.ndarray) -> Generator[Step, None, ShapeOptimum]:
        """Untangle a mesh whose boundary slides, from points (n, 3) on, then go to the optimum of shape."""
        energy, quality = (
            energy_of(sliding.mesh, ObjectiveNorm(self.p, self.offset), sliding),
            measure(points, sliding.mesh.hexes),
        )
        return (yield from self._shape(sliding.mesh.with_points(points), energy, quality, True))

    def _maxmin_stage(
        self,
        mesh: Mesh,
        candidates: Sequence[np.ndarray],
        sliding: SlidingBoundary | None,
        fixed: MaxMinResult | None = None,
    ) -> Generator[Step, None, MaxMinResult | None]:
        """Raise the least scaled Jacobian from the best of some points (n, 3), where it is the goal or not sound.

        None where shape is the goal and the least is sound. The result is no lower than `fixed`, that with the boundary
        fixed.
        """
        optimisers = (MaxMinOptimiser(mesh, points, sliding) for points in candidates)
        best = max(optimisers, key=lambda optimiser: optimiser.corners.active_minimum)
        if not self.maximises_jacobian and not best.corners.active_minimum < MAXMIN.barrier_safe:
            return None
        target = np.inf if self.maximises_jacobian else MAXMIN.barrier_safe
        reached = None if fixed is None else MaxMinOptimiser(mesh, fixed.optimiser.points, sliding)

        def raise_least(optimiser: MaxMinOptimiser) -> Generator[Step, None, ActiveCorners]:
            return maximise_minimum(optimiser, target, groups=MAXMIN.max_groups)

        return (yield from raise_from_better(best, reached, raise_least, MAXMIN.trial_iterations))

    def _untangle_off_surface(
        self, sliding: SlidingBoundary, candidates: Sequence[np.ndarray]
    ) -> Generator[Step, None, MaxMinResult | None]:
        """Let nodes leave the surface where the best of some points (n, 3) on it leave hexes inverted.

        None where no hex is inverted, or nodes must not leave the surface, or none is mended by that.
        """
        tolerance, hexes = self.absolute_tolerance(sliding.mesh), sliding.mesh.hexes
        inverted = [measure(points, hexes).n_inverted for points in candidates]
        start = candidates[int(np.argmin(inverted))]
        if not min(inverted) or not 0 < tolerance < np.inf:
            return None
        edge, automatic = sliding.mesh.mean_edge_length, self.surface_tolerance == AUTO
        limits = [share * edge for share in RELEASE.steps] if automatic else [tolerance]
        points, released = yield from untangle_released(sliding, start, self._untangled, limits)
        if measure(points, hexes).n_inverted:
            return None
        optimiser = MaxMinOptimiser(sliding.mesh, points, sliding)
        limit = max(tolerance, optimiser.envelope.largest_deviation(points))
        shape = yield from infeasible(self._sliding_shape(sliding.without_nodes(released, limit), points))
        optimiser = MaxMinOptimiser(sliding.mesh, shape.points, sliding)
        optimiser.release_nodes(released)
        if not self.maximises_jacobian and optimiser.corners.active_minimum >= MAXMIN.barrier_safe:
            return MaxMinResult(optimiser, NO_CORNERS)
        return (yield from raise_within_tolerance(optimiser, limit))

    def _raise_off_surface(
        self, sliding: SlidingBoundary, start: np.ndarray, result: MaxMinResult | None
    ) -> Generator[Step, None, MaxMinResult | None]:
        """Let nodes leave the surface, from points `start` (n, 3) on, where the result on it is low."""
        tolerance, wanted = self.absolute_tolerance(sliding.mesh), MAXMIN.acceptable
        wanted = wanted if self.maximises_jacobian else min(wanted, MAXMIN.barrier_safe)
        if result is None or not 0 < tolerance < np.inf or result.optimiser.corners.movable_minimum >= wanted:
            return result
        optimiser = MaxMinOptimiser(sliding.mesh, start, sliding)
        if self.surface_tolerance == AUTO and measure(result.optimiser.points, sliding.mesh.hexes).n_inverted:
            tolerance = RELEASE.steps[-1] * sliding.mesh.mean_edge_length
        return (yield from improve_off_surface(optimiser, tolerance, result))

    def _untangle(
        self, mesh: Mesh, energy: MeshEnergy, quality: ElementQuality, locked: np.ndarray
    ) -> Generator[Step, None, Untangled]:
        config = UntanglingConfig(self.initial_epsilon, newton=NewtonConfig(self.solver_iterations))
        return (yield from untangle(mesh, energy.without_size(), quality, locked, config))

    def _untangled(self, sliding: SlidingBoundary, points: np.ndarray) -> Generator[Step, None, np.ndarray]:
        """Untangle a mesh whose boundary slides, from points (n, 3) on."""
        mesh = sliding.mesh.with_points(points)
        quality = measure(points, mesh.hexes)
        locked = locked_corners(mesh, quality)
        energy = energy_of(mesh, ObjectiveNorm(self.p, self.offset), sliding).with_objective(self.norm, locked)
        return (yield from self._untangle(mesh, energy, quality, locked)).points

    def rank(self, start: ElementQuality, now: ElementQuality) -> tuple[float, ...]:
        """Sort key of an iterate: the smallest is kept, of equals the last.

        Inverted hexes come first, then whether a guarded figure is lower than at the start, then whether the objective
        of the sound hexes, with the highest p that was asked for, is higher. With a target a fall counts from
        `_TARGET_FALL` on: as given, a mesh may have better corners than hexes of the lengths that are asked for.
        """
        share = 1 - _TARGET_FALL if now.against_target and not self.guard else 1.0
        fallen = (
            now.q.min() < share * start.q.min(),
            now.scaled_jacobian.min() < share * start.scaled_jacobian.min(),
        )
        harmed = any(fallen) if self.guard else all(fallen)
        if self.maximises_jacobian:
            return now.n_inverted, harmed, -now.scaled_jacobian.min()
        if self.goal == "time-step":  # the time step itself comes last, see `rank_by_points`
            return now.n_inverted, harmed if self.guard else False
        before, after = (objective_of_sound(of, self.norm) for of in (start, now))
        return now.n_inverted, harmed, after > before

    def rank_by_points(self, hexes: np.ndarray, points: np.ndarray) -> tuple[float, ...]:
        return (-least_heights(points, hexes).min(),) if self.goal == "time-step" else ()

    def regression_hint(self, worse: tuple[str, ...]) -> str:
        if self.maximises_minimum or "inverted" in worse:
            return ""
        if "scaled_jacobian" in worse:
            return "With goal=scaled-jacobian the least scaled Jacobian rises instead; with guard=true neither falls."
        return "With guard=true it does not fall." if worse else ""
