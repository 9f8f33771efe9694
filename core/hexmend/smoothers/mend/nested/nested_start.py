"""Nested iteration: on a refined mesh, the optimum of shape begins at the optimum of the coarser mesh.

A step moves a node by a few edges, so that the number of steps doubles with each refinement where nodes have to move
far. On the coarse mesh the same way is half as many edges, and a step costs an eighth.
"""

from __future__ import annotations

from collections.abc import Callable, Generator
from dataclasses import dataclass, replace
from typing import TypeAlias

import numpy as np

from hexmend.energy import MeshEnergy
from hexmend.iteration import Step, map_steps
from hexmend.mesh.mesh import Mesh
from hexmend.quality import measure
from hexmend.smoothers.mend.nested.coarse_problem import CoarseProblem, coarse_problem

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
