"""Subspaces of displacements, as orthogonal projectors."""

from __future__ import annotations

import numpy as np

#: Entries nearer than this to 0 or 1 become 0 or 1, so that nodes in axis-aligned planes keep a coordinate exactly.
_ROUNDING = 1e-12
#: Eigenvalues and entries of matrices that differ by less are equal: planes at less than 1e-4 radians are one plane.
TOLERANCE = 1e-8


def plane_projectors(normals: np.ndarray) -> np.ndarray:
    """Projectors onto the planes through the origin with some normals (k, 3) of any length but 0, (k, 3, 3)."""
    return np.eye(3) - line_projectors(normals)


def line_projectors(directions: np.ndarray) -> np.ndarray:
    """Projectors onto the lines with some directions (k, 3) of any length but 0, (k, 3, 3)."""
    unit = _unit(directions)
    unit = _unit(np.where(np.abs(unit) < _ROUNDING, 0.0, unit))
    return unit[:, :, None] * unit[:, None, :]


def ranks(projectors: np.ndarray) -> np.ndarray:
    """Dimensions of the subspaces of some projectors (k, 3, 3), (k,) int64."""
    return np.rint(np.trace(projectors, axis1=1, axis2=2)).astype(np.int64)


def intersections(one: np.ndarray, other: np.ndarray) -> np.ndarray:
    """Projectors onto the intersections of pairs of subspaces, given by their projectors (k, 3, 3) each.

    >>> plane = plane_projectors(np.array([[0.0, 0, 2], [1, 0, 0]]))
    >>> intersections(plane[:1], plane[1:])[0].tolist()
    [[0.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 0.0]]
    """
    answer = one * other  # exact where both are spanned by axes
    skew = np.flatnonzero(~(_is_axis_aligned(one) & _is_axis_aligned(other)))
    if skew.size:
        # A vector of both subspaces is an eigenvector of the sum of their projectors to the eigenvalue 2.
        answer[skew] = _eigenprojectors(one[skew] + other[skew], 2.0)
    return answer


def fixed_spaces(rotations: np.ndarray) -> np.ndarray:
    """Projectors onto the vectors that rotations (k, 3, 3) do not change, such as their axes; (k, 3, 3)."""
    difference = rotations - np.eye(3)
    return _eigenprojectors(difference.transpose(0, 2, 1) @ difference, 0.0, TOLERANCE**1.5)


def rotated(projectors: np.ndarray, rotations: np.ndarray) -> np.ndarray:
    """Projectors R P R^T onto rotated subspaces, (k, 3, 3)."""
    return rounded(rotations @ projectors @ rotations.transpose(0, 2, 1))


def combined(nodes: np.ndarray, projectors: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Intersect the subspaces of each node.

    Parameters
    ----------
    nodes : (k,) int
        Numbers of nodes; one can be there several times.
    projectors : (k, 3, 3) float64

    Returns
    -------
    nodes : (j,) int
        Each node once, ascending.
    projectors : (j, 3, 3) float64
    """
    order = np.argsort(nodes, kind="stable")
    nodes, projectors = nodes[order], projectors[order]
    each, first, count = np.unique(nodes, return_index=True, return_counts=True)
    answer = projectors[first]
    for turn in range(1, int(count.max(initial=1))):
        more = np.flatnonzero(count > turn)
        answer[more] = intersections(answer[more], projectors[first[more] + turn])
    return each, answer


def rounded(matrices: np.ndarray) -> np.ndarray:
    """Matrices with entries that are -1, 0 or 1 but for rounding made so."""
    whole = np.rint(matrices)
    return np.where(np.abs(matrices - whole) < _ROUNDING, whole + 0.0, matrices)


def _is_axis_aligned(projectors: np.ndarray) -> np.ndarray:
    return ((projectors == 0) | (projectors == 1)).all(axis=(1, 2))


def _eigenprojectors(matrices: np.ndarray, value: float, tolerance: float = TOLERANCE) -> np.ndarray:
    """Projectors onto the eigenvectors of symmetric matrices (k, 3, 3) to one eigenvalue."""
    values, vectors = np.linalg.eigh(matrices)
    chosen = vectors * (np.abs(values - value) < tolerance)[:, None, :]
    return rounded(chosen @ chosen.transpose(0, 2, 1))


def _unit(vectors: np.ndarray) -> np.ndarray:
    vectors = vectors / np.abs(vectors).max(axis=1, keepdims=True)  # squares of its entries do not overflow
    return vectors / np.linalg.norm(vectors, axis=1, keepdims=True)
