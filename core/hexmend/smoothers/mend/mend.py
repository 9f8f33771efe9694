"""Mend: untangle by a decreasing sequence of delta, then the optimum behind the barrier."""

from __future__ import annotations

from collections.abc import Generator
from dataclasses import dataclass

import numpy as np

from hexmend.boundary import SlidingBoundary
from hexmend.energy import MeshEnergy, ObjectiveNorm, SlidingEnergy, energies
from hexmend.iteration import Outcome, Step
from hexmend.kernels.line_search import LineSearch
from hexmend.mesh.mesh import Mesh
from hexmend.optimise.descent import Descent, descend
from hexmend.optimise.maxmin.slp import MaxMinOptimiser
from hexmend.optimise.search_direction import TruncatedNewton
from hexmend.parameters import parameter
from hexmend.quality import ElementQuality, measure
from hexmend.smoothers.base import Steps, method
from hexmend.smoothers.base_optimiser import ObjectiveSmoother
from hexmend.smoothers.mend.inversion import brought_near, inverted_corners, locked_corners, tangled_in
from hexmend.smoothers.mend.local_sweeps import local_sweeps
from hexmend.smoothers.mend.maxmin_stage import (
    AIM,
    CLUSTERS,
    SOUND,
    SPARED,
    lifted,
    limits_of,
    raise_least,
    what_limits,
)
from hexmend.smoothers.mend.messages import what_is_left, what_sliding_freed

#: Newton steps on one delta; the energy is not worth minimising before delta is what it is to be.
STEPS = 3
#: By what factor e of delta^2 = e (e - worst) falls from one delta to the next, and where nothing more can be expected.
FALL, LEAST = 0.7, 1e-9
#: The largest delta: beyond it, the energy of a flat hex is that of a cube.
LARGEST = 0.5
#: Deltas in a row without a hex more mended after which the rest is given up; where nodes slide, and what resists is
#: raised after that, after fewer.
PATIENCE, SLIDING_PATIENCE = 14, 7
#: How far a step may take a node, in mean lengths of its edges.
REACH = 1.5
#: Sweeps of local Newton steps (A.4) around the hexes that a step of all nodes has left inverted, and, at the optimum's
#: side of the barrier, around those whose energy eta is higher than `POOR`: a few of them would cut the step of all.
SWEEPS, POOR_SWEEPS, POOR = 10, 5, 3.0
#: A raise of p is complete when a step moves no node further than this, in mean edge lengths.
SETTLED = 1e-3

#: The share of hexes below which the inverted ones are few: these are left to local sweeps alone, in larger numbers,
#: and the whole mesh steps again only where two deltas in a row have mended nothing.
FEW, MANY_SWEEPS = 0.003, 50

#: On a faceted surface the last steps go from edge to edge: it is enough where so many gain no more than such a share;
#: while hexes are left out, which only what comes after can mend, than such another.
LATELY, SLOW, SLOW_BESIDE_OTHERS = 5, 2e-3, 2e-2

SEARCH = LineSearch(backtrack_factor=0.5)


