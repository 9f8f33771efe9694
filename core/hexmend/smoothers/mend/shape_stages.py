"""Stages of mend that untangle, and that go to the optimum of shape."""

from __future__ import annotations

from collections.abc import Generator, Sequence
from dataclasses import replace
from itertools import islice
from typing import NamedTuple

import numpy as np

from hexmend.boundary import SlidingBoundary
from hexmend.boundary.sliding.unlocking import stays_inverted
from hexmend.energy import SQUARES, MeshEnergy, ObjectiveNorm, energy_of
from hexmend.iteration import Outcome, Step
from hexmend.mesh.mesh import Mesh
from hexmend.optimise.maxmin.slp import MaxMinOptimiser
from hexmend.quality import ElementQuality, measure
from hexmend.smoothers.mend.inversion import inverted_corners, locked_corners
from hexmend.smoothers.mend.maxmin import MAXMIN, maximise_minimum
from hexmend.smoothers.mend.mend_settings import MendSettings
from hexmend.smoothers.mend.messages import omission_message
from hexmend.smoothers.mend.nested.nested_start import NESTED, NestedConfig, nested_start
from hexmend.smoothers.mend.newton_steps import NewtonConfig
from hexmend.smoothers.mend.shape_optimum import ShapeOptimum, ShapeOptimumConfig, optimise_shape
from hexmend.smoothers.mend.surface.starts import while_promising
from hexmend.smoothers.mend.untangling import Untangled, UntanglingConfig, untangle


class SlidingStarts(NamedTuple):
    """Starts of a boundary that slides.

    Parameters
    ----------
    points : list of (n, 3) float64
        With the boundary fixed, and on the surface.
    shape : ShapeOptimum or None
        The last of them; None if its least is lower than at the others, or it was not computed.
    passed_over : bool
        True if it was not computed, because nodes have to leave the surface anyway.
    """

    points: list[np.ndarray]
    shape: ShapeOptimum | None
    passed_over: bool = False


class ShapeStages:
    """Stages that untangle a mesh, its boundary fixed or sliding, and go to the optimum of shape.

    Parameters
    ----------
    settings : MendSettings
        The method with its parameters.
    nested : NestedConfig
        Of starts from coarser meshes.
    """

    def __init__(self, settings: MendSettings, nested: NestedConfig = NESTED):
        self.settings, self.goal = settings, settings.goal
        self._nested = nested

    def _energy(self, mesh: Mesh, norm: ObjectiveNorm, sliding: SlidingBoundary | None = None) -> MeshEnergy:
        """The energy of a mesh, whose boundary is fixed or slides."""
        return energy_of(mesh, norm, sliding)

    def _shape(self, mesh: Mesh, energy: MeshEnergy, intermediate: bool) -> Generator[Step, None, ShapeOptimum]:
        """Untangle a mesh, then go to the optimum of shape; where it is a refinement, from that of the coarse mesh."""
        locked = locked_corners(mesh, measure(mesh.points, mesh.hexes))
        energy = energy.with_objective(energy.norm, locked)
        start = yield from nested_start(mesh, energy, self.coarse_shape, self._harms, self._nested)
        is_nested = start is not mesh.points or self._nested.is_of_coarse
        mesh = mesh if start is mesh.points else mesh.with_points(start)
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
        if energy.faceted and self.settings.maximises_jacobian and untangled.left(locked, energy):
            return ShapeOptimum(points, Outcome.NO_IMPROVEMENT)  # the stages that follow free nodes, or raise corners
        energy = energy.with_objective(energy.norm, omitted)
        newton = NewtonConfig(self.settings.solver_iterations, deflated=True)
        config = ShapeOptimumConfig(newton=newton, short_steps=self._nested.short_steps if is_nested else 0)
        steps = optimise_shape(energy, points, self.settings.p_limit, intermediate, config)
        del mesh, start, untangled, points  # large meshes have no memory for what is no longer needed
        return (yield from steps)

    def coarse_shape(self, mesh: Mesh, energy: MeshEnergy) -> Generator[Step, None, np.ndarray]:
        """Go to the optimum of shape, with the first p, of the mesh of which another one is a refinement."""
        stages = ShapeStages(replace(self.settings, max_p=1.0), self._nested.of_coarse_mesh())
        return (yield from stages._shape(mesh, energy, True)).points

    def _harms(self, given: ElementQuality, start: ElementQuality) -> bool:
        """Return True if a start lowers figures that the run guards, as in `Mend.rank_on`; floors raise them again."""
        fallen = start.q.min() < given.q.min(), start.scaled_jacobian.min() < given.scaled_jacobian.min()
        return not self.settings.balances and (any if self.settings.guard else all)(fallen)

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

    def start_sliding(
        self, sliding: SlidingBoundary, candidates: Sequence[np.ndarray], is_untangled: bool
    ) -> Generator[Step, None, SlidingStarts]:
        """Slide from the last of some points (n, 3): by linear programs, then to the optimum of shape.

        `is_untangled` says that no hex is inverted with the boundary fixed.
        """
        optimiser = MaxMinOptimiser(sliding.mesh, candidates[-1], sliding)
        steps = maximise_minimum(optimiser, MAXMIN.barrier_safe)  # by sliding, until the barrier can be used
        yield from islice(steps, MAXMIN.untangling_iterations)
        candidates = [*candidates, optimiser.points]
        if self.settings.maximises_jacobian and not is_untangled and self._has_to_leave(sliding, optimiser.points):
            return SlidingStarts(candidates, None, passed_over=True)
        others = candidates if is_untangled and self.settings.maximises_jacobian else []
        shape = yield from self._start_at_shape(sliding, candidates[-1], others)
        return SlidingStarts(candidates if shape is None else [*candidates, shape.points], shape)

    def _has_to_leave(self, sliding: SlidingBoundary, points: np.ndarray) -> bool:
        """Return True if hexes stay inverted unless nodes leave the surface, and nodes of each of them may."""
        if sliding.mesh.target is not None or not self.settings.absolute_tolerance(sliding.mesh) > 0:
            return False
        hexes = np.flatnonzero(measure(points, sliding.mesh.hexes).inverted)
        stuck = sliding.mesh.hexes[hexes[stays_inverted(sliding, points, hexes)]]
        return len(stuck) > 0 and bool(sliding.leavable[stuck].any(axis=1).all())
