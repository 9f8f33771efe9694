"""Boundary by need: where corners, curves and surface hold hexes inverted, the nodes concerned leave them.

The nodes of these hexes alone are freed, and the hexes untangled with the boundary as near to the surface as possible.
"""

from __future__ import annotations

import itertools
from collections.abc import Callable, Generator, Sequence
from dataclasses import dataclass, replace
from typing import TypeAlias, TypeVar

import numpy as np

from hexmend.arrays import mask
from hexmend.boundary import SlidingBoundary
from hexmend.iteration import Step
from hexmend.mesh.hexahedron import CORNER_TETRAHEDRA
from hexmend.mesh.mesh import Mesh
from hexmend.quality import corner_determinants, measure

T = TypeVar("T")

#: Function that untangles a mesh from some points (n, 3) on, whose boundary slides: yields steps, returns the points.
Untangle: TypeAlias = Callable[[SlidingBoundary, np.ndarray], Generator[Step, None, np.ndarray]]


@dataclass(frozen=True)
class ReleaseConfig:
    """Settings of the release.

    Parameters
    ----------
    starts : int
        Points from which hexes are untangled at the least distance, at most: those with the fewest inverted first.
    rounds : int
        Times that nodes are freed and hexes untangled at one distance, at most: each time around the hexes that are
        still inverted.
    steps : tuple of float
        Distances of the boundary from the surface that are tried where no tolerance is given, in mean edge lengths.
    smaller : tuple of float
        Distances that are tried after a larger tolerance that was given, where its result may be lower than there.
    few : int
        Inverted hexes up to which the rest is left to linear programs.
    steps_per_iteration : int
        Steps off the surface per iteration of the run.
    """

    starts: int = 2
    rounds: int = 3
    steps: tuple[float, ...] = (0.3, 0.5, 0.75, 1.0)
    smaller: tuple[float, ...] = (0.03, 0.1, 0.3)
    few: int = 5
    steps_per_iteration: int = 10


RELEASE = ReleaseConfig()


def infeasible(steps: Generator[Step, None, T], every: int = RELEASE.steps_per_iteration) -> Generator[Step, None, T]:
    """Yield some of the steps as infeasible ones, never the result of a run; return what the generator returns."""
    for number in itertools.count():
        try:
            step = next(steps)
        except StopIteration as end:
            return end.value
        if number % every == 0:
            yield replace(step, infeasible=True)


def untangle_released(
    sliding: SlidingBoundary,
    points: np.ndarray,
    untangle: Untangle,
    limits: Sequence[float],
    others_stay: bool = False,
    rounds: int = RELEASE.rounds,
) -> Generator[Step, None, tuple[np.ndarray, np.ndarray]]:
    """Free the nodes at which the boundary holds hexes inverted, and untangle these hexes.

    Parameters
    ----------
    sliding : SlidingBoundary
    points : (n, 3) float64
        Nodes of the boundary on the surface.
    untangle : callable
    limits : sequence of float
        Distances from the surface that the boundary may have, ascending, in the mesh's unit of length: the next one is
        tried where hexes are inverted still.
    others_stay : bool
        Nodes of the boundary that are not freed stay where they are; else they slide.
    rounds : int
        Times that more nodes are freed at one distance, at most.

    Yields
    ------
    Step
        Infeasible ones.

    Returns
    -------
    points : (n, 3) float64
    released : (k,) int64
        The nodes that were freed; empty where none can be.
    """
    mesh, released = sliding.mesh, np.zeros(len(points), dtype=bool)
    fewest = measure(points, mesh.hexes).n_inverted
    for limit in limits:
        for _ in range(rounds):
            concerned = concerned_nodes(mesh, points, released) & sliding.leavable | released
            if not fewest or not concerned.any():
                return points, np.flatnonzero(released)
            around = sliding.without_nodes(np.flatnonzero(concerned), limit)
            after = yield from infeasible(untangle(around.at_rest() if others_stay else around, points))
            inverted = measure(after, mesh.hexes).n_inverted
            if inverted >= fewest:
                break
            points, fewest, released = after, inverted, concerned
    return points, np.flatnonzero(released)


def concerned_nodes(mesh: Mesh, points: np.ndarray, released: np.ndarray) -> np.ndarray:
    """Mark the nodes that hold hexes inverted, (n,) bool.

    At first these are the nodes of inverted corners; where nodes of an inverted hex are released already, all of its
    nodes and their neighbours.
    """
    sigma = corner_determinants(points, mesh.hexes, np.arange(mesh.n_hexes))
    inverted = ~(sigma > 0)
    hexes, corners = np.nonzero(inverted)
    nodes = np.take_along_axis(mesh.hexes[hexes], CORNER_TETRAHEDRA[corners], axis=1)
    again = mesh.hexes[hexes[released[nodes].any(axis=1)]].ravel()
    around = mesh.topology.rings.of(np.unique(again)) if again.size else again
    return mask(np.concatenate([nodes.ravel(), again, around]), mesh.n_nodes)
