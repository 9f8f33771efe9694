"""Stages of mend that untangle, and that go to the optimum of shape.

Second stage of mend: the optimum of shape, the minimum of (3.3) behind the barrier (Wilson 5.2.4).
"""

from __future__ import annotations

from collections.abc import Generator
from dataclasses import dataclass

import numpy as np

from hexmend.energy import SQUARES, MeshEnergy, ObjectiveNorm
from hexmend.iteration import Outcome, Step
from hexmend.mesh.mesh import Mesh
from hexmend.optimise.search_direction import TruncatedNewton, TruncatedNewtonConfig
from hexmend.quality import measure
from hexmend.smoothers.mend.inversion import inverted_corners, locked_corners
from hexmend.smoothers.mend.mend_settings import MendSettings
from hexmend.smoothers.mend.messages import omission_message
from hexmend.smoothers.mend.nested.nested_start import NESTED, NestedConfig, nested_start
from hexmend.smoothers.mend.newton_steps import newton_step
from hexmend.smoothers.mend.untangling import untangle


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

    def _energy(self, mesh: Mesh, norm: ObjectiveNorm) -> MeshEnergy:
        """The energy of a mesh whose boundary is fixed."""
        return MeshEnergy(mesh, norm)

    def _shape(self, mesh: Mesh, energy: MeshEnergy, intermediate: bool) -> Generator[Step, None, ShapeOptimum]:
        """Untangle a mesh, then go to the optimum of shape; a refined mesh starts from its coarse mesh's optimum."""
        locked = locked_corners(mesh, measure(mesh.points, mesh.elements))
        energy = energy.with_objective(energy.norm, locked)
        start = yield from nested_start(mesh, energy, self.coarse_shape, self._nested)
        mesh = mesh if start is mesh.points else mesh.with_points(start)
        untangled = yield from untangle(mesh, energy.without_size(), locked)
        left = untangled.left(locked, energy)
        if left and energy.norm.p < SQUARES.p:
            # Squares weigh the worst hexes more, and untangle some meshes that sums do not.
            again = yield from untangle(mesh, energy.with_objective(SQUARES, locked).without_size(), locked)
            untangled = again if again.left(locked, energy) < left else untangled
        points, omitted = untangled.points, untangled.omitted
        if energy.ranks.any(omitted) and not self.settings.slides_on(mesh):
            decision = omission_message(energy.count(locked), energy.count(omitted & ~locked))
            yield Step(points, decision=decision, intermediate=True, quality=untangled.quality, norm=energy.norm)
        energy = energy.with_objective(energy.norm, omitted)
        steps = optimise_shape(energy, points, intermediate)
        del mesh, start, untangled, points  # large meshes have no memory for what is no longer needed
        return (yield from steps)

    def coarse_shape(self, mesh: Mesh, energy: MeshEnergy) -> Generator[Step, None, np.ndarray]:
        """Go to the optimum of shape of the coarse mesh behind a refinement."""
        stages = ShapeStages(self.settings, self._nested.of_coarse_mesh())
        return (yield from stages._shape(mesh, energy, True)).points

    def _optimum(self, energy: MeshEnergy, points: np.ndarray) -> Generator[Step, None, ShapeOptimum]:
        """Go from points (n, 3), or a coarse optimum, to the optimum of shape without inverted corners there."""
        points = yield from nested_start(energy.mesh.with_points(points), energy, self.coarse_shape, self._nested)
        inverted = inverted_corners(points, energy.mesh.elements, measure(points, energy.mesh.elements))
        energy = energy.with_objective(energy.norm, inverted)
        return (yield from optimise_shape(energy, points, True))

    def _sound(self, energy: MeshEnergy, points: np.ndarray) -> MeshEnergy:
        """Return an energy that floors are added to, without the corners that are inverted at points (n, 3)."""
        inverted = inverted_corners(points, energy.mesh.elements, measure(points, energy.mesh.elements))
        mean = ObjectiveNorm(1.0, self.settings.offset)
        return energy.with_objective(self.settings.norm_on(energy.mesh) if self.settings.balances else mean, inverted)


#: Fall of the objective in so many steps, as a share of it, below which they are the last: of a stage that another one
#: follows, and where steps are limited: on a faceted surface they go from facet to facet.
NEGLIGIBLE_FALL, STEPS = 2e-3, 4
#: Slope, as a share of the energy, up to which it counts as zero (Dennis and Schnabel 1983).
ROUNDING = float(np.cbrt(np.finfo(float).eps) ** 2)


@dataclass(frozen=True, eq=False)
class ShapeOptimum:
    """Result of the stage: points (n, 3) and outcome."""

    points: np.ndarray
    outcome: Outcome


def optimise_shape(energy: MeshEnergy, points: np.ndarray, intermediate: bool) -> Generator[Step, None, ShapeOptimum]:
    """Minimise the energy at delta = 0.

    Parameters
    ----------
    energy : MeshEnergy
        No corner that is inverted at `points` counts in it.
    points : (n, 3) float64
    intermediate : bool
        Another stage follows.

    Yields
    ------
    Step
        After each step of all nodes.
    """
    direction = TruncatedNewton(TruncatedNewtonConfig(deflated=True))
    x = energy.to_edge_units(points)
    values: list[float] = []
    before = 0.0
    outcome: Outcome | None = None
    while outcome is None:
        descent = newton_step(energy, x, 0.0, direction)
        if descent is None or (descent.alpha == 0 and (descent.slope < 0 or intermediate)):
            # Slope and energy are 0 where all hexes are cubes.
            converged = descent is not None and -descent.slope <= ROUNDING * descent.value
            outcome = Outcome.CONVERGED if converged else Outcome.NO_DESCENT
            break
        values.append(descent.value - energy.cube_value)
        judged = len(values) > STEPS and (intermediate or energy.limits_moves)
        if judged and values[-1 - STEPS] - values[-1] < NEGLIGIBLE_FALL * values[-1]:
            outcome = Outcome.NO_IMPROVEMENT if energy.limits_moves else Outcome.CONVERGED
            break
        x, slope = descent.x, -descent.slope if descent.backtracks == 0 else 0.0
        # A slope that falls once more as much as it did counts as zero.
        is_last = intermediate and 0 < slope**2 < ROUNDING * descent.value * before
        before = slope
        diagnostics = descent.diagnostics(0.0) | {"p": energy.norm.p}
        del descent  # large meshes have no memory for its direction
        points = energy.to_mesh_units(x)
        yield Step(points, diagnostics, intermediate=intermediate, norm=energy.norm)
        outcome = Outcome.CONVERGED if is_last else None
    energy.release_workspace()
    return ShapeOptimum(points, outcome)
