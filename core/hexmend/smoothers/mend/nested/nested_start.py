"""Nested iteration: on a refined mesh, the optimum of shape begins at the optimum of the coarser mesh.

A step moves a node by a few edges, so that the number of steps doubles with each refinement where nodes have to move
far. On the coarse mesh the same way is half as many edges, and a step costs an eighth.

The optimum of shape on a coarser mesh, and its interpolation.

Meshes that are uniform refinements of coarser ones: the coarser mesh, and interpolation from its nodes.
"""

from __future__ import annotations

from collections.abc import Callable, Generator
from dataclasses import dataclass, replace
from functools import cached_property
from typing import TypeAlias

import numpy as np

from hexmend.arrays import as_immutable_owned, index_of, mask
from hexmend.energy import MeshEnergy
from hexmend.energy.ranks import ONE_RANK
from hexmend.iteration import Step, map_steps
from hexmend.kernels import structure
from hexmend.mesh.hexahedron import UNIT_CUBE
from hexmend.mesh.mesh import Mesh
from hexmend.mesh.solid_cells import kinds_of
from hexmend.mesh.topology.topology import Topology
from hexmend.quality import measure

#: Function that goes to the optimum of shape of a mesh with an energy; returns the points (n, 3).
Optimise: TypeAlias = Callable[[Mesh, MeshEnergy], Generator[Step, None, np.ndarray]]


@dataclass(frozen=True)
class NestedConfig:
    """Settings of the start.

    Parameters
    ----------
    free_nodes : int
        Free nodes from which on a start is looked for.
    is_of_coarse : bool
        The mesh is a coarse one itself: the steps of coarser ones are not yielded.
    """

    free_nodes: int = 100_000
    is_of_coarse: bool = False

    def of_coarse_mesh(self) -> NestedConfig:
        """Settings of the start of the coarse mesh itself; its steps take too little time to be of interest."""
        return replace(self, free_nodes=0, is_of_coarse=True)


NESTED = NestedConfig()


def nested_start(
    mesh: Mesh, energy: MeshEnergy, optimise: Optimise, config: NestedConfig = NESTED
) -> Generator[Step, None, np.ndarray]:
    """Find the start of the optimum of shape: the given points, or the refined optimum of the coarse mesh.

    Parameters
    ----------
    mesh : Mesh
    energy : MeshEnergy
        Of the mesh, without the corners that are locked.
    optimise : callable
        For the coarse mesh.
    config : NestedConfig

    Yields
    ------
    Step
        Of the coarse mesh, interpolated.

    Returns
    -------
    (n, 3) float64
        Points with no more inverted hexes and no higher energy than the given ones.
    """
    if energy.nodes.size < config.free_nodes:
        return mesh.points
    problem = coarse_problem(mesh, energy)
    if problem is None:
        return mesh.points
    coarse = yield from _coarse_optimum(problem, energy, optimise, config)
    points = _best(problem, mesh, energy, coarse)
    if not config.is_of_coarse:
        yield Step(points, intermediate=True, norm=energy.norm)
    return points


def _coarse_optimum(
    problem: CoarseProblem, energy: MeshEnergy, optimise: Optimise, config: NestedConfig
) -> Generator[Step, None, np.ndarray]:
    """Go to the optimum of the coarse mesh, and return its points (c, 3); the steps describe the fine mesh."""

    def refined(step: Step) -> Step | None:
        if config.is_of_coarse:
            return None
        return Step(
            problem.by_positions(step.points),
            {**step.diagnostics, "coarse_hexes": problem.mesh.n_elements},
            intermediate=True,
            infeasible=energy.limits_moves,
            norm=energy.norm,
        )

    return map_steps(optimise(problem.mesh, problem.energy), refined)


def _best(problem: CoarseProblem, mesh: Mesh, energy: MeshEnergy, coarse: np.ndarray) -> np.ndarray:
    """Return the best points (n, 3) of the given ones and those that coarse nodes (c, 3) give.

    Fewer inverted hexes come first, then a lower energy.
    """
    start = energy.to_edge_units(mesh.points)
    best, least = mesh.points, _rank(mesh, energy, mesh.points)
    for interpolated in (problem.by_positions, problem.by_displacements):
        points = interpolated(coarse)
        rank = _rank(mesh, energy, points)
        if rank < least and energy.infeasible_nodes(start, energy.to_edge_units(points)) is None:
            best, least = points, rank
    return best


def _rank(mesh: Mesh, energy: MeshEnergy, points: np.ndarray) -> tuple[int, float]:
    return measure(points, mesh.elements).n_inverted, energy.value(energy.to_edge_units(points))


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
    tied = motion is not None and motion.tied.size + motion.hanging.size > 0
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
    coarse = Mesh.of_cells(points[vertices], refinement.hexes, fine.fixed[vertices])
    if motion is not None:
        coarse = coarse.with_linear_motion(motion.renumbered(refinement.number), fine.motion_start[vertices])
    return coarse.with_fixed(fine.fixed[vertices])


#: Place of node (x, y, z) among the 27 of a coarse hex, x, y, z in 0, 1, 2.
_STRIDES = np.array([1, 3, 9])
_CORNERS = (2 * UNIT_CUBE.astype(int)) @ _STRIDES


@dataclass(frozen=True, eq=False)
class Refinement:
    """Division of each hex of a coarse mesh into 2 x 2 x 2 hexes.

    Parameters
    ----------
    blocks : (k, 27) int32
        Nodes of the fine mesh in each coarse hex; node (x, y, z) of its 3 x 3 x 3 is in column 9 z + 3 y + x.
    n_nodes : int
        Number of nodes of the fine mesh.
    """

    blocks: np.ndarray
    n_nodes: int

    @cached_property
    def vertices(self) -> np.ndarray:
        """Fine number of each coarse node, ascending, (v,) int64."""
        return np.flatnonzero(mask(self.blocks[:, _CORNERS], self.n_nodes))

    @cached_property
    def number(self) -> np.ndarray:
        """Coarse number of each fine node, -1 for those that the coarse mesh does not have, (n,) int32."""
        return index_of(self.vertices, self.n_nodes)

    @property
    def hexes(self) -> np.ndarray:
        """Hexes of the coarse mesh in its own numbers of nodes, (k, 8) int32."""
        return self.number[self.blocks[:, _CORNERS]]

    def interpolate(self, values: np.ndarray, kept: np.ndarray) -> None:
        """Interpolate values at fine nodes, in place, from those of coarse nodes and of nodes that are kept.

        Parameters
        ----------
        values : (n, 3) float64
        kept : (n,) bool
            Nodes whose values stay; in the coarse hexes around, those of other nodes follow them.
        """
        structure.interpolate_blocks(self.blocks, kept, values)


def find_refinement(topology: Topology) -> Refinement | None:
    """Recognise a mesh each of whose components is a uniform refinement; None for other meshes.

    Where a node of the coarse mesh is known, the hexes around it tell which nodes are in the middle of coarse hexes,
    and these tell more coarse nodes. Nodes with an odd number of hexes are coarse in any case.

    Parameters
    ----------
    topology : Topology

    Returns
    -------
    Refinement or None

    Examples
    --------
    >>> from hexmend.gallery import make
    >>> cube = make("cube", size=64)
    >>> find_refinement(cube.topology).hexes.shape
    (8, 8)
    >>> find_refinement(make("cube", size=27).topology) is None
    True
    """
    corners = topology.node_corners
    if kinds_of(topology.elements).any():
        return None
    blocks = structure.coarse_blocks(topology.elements, corners.start, corners.items)
    return Refinement(blocks, topology.n) if len(blocks) else None
