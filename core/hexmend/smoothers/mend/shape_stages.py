"""Stages of mend that untangle, and that go to the optimum of shape."""

from __future__ import annotations

from collections.abc import Generator

import numpy as np

from hexmend.energy import SQUARES, MeshEnergy, ObjectiveNorm
from hexmend.iteration import Step
from hexmend.mesh.mesh import Mesh
from hexmend.quality import measure
from hexmend.smoothers.mend.inversion import inverted_corners, locked_corners
from hexmend.smoothers.mend.mend_settings import MendSettings
from hexmend.smoothers.mend.messages import omission_message
from hexmend.smoothers.mend.nested.nested_start import NESTED, NestedConfig, nested_start
from hexmend.smoothers.mend.shape_optimum import ShapeOptimum, optimise_shape
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
