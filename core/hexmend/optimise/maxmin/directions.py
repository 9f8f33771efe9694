"""The ways that nodes may go in a step: along the axes inside, along the surface where they slide."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from hexmend.boundary import SlidingBoundary

#: Ways around a place of a patch, in its basis.
_AROUND = np.array([(np.cos(angle), np.sin(angle), 0.0) for angle in np.arange(8) * np.pi / 4]).round(15)


@dataclass(frozen=True, eq=False)
class StepDirections:
    """Ways that nodes may go, in the length of the shortest edge at each.

    Parameters
    ----------
    owner : (w,)
        Whose, ascending.
    displacements : (w, 3)
        The displacement that is asked for: along a tangent where the node slides.
    effective : (w, 3)
        What it comes to once the node is put back: of a faceted surface that is another plane at every side.
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
    """Both senses of each axis; of nodes that slide on a patch eight ways around, on a curve two.

    Parameters
    ----------
    x : (k, 3) float64
        Where the nodes are.
    size : (k,) float64
        The length of the shortest edge at each.
    radius : float
        How far each may go, in that length.
    nodes : (k,) int
        Which they are; `StepDirections.owner` counts within these.
    slides : (k,) bool
        Which of them slide.
    sliding : SlidingBoundary or None
        Where they do.
    """
    axes = np.concatenate([np.eye(3), -np.eye(3)])
    inside = np.flatnonzero(~slides)
    of, aims = np.repeat(inside, 6), np.tile(axes, (inside.size, 1))
    leads = aims
    if slides.any():
        on = np.flatnonzero(slides)
        bases = sliding.bases(x[on], nodes[on])
        around = np.einsum("kij,wj->kwi", bases, _AROUND).reshape(-1, 3)
        of_around = np.repeat(on, len(_AROUND))
        there = np.linalg.norm(around, axis=1) > 0.5  # of a curve all that goes along it, once
        there &= np.tile(_AROUND[:, 1] == 0, on.size) | np.repeat(bases[:, :, 1].any(axis=1), len(_AROUND))
        around, of_around = around[there], of_around[there]
        far = np.maximum(radius * size[of_around, None], np.finfo(float).tiny)  # nodes may coincide
        start = x[of_around]
        led = (sliding.put_back(start + far * around, nodes[of_around]) - start) / far
        of, aims, leads = (np.concatenate(both) for both in ((of, of_around), (aims, around), (leads, led)))
    order = np.argsort(of, kind="stable")
    scale = size[of[order], None]
    return StepDirections(of[order], scale * aims[order], scale * leads[order])
