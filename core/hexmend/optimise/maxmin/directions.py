"""Admissible directions of nodes in a step: along the axes inside, along the surface where they slide."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from hexmend.boundary import SlidingBoundary

#: Directions around a point of a patch, in the basis of its tangent plane.
_AROUND = np.array([(np.cos(angle), np.sin(angle), 0.0) for angle in np.arange(8) * np.pi / 4]).round(15)


@dataclass(frozen=True, eq=False)
class StepDirections:
    """Admissible directions, scaled by the shortest edge at each node.

    Parameters
    ----------
    owner : (w,) int
        The node of each, as an index into the nodes of the step, ascending.
    displacements : (w, 3) float64
        The displacement: along a tangent where the node slides.
    effective : (w, 3) float64
        The displacement after projection; on a faceted surface each direction leads to another plane.
    """

    owner: np.ndarray
    displacements: np.ndarray
    effective: np.ndarray


def step_directions(
    x: np.ndarray,
    size: np.ndarray,
    radius: float,
    nodes: np.ndarray,
    slides: np.ndarray,
    sliding: SlidingBoundary | None,
) -> StepDirections:
    """Find the directions of nodes: both senses of each axis inside, eight in a patch, two along a curve.

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
    of, aims = np.repeat(inside, 6), np.tile(axes, (inside.size, 1))
    leads = aims
    if slides.any():
        on = np.flatnonzero(slides)
        bases = sliding.tangent_bases(x[on], nodes[on])
        around = np.einsum("kij,wj->kwi", bases, _AROUND).reshape(-1, 3)
        of_around = np.repeat(on, len(_AROUND))
        there = np.linalg.norm(around, axis=1) > 0.5  # on a curve those along it, each once
        there &= np.tile(_AROUND[:, 1] == 0, on.size) | np.repeat(bases[:, :, 1].any(axis=1), len(_AROUND))
        around, of_around = around[there], of_around[there]
        far = np.maximum(radius * size[of_around, None], np.finfo(float).tiny)  # nodes may coincide
        start = x[of_around]
        led = (sliding.project(start + far * around, nodes[of_around]) - start) / far
        of, aims, leads = (np.concatenate(both) for both in ((of, of_around), (aims, around), (leads, led)))
    order = np.argsort(of, kind="stable")
    scale = size[of[order], None]
    return StepDirections(of[order], scale * aims[order], scale * leads[order])
