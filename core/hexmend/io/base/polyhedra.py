"""Cells given by their faces, as in OpenVolumeMesh and CGNS: hexes, wedges, pyramids and tetrahedra.

A face is a loop of nodes. A cell is a list of faces, each with its orientation: the loop as seen from inside the cell,
or reversed. The first face of the right width is the base of a cell. Its corners come first, and an edge rises from
each of them::

    kind     faces             base   corner 0 lies in the base and in the faces
    hex      6 quads           quad   2 and 4
    wedge    2 triangles, ...  3      1 and 2
    pyramid  1 quad, ...       quad   1 and 2
    tetra    4 triangles       3      1 and 2

Faces are counted from 0. Where no corner or several corners lie in these faces, the loop of the base begins with
corner 0.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from hexmend.errors import FileError
from hexmend.io.base.content import Block
from hexmend.mesh.hexahedron import FACES

#: Loops of the faces of each kind as seen from inside, base first, in OpenVolumeMesh's order for hexes.
LOOPS = {
    "hex": tuple(map(tuple, FACES[[4, 5, 0, 1, 2, 3], ::-1].tolist())),
    "wedge": ((0, 1, 2), (0, 3, 4, 1), (0, 2, 5, 3), (1, 4, 5, 2), (3, 5, 4)),
    "pyramid": ((0, 1, 2, 3), (0, 4, 1), (0, 3, 4), (1, 4, 2), (2, 4, 3)),
    "tetra": ((0, 1, 2), (0, 3, 1), (0, 2, 3), (1, 3, 2)),
}
#: Cells that are searched at a time: their faces stay in the cache.
_CHUNK = 1 << 13
#: Faces that meet the base in corner 0.
_CORNER_FACES = {"hex": (2, 4), "wedge": (1, 2), "pyramid": (1, 2), "tetra": (1, 2)}


@dataclass(frozen=True, eq=False)
class RaggedArray:
    """Rows of different lengths.

    Parameters
    ----------
    start : (k + 1,) int64
        Row i is values[start[i]:start[i + 1]].
    values : (start[-1],) int64
    """

    start: np.ndarray
    values: np.ndarray

    def __len__(self) -> int:
        return len(self.start) - 1

    @property
    def lengths(self) -> np.ndarray:
        """Length of each row, (k,) int64."""
        return np.diff(self.start)

    @classmethod
    def of_counted_rows(cls, values: np.ndarray) -> tuple[RaggedArray, bool]:
        """Split numbers (j,) int64 into rows, each led by its length; False if they end within a row."""
        starts, at, view = [], 0, memoryview(np.ascontiguousarray(values))
        while at < values.size and view[at] >= 0:
            starts.append(at)
            at += 1 + view[at]
        begins = np.array(starts, np.int64)
        is_item = np.ones(values.size, bool)
        is_item[begins] = False
        return cls(np.concatenate([[0], np.cumsum(values[begins])]), values[is_item]), at == values.size


def cells_from_faces(
    faces: RaggedArray, cells: RaggedArray, turned: np.ndarray
) -> dict[str, tuple[np.ndarray, np.ndarray]]:
    """Find the nodes of cells that are given by faces.

    Parameters
    ----------
    faces : RaggedArray
        Nodes of each face.
    cells : RaggedArray
        Faces of each cell.
    turned : (cells.start[-1],) bool
        True where the cell sees the face from inside in reverse.

    Returns
    -------
    dict of kind to (which, nodes)
        Indices of the cells of the kind, (k,) int64, and their nodes in VTK's order, (k, width) int64. Other
        polyhedra are left out.
    """
    found = {kind: _of_kind(kind, faces, cells, turned) for kind in LOOPS}
    return {kind: (which, nodes) for kind, (which, nodes) in found.items() if len(which)}


def _of_kind(kind: str, faces: RaggedArray, cells: RaggedArray, turned: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    which = np.flatnonzero(cells.lengths == len(LOOPS[kind]))
    chunks = [which[begin : begin + _CHUNK] for begin in range(0, len(which), _CHUNK)]
    lengths = faces.lengths
    found = [
        part for part in (_nodes_of(kind, faces, lengths, cells, turned, chunk) for chunk in chunks) if len(part[0])
    ]
    if not found:
        return which[:0], np.empty((0, 0), np.int64)
    return np.concatenate([numbers for numbers, _ in found]), np.concatenate([nodes for _, nodes in found])


def _nodes_of(
    kind: str, faces: RaggedArray, lengths: np.ndarray, cells: RaggedArray, turned: np.ndarray, which: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Select the cells of a kind, and find their nodes; `lengths` are the numbers of nodes of the faces."""
    sizes = [len(loop) for loop in LOOPS[kind]]
    count, base = len(sizes), sizes[0]
    at = cells.start[which][:, None] + np.arange(count)
    widths = lengths[cells.values[at]]
    alike = (np.sort(widths, axis=1) == sorted(sizes)).all(axis=1)
    which, at, widths = which[alike], at[alike], widths[alike]
    if not len(which):
        return which, np.empty((0, 0), np.int64)

    def corner(k: np.ndarray) -> np.ndarray:
        """Corner k of each face as seen from inside, (cells, faces, 4); the first one again beyond the last."""
        k = np.where(k < widths[:, :, None], k, 0)
        k = np.where(turned[at][:, :, None], widths[:, :, None] - 1 - k, k)
        return faces.values[faces.start[cells.values[at]][:, :, None] + k]

    begin, end = corner(np.arange(4)), corner(np.arange(1, 5))
    rows = np.arange(len(which))
    lower = begin[rows, (widths == base).argmax(axis=1), :base]
    first = np.ones(lower.shape, bool)
    for face in _CORNER_FACES[kind]:
        first &= (lower[:, :, None] == begin[:, face, None, :]).any(axis=2)
    shift = np.where(first.sum(axis=1) == 1, first.argmax(axis=1), 0)
    lower = np.take_along_axis(lower, (np.arange(base) + shift[:, None]) % base, axis=1)

    begin, end = begin.reshape(len(which), -1), end.reshape(len(which), -1)
    rises = ~(end[:, :, None] == lower[:, None, :]).any(axis=2)
    upper, right = np.empty_like(lower), np.ones(len(which), bool)
    for k in range(base):
        there = rises & (begin == lower[:, k, None])
        right &= there.sum(axis=1) == 1
        upper[:, k] = end[rows, there.argmax(axis=1)]
    if kind in ("pyramid", "tetra"):
        right &= (upper == upper[:, :1]).all(axis=1)
        upper = upper[:, :1]
    nodes = np.concatenate([lower, upper], axis=1)
    right &= (np.diff(np.sort(nodes, axis=1), axis=1) > 0).all(axis=1)
    right &= 1 + (np.diff(np.sort(begin, axis=1), axis=1) > 0).sum(axis=1) == nodes.shape[1]
    return which[right], nodes[right]


