"""Hanging nodes: their anchors, the restrictions that these take over, and cells by their independent nodes."""

from __future__ import annotations

from itertools import combinations

import numpy as np

from hexmend.arrays import mask
from hexmend.errors import MeshError

#: Levels of hanging nodes between hanging nodes; octrees have at most as many as bits of a coordinate.
_LEVELS = 64


def resolved_anchors(
    hanging: np.ndarray, anchors: np.ndarray, weights: np.ndarray
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Replace anchors that hang themselves by theirs, as at the corner of a face in the middle of a coarser one.

    Parameters
    ----------
    hanging, anchors : (w,) int
    weights : (w,) float64
        See `LinearMotion`.

    Returns
    -------
    hanging, anchors, weights
        Each pair once, ascending.

    Raises
    ------
    MeshError
        For a node that hangs on itself.
    """
    for _ in range(_LEVELS):
        pairs, at = np.unique(np.stack([hanging, anchors], axis=1), axis=0, return_inverse=True)
        (hanging, anchors), weights = pairs.T, np.bincount(at.reshape(-1), weights, len(pairs))
        source, deeper = _matches(anchors, hanging)
        if not source.size:
            return hanging, anchors, weights
        last = ~mask(source, anchors.size)
        hanging = np.concatenate([hanging[last], hanging[source]])
        weights = np.concatenate([weights[last], weights[source] * weights[deeper]])
        anchors = np.concatenate([anchors[last], anchors[deeper]])
    raise MeshError(f"node {hanging[source[0]]} hangs on itself: name masters that do not hang on it")


def restrictions_of_anchors(
    nodes: np.ndarray, projectors: np.ndarray, hanging: np.ndarray, anchors: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Give restrictions of hanging nodes to their anchors: nodes (k,) with projectors (k, 3, 3)."""
    row, at = _matches(nodes, hanging)
    own = ~mask(row, nodes.size)
    return np.concatenate([nodes[own], anchors[at]]), np.concatenate([projectors[own], projectors[row]])


def rows_without_hanging(elements: np.ndarray, hanging: np.ndarray, anchors: np.ndarray) -> np.ndarray:
    """Rows of nodes that do not hang, in which two of these are together if they move the same cell.

    Parameters
    ----------
    elements : (m, 8) int
        Nodes of cells.
    hanging, anchors : (w,) int
        Ascending, as of `LinearMotion`.

    Returns
    -------
    (j, 8) int32
        Those of cells without a hanging node, then those of the others, of which each has one or several.
    """
    hangs = mask(hanging, max(int(elements.max(initial=0)), int(hanging.max(initial=0))) + 1)[elements]
    has = hangs.any(axis=1)
    cells, corner = np.nonzero(hangs[has])
    row, at = _matches(elements[has][cells, corner], hanging)
    own, place = np.nonzero(~hangs[has])
    cell = np.concatenate([own, cells[row]])
    pairs = np.unique(np.stack([cell, np.concatenate([elements[has][own, place], anchors[at]])], axis=1), axis=0)
    count = np.bincount(pairs[:, 0], minlength=int(has.sum()))
    rank = np.arange(len(pairs)) - np.repeat(np.cumsum(count) - count, count)
    width = max(8, -(-int(count.max(initial=0)) // 4) * 4)
    table = np.full((len(count), width), -1, dtype=np.int64)
    table[pairs[:, 0], rank] = pairs[:, 1]
    # Fours of nodes, each with each other; rows are filled up with their last node, as those of cells are.
    fours = np.split(table, width // 4, axis=1)
    rows = np.concatenate(
        [np.hstack(two)[(two[1][:, 0] >= 0) | (k == 0)] for k, two in enumerate(combinations(fours, 2))]
    )
    filled = np.maximum.accumulate(np.where(rows >= 0, np.arange(8), 0), axis=1)
    rows = np.take_along_axis(rows, filled, axis=1)
    return np.concatenate([elements[~has], rows]).astype(np.int32)


def _matches(wanted: np.ndarray, ascending: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Find equal numbers in an array (k,) and an ascending array (w,): their places in both, (j,) int64 each."""
    first, end = (np.searchsorted(ascending, wanted, side) for side in ("left", "right"))
    count = end - first
    source = np.repeat(np.arange(wanted.size), count)
    return source, np.arange(source.size) + np.repeat(first - (np.cumsum(count) - count), count)