@method
@dataclass(frozen=True)
class Mend(ObjectiveSmoother):
    """Every free node at once by truncated Newton steps, on a barrier that hardens until no hex is inverted."""

    name = "mend"
    title = "Mend"
    help = "Untangles whatever its fixed nodes allow, then goes to the optimum, of shape or of the worst corner."
    source = "Wilson 5.2.2 and 5.2.4; truncated Newton: Dembo and Steihaug 1983"
    bytes_per_hex = 2200

    goal: str = parameter(
        "shape",
        choices=("shape", "scaled-jacobian"),
        help="shape: the optimum of (3.3); scaled-jacobian: then the least one is raised as far as it goes.",
    )
    max_p: float = parameter(
        1.0, low=1, high=32, help="If higher than p: at the optimum p is doubled until it is this, for the worst hexes."
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
        200, low=1, high=10**6, help="Most iterations of conjugate gradients for a Newton step."
    )

    @property
    def power(self) -> ObjectiveNorm:
        """The highest p and the offset: the objective at whose optimum a run ends.

        Steps with a lower p record the objective with that p instead. Steps that raise the least scaled Jacobian do not
        minimise an energy: they record this one, for comparison, and it may rise.
        """
        return ObjectiveNorm(max(self.p, self.max_p), self.offset)

    def steps(self, mesh: Mesh) -> Steps:
        yield Step(mesh.points)
        given, raises = mesh, self.goal != "shape"
        if self.slides and mesh.target is not None:
            mesh = mesh.keeping_surface().with_points(self.sliding(mesh).mesh.points)
        first = ObjectiveNorm(self.p, self.offset)
        points, outcome = yield from self._shaped(mesh, MeshEnergy(mesh, first), self.slides or raises)
        places, sliding, limits = [mesh.points, points], None, None
        words: list[str] = []
        if self.slides:
            room = self.room(mesh)
            sliding = SlidingBoundary(mesh, self.feature_angle, SPARED * room)
            freeing = MaxMinOptimiser(sliding.mesh, points, sliding)
            yield from raise_least(freeing, SOUND, clusters=1)
            energy = SlidingEnergy(sliding, first)
            points, outcome = yield from self._shaped(sliding.mesh.with_points(freeing.points), energy, True)
            places += [freeing.points, points]
        if raises or self.slides:
            at = mesh if sliding is None else sliding.mesh
            raising = max(
                (MaxMinOptimiser(at, one, sliding) for one in places), key=lambda raising: raising.corners.least
            )
            if raises or raising.corners.least < SOUND:
                outcome = Outcome.NO_IMPROVEMENT
                limit = yield from raise_least(raising, np.inf if raises else SOUND, clusters=CLUSTERS)
                may_leave = self.slides and 0 < room < np.inf
                if may_leave and raising.corners.least_of_all < (AIM if raises else SOUND):
                    raising, limit = yield from lifted(MaxMinOptimiser(at, places[1], sliding), room, raising, limit)
                points = raising.points
                if raises:
                    words.append(what_limits(raising, limit))
                    limits = limits_of(raising, limit)
        if self.slides:
            words.append(what_sliding_freed(given, points))
        if any(words) or outcome is Outcome.NO_IMPROVEMENT:
            yield Step(points, decision=" ".join(filter(None, words)), intermediate=True, limits=limits)
        return outcome

    def _shaped(self, mesh: Mesh, energy: MeshEnergy, more: bool) -> Generator[Step, None, tuple[np.ndarray, Outcome]]:
        """Untangle, then go to the optimum of shape; `more` where that is not the end."""
        locked = locked_corners(mesh)
        energy = energy.with_objective(energy.power, locked)
        points, left_out = yield from self._untangled(mesh, energy, locked)
        if left_out.any() and not self.slides:
            yield Step(points, decision=what_is_left(left_out, locked), intermediate=True, power=energy.power)
        return (yield from self._optimum(mesh, energy, points, left_out, more))

    def rank(self, start: ElementQuality, now: ElementQuality) -> tuple[float, ...]:
        """Inverted hexes first, then whether a guarded figure is lower than at the start, then whether the objective of
        the sound hexes, with the highest p that was asked for, is higher; of equals the last is kept.
        """
        fallen = now.q.min() < start.q.min(), now.scaled_jacobian.min() < start.scaled_jacobian.min()
        harmed = any(fallen) if self.guard else all(fallen)
        if self.goal != "shape":
            return now.n_inverted, harmed, -now.scaled_jacobian.min()
        p, offset = self.power
        with np.errstate(over="ignore"):  # beside the barrier
            before, after = (
                np.power(quality.eta[~quality.inverted] + (1 - offset), p).sum() for quality in (start, now)
            )
        return now.n_inverted, harmed, after > before

    def instead(self, worse: tuple[str, ...]) -> str:
        if self.goal != "shape" or "inverted" in worse:
            return ""
        if "scaled_jacobian" in worse:
            return "With goal=scaled-jacobian the least scaled Jacobian rises instead; with guard=true neither falls."
        return "With guard=true it does not fall." if worse else ""

    def _direction(self) -> TruncatedNewton:
        return TruncatedNewton(iterations=self.solver_iterations)

    def _untangled(
        self, mesh: Mesh, energy: MeshEnergy, locked: np.ndarray
    ) -> Generator[Step, None, tuple[np.ndarray, np.ndarray]]:
        """Mend what can be mended; returns the points and the corners that are to be left out from there on."""
        points, e = mesh.points, self.initial_epsilon
        quality = measure(points, mesh.hexes)
        near = brought_near(mesh, quality)
        if near is not points:
            points, quality = near, measure(near, mesh.hexes)
            yield Step(points, intermediate=True, quality=quality, power=energy.power)
        x = energy.to_edge_units(points)
        tangled, worst = tangled_in(points, mesh.hexes, locked, quality)
        least, idle = tangled, 0
        patience = SLIDING_PATIENCE if energy.faceted else PATIENCE
        while tangled and idle < patience and e > LEAST:
            delta = min(LARGEST, float(np.sqrt(e * (e - min(worst / energy.unit**3, 0.0)))))
            find = self._direction()
            few = tangled < FEW * mesh.n_hexes
            sweeps = MANY_SWEEPS if few else SWEEPS
            for _ in range(STEPS if not few or idle % 3 == 2 else 0):
                taken = descend(energy, x, delta, find, SEARCH, REACH)
                if taken is None or taken.alpha == 0:
                    break
                x, points = taken.x, energy.to_mesh_units(taken.x)
                quality = measure(points, mesh.hexes)
                yield Step(points, taken.diagnostics(delta), intermediate=True, quality=quality, power=energy.power)
                tangled, worst = tangled_in(points, mesh.hexes, locked, quality)
                if not tangled:
                    break
            if tangled:
                x = local_sweeps(energy, x, quality.inverted, locked, delta, sweeps)
                points = energy.to_mesh_units(x)
                quality = measure(points, mesh.hexes)
                diagnostics = {"delta": delta, "sweeps": sweeps}
                yield Step(points, diagnostics, intermediate=True, quality=quality, power=energy.power)
                tangled, worst = tangled_in(points, mesh.hexes, locked, quality)
            idle = 0 if tangled < least else idle + 1
            least = min(least, tangled)
            e *= FALL
        return points, inverted_corners(points, mesh.hexes) | locked

    def _optimum(
        self, mesh: Mesh, energy: MeshEnergy, points: np.ndarray, left_out: np.ndarray, more: bool
    ) -> Generator[Step, None, tuple[np.ndarray, Outcome]]:
        """Behind the barrier to the optimum, then, where it is asked for, with higher and higher p."""
        p = self.p
        while True:
            energy = energy.with_objective(ObjectiveNorm(p, self.offset), left_out)
            find = self._direction()
            x, rises = energy.to_edge_units(points), p < self.max_p
            whole = False  # whether the last step was taken whole: then no hex is in the way
            values: list[float] = []
            slow = SLOW_BESIDE_OTHERS if left_out.any() else SLOW
            while True:
                poor = None if whole else energies(x, mesh.hexes, 0.0, left_out) > POOR
                if poor is not None and poor.any():
                    x = local_sweeps(energy, x, poor, left_out, 0.0, POOR_SWEEPS)
                taken = descend(energy, x, 0.0, find, SEARCH, REACH)
                if taken is None or (taken.alpha == 0 and (taken.slope < 0 or more)):
                    break
                values.append(taken.value - energy.least)
                if energy.faceted and len(values) > LATELY and values[-LATELY] - values[-1] < slow * values[-1]:
                    return points, Outcome.NO_IMPROVEMENT
                move = float(np.sqrt(np.square(taken.x - energy.to_edge_units(points)).sum(axis=1).max()))
                x, points, whole = taken.x, energy.to_mesh_units(taken.x), taken.cuts == 0
                yield Step(points, taken.diagnostics(0.0) | {"p": p}, intermediate=rises or more, power=energy.power)
                if rises and move < SETTLED:
                    break
            if not rises:
                return points, _end(taken)
            p = min(2 * p, self.max_p)


def _end(taken: Descent | None) -> Outcome:
    """How it ended where no step descended: at the optimum what a step would gain is less than rounding."""
    at_rounding = taken is not None and -taken.slope <= 1e-10 * taken.value  # both are 0 where all hexes are cubes
    return Outcome.CONVERGED if at_rounding else Outcome.NO_DESCENT
