"""Mend: untangling, the optimum of shape, and the least scaled Jacobian, each a stage in a module of its own."""

from __future__ import annotations

from collections.abc import Generator, Sequence
from dataclasses import dataclass

import numpy as np

from hexmend.boundary import SlidingBoundary
from hexmend.energy import MeshEnergy, ObjectiveNorm, energy_of
from hexmend.iteration import Outcome, Step
from hexmend.mesh.mesh import Mesh
from hexmend.optimise.maxmin.slp import MaxMinOptimiser
from hexmend.parameters import parameter
from hexmend.quality import ElementQuality, measure
from hexmend.quality.corner_heights import least_heights
from hexmend.smoothers.base import Steps, method, objective_of_sound
from hexmend.smoothers.base_optimiser import ObjectiveSmoother
from hexmend.smoothers.mend.balance import balance, raise_jacobian
from hexmend.smoothers.mend.inversion import inverted_corners, locked_corners
from hexmend.smoothers.mend.maxmin import MAXMIN, active_set, maximise_minimum
from hexmend.smoothers.mend.messages import freed_message, limit_message, omission_message
from hexmend.smoothers.mend.newton_steps import NewtonConfig
from hexmend.smoothers.mend.off_surface import MaxMinResult, improve_off_surface
from hexmend.smoothers.mend.shape_optimum import ShapeOptimum, ShapeOptimumConfig, optimise_shape
from hexmend.smoothers.mend.time_step import maximise_time_step
from hexmend.smoothers.mend.untangling import UntanglingConfig, untangle

#: Share by which least q and least scaled Jacobian may both fall where a mesh has a target.
_TARGET_FALL = 0.05


