"""Node positions that keep linear constraints to the last bit."""

from __future__ import annotations

import numpy as np

from hexmend.mesh.linear_motion.linear_motion import LinearMotion

#: Passes that round the coordinates of masters with several translated copies until all differences are exact.
_ROUNDING_PASSES = 2


def constrained_points(motion: LinearMotion, given: np.ndarray, points: np.ndarray, free: np.ndarray) -> np.ndarray:
    """Return the points nearest to some that keep linear constraints; tied and hanging nodes follow the others.

    Positions are computed from the given ones, so that rounding errors do not accumulate. A coordinate that a projector
    keeps is the given one to the last bit. Where a tied node is a translated copy, its coordinates differ from its
    master's exactly as the given ones do: equal coordinates stay equal.

    Parameters
    ----------
    motion : LinearMotion
    given : (n, 3) float64
        Positions from which displacements are counted.
    points : (n, 3) float64
        Not changed.
    free : (n,) bool
        Only free nodes are moved.

    Returns
    -------
    (n, 3) float64
    """
    points = points.copy()
    rows = free[motion.nodes]
    nodes, projectors = motion.nodes[rows], motion.projectors[rows]
    kept = (projectors == np.eye(3)).all(axis=2)
    placed = given[nodes] + _times(projectors, points[nodes] - given[nodes])
    points[nodes] = np.where(kept, points[nodes], placed)
    rows = free[motion.tied] & free[motion.master]
    tied, master, rotations = motion.tied[rows], motion.master[rows], motion.rotations[rows]
    translated = (rotations == np.eye(3)).all(axis=2)
    shift = given[tied] - given[master]
    _round_masters(points, given, master, np.where(translated, shift, 0.0))
    turned = given[tied] + _times(rotations, points[master] - given[master])
    points[tied] = np.where(translated & (points[master] != given[master]), points[master] + shift, turned)
    hanging, sums = motion.sums_of_anchors(points)
    moves = free[hanging]
    points[hanging[moves]] = (sums + (given[hanging] - motion.sums_of_anchors(given)[1]))[moves]
    return points


def admissible_displacements(motion: LinearMotion, displacements: np.ndarray) -> np.ndarray:
    """Project displacements of all nodes, (n, 3), onto the admissible ones, in least squares; (n, 3).

    Nodes that move as one get the mean of their displacements, each in its own frame; hanging ones those of their
    anchors.
    """
    answer = displacements.copy()
    tied, master, rotations = motion.tied, motion.master, motion.rotations
    count = np.bincount(master, minlength=len(answer))
    np.add.at(answer, master, _times(rotations.transpose(0, 2, 1), displacements[tied]))
    answer /= 1 + count[:, None]
    answer[motion.nodes] = _times(motion.projectors, answer[motion.nodes])
    answer[tied] = _times(rotations, answer[master])
    hanging, sums = motion.sums_of_anchors(answer)
    answer[hanging] = sums
    return answer


def with_ties_fixed(motion: LinearMotion, fixed: np.ndarray) -> np.ndarray:
    """Return marks of fixed nodes, (n,) bool, to which nodes are added that stay because a node tied to them stays.

    A hanging node that stays holds its anchors, and stays where these do.
    """
    fixed = fixed.copy()
    fixed[motion.nodes[motion.ranks == 0]] = True
    fixed[motion.anchors[fixed[motion.hanging]]] = True
    fixed[motion.master[fixed[motion.tied]]] = True
    fixed[motion.tied] = fixed[motion.master]
    fixed[motion.hanging] = True
    fixed[motion.hanging[~fixed[motion.anchors]]] = False
    return fixed


def _round_masters(points: np.ndarray, given: np.ndarray, master: np.ndarray, shift: np.ndarray) -> None:
    """Round coordinates of masters, changed in `points`, so that those of their copies differ by exactly `shift`."""
    rows = np.flatnonzero((shift != 0).any(axis=1))
    while rows.size:
        # One copy of each master at a time.
        _, first = np.unique(master[rows], return_index=True)
        now = rows[first]
        for _ in range(_ROUNDING_PASSES):
            x = points[master[now]]
            points[master[now]] = np.where(x == given[master[now]], x, (x + shift[now]) - shift[now])
        rows = np.delete(rows, first)


def _times(matrices: np.ndarray, vectors: np.ndarray) -> np.ndarray:
    """Products of matrices (k, 3, 3) and vectors (k, 3), each with its own."""
    return np.einsum("kij,kj->ki", matrices, vectors)
