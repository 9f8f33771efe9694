"""Order of the corners of cells: polyMesh has none, and needs faces with normals that point out of the cells."""

from __future__ import annotations

from itertools import pairwise, permutations

import numpy as np

from hexmend.io.base.polyhedra import LOOPS
from hexmend.mesh.hexahedron import CORNER_TETRAHEDRA, UNIT_CUBE

#: Numbering of the mirrored cell of each kind but hexes.
_MIRRORED = {"tetra": [0, 2, 1, 3], "pyramid": [0, 3, 2, 1, 4], "wedge": [0, 2, 1, 3, 5, 4]}
#: Cells that are ordered at a time, which limits the memory.
_CHUNK = 1 << 16


def standard_order(kind: str, cells: np.ndarray) -> np.ndarray:
    """Rotate cells so that the lowest possible node comes first, and the lowest possible one second.

    Parameters
    ----------
    kind : str
        A key of `ROTATIONS`.
    cells : (k, width) int64
        Nodes in VTK's order.

    Returns
    -------
    (k, width) int64
        The same cells in VTK's order, not mirrored.

    Examples
    --------
    >>> standard_order("tetra", np.array([[7, 3, 5, 4]]))
    array([[3, 4, 5, 7]])
    """
    turns, ordered = ROTATIONS[kind], np.empty_like(cells)
    for begin in range(0, len(cells), _CHUNK):
        part = cells[begin : begin + _CHUNK].astype(np.int64)
        limit = part.max() + 1
        best = (part[:, turns[:, 0]] * limit + part[:, turns[:, 1]]).argmin(axis=1)
        ordered[begin : begin + _CHUNK] = np.take_along_axis(part, turns[best], axis=1)
    return ordered


def with_outward_faces(kind: str, cells: np.ndarray, points: np.ndarray) -> np.ndarray:
    """Mirror the numbering of cells with a negative volume: not all programs number wedges alike.

    Parameters
    ----------
    kind : str
        "tetra", "pyramid" or "wedge"; hexes are returned as they are.
    cells : (k, width) int
    points : (n, 3) float64

    Returns
    -------
    (k, width) int
    """
    if kind not in _MIRRORED:
        return cells
    corners = points[cells] - points[cells].mean(axis=1, keepdims=True)
    volume = np.zeros(len(cells))
    for first, *others in LOOPS[kind]:  # seen from inside
        for second, third in pairwise(others):
            normal = np.cross(corners[:, second], corners[:, third])
            volume -= np.einsum("ki,ki->k", corners[:, first], normal)
    return np.where(volume[:, None] < 0, cells[:, _MIRRORED[kind]], cells)


def _hex_rotations() -> list[list[int]]:
    """The 24 rotations: corner a comes first, and one of its neighbours second."""
    turns = []
    for a, *neighbours in CORNER_TETRAHEDRA.tolist():
        for k in range(3):
            corners = UNIT_CUBE[a] + UNIT_CUBE @ (UNIT_CUBE[np.roll(neighbours, -k)] - UNIT_CUBE[a])
            turns.append([int((corner == UNIT_CUBE).all(axis=1).argmax()) for corner in corners])
    return turns


def _is_even(order: tuple[int, ...]) -> bool:
    return sum(a > b for k, a in enumerate(order) for b in order[k + 1 :]) % 2 == 0


#: Numberings of each kind that describe the same cell, in VTK's order, (r, width).
ROTATIONS = {
    "hex": np.array(_hex_rotations()),
    "wedge": np.array(
        [
            [0, 1, 2, 3, 4, 5], [1, 2, 0, 4, 5, 3], [2, 0, 1, 5, 3, 4],
            [3, 5, 4, 0, 2, 1], [5, 4, 3, 2, 1, 0], [4, 3, 5, 1, 0, 2],
        ]
    ),
    "pyramid": np.array([[0, 1, 2, 3, 4], [1, 2, 3, 0, 4], [2, 3, 0, 1, 4], [3, 0, 1, 2, 4]]),
    "tetra": np.array([order for order in permutations(range(4)) if _is_even(order)]),
}  # fmt: skip
