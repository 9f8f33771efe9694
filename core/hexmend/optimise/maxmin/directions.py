"""Admissible directions of nodes in a step: along the axes inside, along the surface where they slide."""

from __future__ import annotations

import itertools
from dataclasses import dataclass

import numpy as np

from hexmend.boundary import SlidingBoundary

#: Directions around a point of a patch, in the basis of its tangent plane.
AROUND = np.array([(np.cos(angle), np.sin(angle), 0.0) for angle in np.arange(8) * np.pi / 4]).round(15)
#: Directions of a point on several patches, before projection: axes and diagonals of a cube.
_ALL_AROUND = np.array([x for x in itertools.product((-1.0, 0.0, 1.0), repeat=3) if np.count_nonzero(x) in (1, 3)])
_ALL_AROUND /= np.linalg.norm(_ALL_AROUND, axis=1, keepdims=True)


@dataclass(frozen=True, eq=False)
class StepDirections:
    """Admissible directions, scaled by the shortest edge at each node.

    Parameters
    ----------
    node_index : (w,) int
        The node of each, as an index into the nodes of the step, ascending.
    displacements : (w, 3) float64
        The displacement: along a tangent where the node slides.
    projected : (w, 3) float64
        The displacement after projection; on a faceted surface each direction leads to another plane.
    unknown : (w,) int, optional
        The unknown that each belongs to: a tied node steps with its master. By default each has one of its own.
    """

    node_index: np.ndarray
    displacements: np.ndarray
    projected: np.ndarray
    unknown: np.ndarray | None = None

    @property
    def columns(self) -> np.ndarray:
        """The unknown of each direction, (w,) int."""
        return np.arange(self.node_index.size) if self.unknown is None else self.unknown

    @property
    def n_unknowns(self) -> int:
        """Number of unknowns."""
        return int(self.columns.max(initial=-1)) + 1


def step_directions(
    x: np.ndarray,
    size: np.ndarray,
    radius: float,
    nodes: np.ndarray,
    slides: np.ndarray,
    sliding: SlidingBoundary | None,
) -> StepDirections:
    """Find the directions of nodes: both senses of each axis inside, eight in a patch, two along a curve.

    A node that left its curve has 14 all around, as it may go onto any patch.

    Parameters
    ----------
    x : (k, 3) float64
        The nodes' places.
    size : (k,) float64
        Length of the shortest edge at each, in the mesh's unit of length.
    radius : float
        Distance that each may move, in that length.
    nodes : (k,) int
        The nodes' numbers in the mesh.
    slides : (k,) bool
        Those that slide.
    sliding : SlidingBoundary or None
        The boundary; None where no node slides.

    Returns
    -------
    StepDirections
    """
    axes = np.concatenate([np.eye(3), -np.eye(3)])
    inside = np.flatnonzero(~slides)
    index, displacements = np.repeat(inside, 6), np.tile(axes, (inside.size, 1))
    projected = displacements
    if slides.any():
        sliding_index = np.flatnonzero(slides)
        tangents, tangent_index = _tangents(x, nodes, sliding_index, sliding)
        distance = np.maximum(radius * size[tangent_index, None], np.finfo(float).tiny)  # nodes may coincide
        start = x[tangent_index]
        on_surface = (sliding.project(start + distance * tangents, nodes[tangent_index]) - start) / distance
        index = np.concatenate([index, tangent_index])
        displacements = np.concatenate([displacements, tangents])
        projected = np.concatenate([projected, on_surface])
    order = np.argsort(index, kind="stable")
    scale = size[index[order], None]
    return StepDirections(index[order], scale * displacements[order], scale * projected[order])


def _tangents(
    x: np.ndarray, nodes: np.ndarray, slides: np.ndarray, sliding: SlidingBoundary
) -> tuple[np.ndarray, np.ndarray]:
    """Return the directions (w, 3) of those of some nodes that slide (j,), and the index of each's node, (w,)."""
    several = sliding.on_several_patches(nodes[slides])
    around, slides = slides[several], slides[~several]
    bases = sliding.tangent_bases(x[slides], nodes[slides])
    tangents = np.einsum("kij,wj->kwi", bases, AROUND).reshape(-1, 3)
    admissible = np.linalg.norm(tangents, axis=1) > 0.5  # on a curve those along it, each once
    on_patch = np.repeat(bases[:, :, 1].any(axis=1), len(AROUND))
    admissible &= np.tile(AROUND[:, 1] == 0, slides.size) | on_patch
    index = np.repeat(slides, len(AROUND))[admissible], np.repeat(around, len(_ALL_AROUND))
    return np.concatenate([tangents[admissible], np.tile(_ALL_AROUND, (around.size, 1))]), np.concatenate(index)