@method
@dataclass(frozen=True)
class Mend(ObjectiveSmoother):
    """Untangle with a barrier that hardens step by step, then optimise, by truncated Newton steps of all free nodes."""

    name = "mend"
    title = "Mend"
    help = "Untangles as far as the fixed nodes allow, then finds the best shape in which no figure is lower than before."
    source = "Wilson 5.2.2 and 5.2.4; truncated Newton: Dembo and Steihaug 1983"
    bytes_per_hex = 2200
    keeps_linear_motion = True

    goal: str = parameter(
        "balanced",
        choices=("balanced", "shape", "scaled-jacobian", "time-step"),
        help="balanced: the best mean shape above floors of the least scaled Jacobian and q(H), which rise first; shape: "
        "minimise (3.3); scaled-jacobian: then also maximise the least scaled Jacobian; time-step: or the smallest "
        "explicit time step, the least height of a hex.",
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
        minimise an energy: they record this one, for comparison, and it may rise. With the goal balanced p is 1.
        """
        return ObjectiveNorm(1.0 if self.balances else max(self.p, self.max_p), self.offset)

    @property
    def balances(self) -> bool:
        """The best shape above floors is the goal."""
        return self.goal == "balanced"

    @property
    def maximises_jacobian(self) -> bool:
        """The least scaled Jacobian is the goal."""
        return self.goal == "scaled-jacobian"

    @property
    def maximises_minimum(self) -> bool:
        """The least value of a measure of corners is the goal."""
        return self.goal in ("scaled-jacobian", "time-step")

    def steps(self, mesh: Mesh) -> Steps:
        if mesh.linear_motion is not None:
            mesh = mesh.with_points(mesh.constrained(mesh.points))
        yield Step(mesh.points)
        slides, norm = self.slides_on(mesh), ObjectiveNorm(1.0 if self.balances else self.p, self.offset)
        intermediate = slides or self.goal != "shape"
        given, quality = mesh.points, measure(mesh.points, mesh.hexes)
        locked_at_start = locked_corners(mesh, quality)
        if slides and mesh.target is not None:  # the boundary begins on the surface
            mesh = mesh.keeping_surface().with_points(self.sliding(mesh).mesh.points)
            quality = measure(mesh.points, mesh.hexes)
        energy = energy_of(mesh, norm)
        shape = yield from self._shape(mesh, energy, quality, intermediate or mesh.linear_motion is not None)
        if not intermediate:
            return shape.outcome
        fixed_optimum, sliding, max_deviation = shape.points, None, 0.0  # the optimum with the boundary fixed
        candidates = [mesh.points, fixed_optimum]
        if slides:
            max_deviation = self.absolute_tolerance(mesh)
            sliding = SlidingBoundary(mesh, self.feature_angle, MAXMIN.surface_share * max_deviation, self.slides)
            mesh = sliding.mesh
            optimiser = MaxMinOptimiser(mesh, fixed_optimum, sliding)
            yield from maximise_minimum(optimiser, MAXMIN.barrier_safe)  # by sliding, until the barrier can be used
            freed = mesh.with_points(optimiser.points)
            quality = measure(freed.points, mesh.hexes)
            shape = yield from self._shape(freed, energy_of(mesh, norm, sliding), quality, intermediate)
            candidates += [freed.points, shape.points]
        result = yield from self._maxmin_stage(mesh, candidates, fixed_optimum, sliding, max_deviation)
        if self.goal == "time-step":
            result = yield from maximise_time_step(mesh, candidates, sliding, result)
        points = shape.points if result is None else result.optimiser.points
        outcome = shape.outcome if result is None else Outcome.NO_IMPROVEMENT
        if self.balances:
            energy = self._sound_energy(mesh, points, sliding)
            points = yield from balance(energy, points, given)
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
        config = UntanglingConfig(self.initial_epsilon, newton=newton)
        untangled = yield from untangle(mesh, energy.without_size(), quality, locked, config)
        points, omitted = untangled.points, untangled.omitted
        if omitted.any() and not self.slides_on(mesh):
            decision = omission_message(omitted, locked)
            yield Step(points, decision=decision, intermediate=True, quality=untangled.quality, norm=energy.norm)
        energy = energy.with_objective(energy.norm, omitted)
        config = ShapeOptimumConfig(newton=newton)
        max_p = 1.0 if self.balances else self.max_p
        return (yield from optimise_shape(energy, points, max_p, intermediate, config))

    def _sound_energy(self, mesh: Mesh, points: np.ndarray, sliding: SlidingBoundary | None) -> MeshEnergy:
        """The energy with p = 1, without the corners that are inverted at these points."""
        inverted = inverted_corners(points, mesh.hexes, measure(points, mesh.hexes))
        energy = energy_of(mesh, ObjectiveNorm(1.0, self.offset), sliding)
        return energy.with_objective(energy.norm, inverted)

    def _maxmin_stage(
        self,
        mesh: Mesh,
        candidates: Sequence[np.ndarray],
        fixed_optimum: np.ndarray,
        sliding: SlidingBoundary | None,
        max_deviation: float,
    ) -> Generator[Step, None, MaxMinResult | None]:
        """Raise the least scaled Jacobian from the best of some points (n, 3), where it is the goal or not sound.

        None where shape is the goal and the least is sound. Steps off the surface begin with `fixed_optimum`, one of
        the points; `max_deviation` is the distance that the boundary may have from it, in the mesh's unit of length.
        """
        optimisers = (MaxMinOptimiser(mesh, points, sliding) for points in candidates)
        best = max(optimisers, key=lambda optimiser: optimiser.corners.active_minimum)
        if not self.maximises_jacobian and not best.corners.active_minimum < MAXMIN.barrier_safe:
            return None
        target = np.inf if self.maximises_jacobian else MAXMIN.barrier_safe
        wanted = min(target, MAXMIN.acceptable)
        if self.maximises_jacobian and best.corners.active_minimum > 0:
            points = yield from raise_jacobian(self._sound_energy(mesh, best.points, sliding), best.points)
            raised = MaxMinOptimiser(mesh, points, sliding)
            best = max(best, raised, key=lambda optimiser: optimiser.corners.active_minimum)
        groups = MAXMIN.max_groups if best.corners.active_minimum < MAXMIN.barrier_safe else 1
        result = MaxMinResult(best, (yield from maximise_minimum(best, target, groups=groups)))
        if 0 < max_deviation < np.inf and best.corners.movable_minimum < wanted:
            optimiser = MaxMinOptimiser(mesh, fixed_optimum, sliding)
            result = yield from improve_off_surface(optimiser, max_deviation, result)
        return result

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
        harmed = any(fallen) if self.guard or self.balances else all(fallen)
        if self.maximises_jacobian:
            return now.n_inverted, harmed, -now.scaled_jacobian.min()
        if self.goal == "time-step":  # the time step itself comes last, see `rank_by_points`
            return now.n_inverted, harmed if self.guard else False
        if self.balances:  # floors hold while the rest is raised: of equals the last is the best
            return now.n_inverted, harmed or (start.n_inverted == 0 and now.q.mean() < start.q.mean())
        before, after = (objective_of_sound(of, self.norm) for of in (start, now))
        return now.n_inverted, harmed, after > before

    def rank_by_points(self, hexes: np.ndarray, points: np.ndarray) -> tuple[float, ...]:
        return (-least_heights(points, hexes).min(),) if self.goal == "time-step" else ()

    def regression_hint(self, worse: tuple[str, ...]) -> str:
        if self.balances or self.maximises_minimum or "inverted" in worse:
            return ""
        if "scaled_jacobian" in worse:
            return "With goal=scaled-jacobian the least scaled Jacobian rises instead; with guard=true neither falls."
        return "With guard=true it does not fall." if worse else ""