def check_distinct_nodes(path: Path, blocks: Iterable[Block], consequence: str) -> None:
    """Raise `FileError` for a cell that has a node twice, which the file cannot hold for the given reason."""
    for block in blocks:
        twice = np.flatnonzero((np.diff(np.sort(block.nodes, axis=1), axis=1) == 0).any(axis=1))
        if twice.size:
            problem = f"{block.kind} {twice[0]} has a node twice, so that {consequence}"
            raise FileError(path, problem, "Repair it with hexmend repair, or write .vtu instead.")


def faces_from_cells(blocks: list[tuple[str, np.ndarray]]) -> tuple[np.ndarray, np.ndarray, RaggedArray]:
    """Find the faces of cells, each once, and the half-faces of each cell.

    Parameters
    ----------
    blocks : list of (kind, (k, width) int array)
        Nodes of the cells, which differ within a cell.

    Returns
    -------
    loops : (f, 4) int64
        Nodes of each face as seen from inside its first cell; -1 in the fourth column of a triangle.
    halves : RaggedArray
        For each cell 2 k for face k, or 2 k + 1 if the cell sees the loop in reverse.
    """
    loops, start = [], [np.zeros(1, np.int64)]
    for kind, nodes in blocks:
        table = np.array([[*loop, -1][:4] for loop in LOOPS[kind]])
        given = np.where(table >= 0, np.asarray(nodes, np.int64)[:, table], -1)
        loops.append(given.reshape(-1, 4))
        start.append(start[-1][-1] + len(table) * np.arange(1, len(nodes) + 1))
    given = np.concatenate(loops)
    widths = (given >= 0).sum(axis=1)
    low = np.where(given < 0, np.iinfo(np.int64).max, given).argmin(axis=1)[:, None]
    forth = np.take_along_axis(given, _wrap(widths, low + np.arange(4)), axis=1)
    back = np.take_along_axis(given, _wrap(widths, low - np.arange(4)), axis=1)
    turned = back[:, 1] < forth[:, 1]  # of the two directions, take the one with the lower second node
    alike = np.where(turned[:, None], back, forth)
    order = np.lexsort(alike.T)  # stable: the first of equal faces comes first
    new = np.concatenate([[True], (np.diff(alike[order], axis=0) != 0).any(axis=1)])
    group = np.empty(len(given), np.int64)
    group[order] = np.cumsum(new) - 1
    first = order[new]
    number = np.argsort(np.argsort(first))
    halves = 2 * number[group] + (turned != turned[first][group])
    return given[np.sort(first)], RaggedArray(np.concatenate(start), halves)


def _wrap(widths: np.ndarray, k: np.ndarray) -> np.ndarray:
    """Indices modulo the lengths of loops of 3 or 4 nodes; the fourth index of a triangle is 3, its empty column."""
    k = k % widths[:, None]
    k[widths == 3, 3] = 3
    return k
