"""The optimum of shape on a coarser mesh, and its interpolation."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from hexmend.arrays import as_immutable_owned
from hexmend.energy import MeshEnergy
from hexmend.energy.ranks import ONE_RANK
from hexmend.mesh.mesh import Mesh
from hexmend.mesh.topology.refinement import Refinement, find_refinement


@dataclass(frozen=True, eq=False)
class CoarseProblem:
    """Coarse mesh behind a refined mesh, with the constraints of the nodes that both have.

    Parameters
    ----------
    fine : MeshEnergy
    given : (n, 3) float64
        Points of the fine mesh.
    refinement : Refinement
        Of the fine mesh.
    mesh : Mesh
        The coarse mesh.
    energy : MeshEnergy
        Of the coarse mesh.
    """

    fine: MeshEnergy
    given: np.ndarray
    refinement: Refinement
    mesh: Mesh
    energy: MeshEnergy

    def by_positions(self, coarse: np.ndarray) -> np.ndarray:
        """Interpolate the positions of coarse nodes (c, 3) at the fine ones, (n, 3) immutable.

        Nodes that do not move stay, and nodes around them follow.
        """
        return self._interpolated(np.array(self.given), coarse, 0.0)

    def by_displacements(self, coarse: np.ndarray) -> np.ndarray:
        """Interpolate the displacements of coarse nodes to (c, 3) at the fine ones, added to the given points.

        Returns
        -------
        (n, 3) float64
            Immutable.
        """
        return self._interpolated(np.zeros_like(self.given), coarse - self.mesh.points, self.given)

    def _interpolated(self, values: np.ndarray, coarse: np.ndarray, base: np.ndarray | float) -> np.ndarray:
        """Interpolate from coarse nodes (c, 3) and nodes that stay (n, 3), add a base, and keep constraints."""
        kept = self.fine.mesh.fixed.copy()
        values[self.refinement.vertices] = coarse
        kept[self.refinement.vertices] = True
        self.refinement.interpolate(values, kept)
        points = self._constrained(values + base)
        return as_immutable_owned(points)

    def _constrained(self, points: np.ndarray) -> np.ndarray:
        """Return points (n, 3) with fixed nodes put back in place and linear constraints satisfied."""
        fixed = self.fine.mesh.fixed
        points[fixed] = self.fine.mesh.points[fixed]
        return self.fine.mesh.constrained(points)


def coarse_problem(mesh: Mesh, energy: MeshEnergy) -> CoarseProblem | None:
    """Recognise the coarse mesh of a uniform refinement, with its energy.

    None for other meshes, and for what a coarse mesh cannot have: a target of hexes, nodes that are tied to others or
    slide on a curved surface, and a part of a mesh that is divided among processes.

    Parameters
    ----------
    mesh : Mesh
    energy : MeshEnergy
        Of the mesh.
    """
    motion = energy.mesh.linear_motion
    tied = motion is not None and motion.tied.size > 0
    if energy.motion.projected.size or energy.surface is not None:
        return None
    if energy.ranks is not ONE_RANK or mesh.element_target is not None or tied:
        return None
    refinement = find_refinement(mesh.topology)
    if refinement is None:
        return None
    coarse = _coarse_mesh(mesh.points, energy.mesh, refinement)
    problem = MeshEnergy(coarse, energy.norm)
    if not problem.nodes.size:
        return None
    return CoarseProblem(energy, mesh.points, refinement, coarse, problem)


def _coarse_mesh(points: np.ndarray, fine: Mesh, refinement: Refinement) -> Mesh:
    """The coarse mesh, of points (n, 3) of the fine one, with its fixed nodes and linear motion."""
    vertices, motion = refinement.vertices, fine.linear_motion
    coarse = Mesh(points[vertices], refinement.hexes)
    if motion is not None:
        coarse = coarse.with_linear_motion(motion.renumbered(refinement.number), fine.motion_start[vertices])
    return coarse.with_fixed(fine.fixed[vertices])
