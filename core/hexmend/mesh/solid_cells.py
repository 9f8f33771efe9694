"""Solid cells of first order as rows of eight nodes: hexes, and wedges, pyramids and tetrahedra that repeat their last.

Nodes are in VTK's order::

    hexahedron    a b c d e f g h       wedge          a b c d e f f f
    pyramid       a b c d e e e e       tetrahedron    a b c d d d d d

The kind follows from the row: the number of equal nodes at its end is 3 for a wedge, 4 for a pyramid, 5 for a
tetrahedron. A cell is judged by its corner tetrahedra: S W^-1, with the edges S at the corner and those W of the ideal
cell, takes the place of S of a hex.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from math import sqrt

import numpy as np

from hexmend.arrays import cross_products
from hexmend.mesh import hexahedron
from hexmend.mesh.cells import Cells
from hexmend.terminal_text import count_phrase, listed


@dataclass(frozen=True, eq=False)
class SolidKind:
    """Kind of a solid cell.

    Parameters
    ----------
    name : str
        For messages and tables.
    nodes : int
        Number of nodes.
    faces : (6, 4) int64
        Nodes of each face, counter-clockwise from outside; a triangle repeats its last node, a face that the kind does
        not have is -1.
    edges : (e, 2) int64
    corners : (c, 4) int64
        Corner tetrahedra, apex first; corner i is that at node i.
    ideal : (3, 3) float64
        Edges of the corners of the ideal cell in columns, W.
    turned : (nodes,) int64
        Permutation of the nodes that reverses the cell.
    edge_class : (e,) int64
        Class of each edge: edges of one class have one length in a target.
    columns : (3,) int64
        Class of the edges whose length scales each column of S W^-1.
    """

    name: str
    nodes: int
    faces: np.ndarray
    edges: np.ndarray
    corners: np.ndarray
    ideal: np.ndarray
    turned: np.ndarray
    edge_class: np.ndarray
    columns: np.ndarray


def _kind(
    name: str, faces: list[list[int]], corners: list[list[int]], ideal: list[list[float]], turned: list[int]
) -> SolidKind:
    sides = {tuple(sorted((a, b))) for face in faces for a, b in zip(face, face[1:] + face[:1], strict=True) if a != b}
    edges = np.array(sorted(sides))
    upright = np.array([name == "wedge" and b - a == 3 for a, b in edges])
    return SolidKind(
        name=name,
        nodes=len(turned),
        faces=np.array(faces + [[-1] * 4] * (6 - len(faces))),
        edges=edges,
        corners=np.array(corners),
        ideal=np.array(ideal).T,
        turned=np.array(turned),
        edge_class=upright.astype(np.int64),
        columns=np.array([0, 0, int(upright.any())]),
    )


HEXAHEDRON = SolidKind(
    name="hexahedron",
    nodes=8,
    faces=hexahedron.FACES,
    edges=hexahedron.EDGES,
    corners=hexahedron.CORNER_TETRAHEDRA,
    ideal=np.eye(3),
    turned=np.array([4, 5, 6, 7, 0, 1, 2, 3]),
    edge_class=np.repeat(np.arange(3), 4),
    columns=np.arange(3),
)
WEDGE = _kind(
    "wedge",
    [[0, 2, 1, 1], [3, 4, 5, 5], [0, 1, 4, 3], [1, 2, 5, 4], [2, 0, 3, 5]],
    [[0, 1, 2, 3], [1, 2, 0, 4], [2, 0, 1, 5], [3, 5, 4, 0], [4, 3, 5, 1], [5, 4, 3, 2]],
    [[1, 0, 0], [1 / 2, sqrt(3) / 2, 0], [0, 0, 1]],
    [3, 4, 5, 0, 1, 2],
)
PYRAMID = _kind(
    "pyramid",
    [[0, 3, 2, 1], [0, 1, 4, 4], [1, 2, 4, 4], [2, 3, 4, 4], [3, 0, 4, 4]],
    [[0, 1, 3, 4], [1, 2, 0, 4], [2, 3, 1, 4], [3, 0, 2, 4]],
    [[1, 0, 0], [0, 1, 0], [1 / 2, 1 / 2, sqrt(1 / 2)]],
    [0, 3, 2, 1, 4],
)
TETRAHEDRON = _kind(
    "tetrahedron",
    [[0, 2, 1, 1], [0, 1, 3, 3], [1, 2, 3, 3], [2, 0, 3, 3]],
    [[0, 1, 2, 3], [1, 2, 0, 3], [2, 0, 1, 3], [3, 1, 0, 2]],
    [[1, 0, 0], [1 / 2, sqrt(3) / 2, 0], [1 / 2, sqrt(3) / 6, sqrt(2 / 3)]],
    [1, 0, 2, 3],
)

#: The kinds; a kind's number is its place.
SOLID_KINDS = (HEXAHEDRON, WEDGE, PYRAMID, TETRAHEDRON)
#: Kinds by the names of blocks of cells, those of the second order too, whose corners come first.
SOLID_BLOCKS = {
    block: kind
    for kind, blocks in zip(
        SOLID_KINDS[1:], (("wedge", "wedge15"), ("pyramid", "pyramid13"), ("tetra", "tetra10")), strict=True
    )
    for block in blocks
}
#: Ends of the edges whose middles the nodes after the corners of blocks of the second order are, in VTK's order.
MIDDLE_EDGES = {
    "wedge15": np.array([[0, 1], [1, 2], [2, 0], [3, 4], [4, 5], [5, 3], [0, 3], [1, 4], [2, 5]]),
    "pyramid13": np.array([[0, 1], [1, 2], [2, 3], [3, 0], [0, 4], [1, 4], [2, 4], [3, 4]]),
    "tetra10": np.array([[0, 1], [1, 2], [2, 0], [0, 3], [1, 3], [2, 3]]),
}

_FACES = np.stack([kind.faces for kind in SOLID_KINDS])
#: Corner tetrahedra of each kind, (4, 8, 4); a corner that a kind does not have is its first one.
_CORNERS = np.stack(
    [np.concatenate([kind.corners, np.repeat(kind.corners[:1], 8 - len(kind.corners), axis=0)]) for kind in SOLID_KINDS]
)


def padded(kind: SolidKind, nodes: np.ndarray) -> np.ndarray:
    """Return rows of eight nodes of cells of one kind (k, at least `kind.nodes`), (k, 8).

    >>> padded(WEDGE, np.arange(6)[None]).tolist()
    [[0, 1, 2, 3, 4, 5, 5, 5]]
    """
    return nodes[:, np.minimum(np.arange(8), kind.nodes - 1)]


def solid_blocks(cells: Iterable[Cells]) -> list[Cells]:
    """Return the blocks of cells that are solid, in the order of `hexmend.Mesh.elements` after the hexes."""
    return [block for block in cells if block.kind in SOLID_BLOCKS]


def solid_rows(points: np.ndarray, cells: Sequence[Cells]) -> list[np.ndarray]:
    """Return the rows of eight nodes of each block of cells that is solid, (k, 8) int32; most are not inside out.

    Parameters
    ----------
    points : (n, 3) float64
    cells : sequence of Cells
    """
    found = []
    for block in solid_blocks(cells):
        kind = SOLID_BLOCKS[block.kind]
        nodes = block.nodes[:, : kind.nodes]
        if np.sign(_volumes(points, kind, nodes)).sum() < 0:
            nodes = nodes[:, kind.turned]
        found.append(padded(kind, nodes))
    return found


def same_solids(one: Sequence[Cells], other: Sequence[Cells]) -> bool:
    """Return True if two tuples of blocks have the same solid cells in the same order."""
    first, second = solid_blocks(one), solid_blocks(other)
    return [block.kind for block in first] == [block.kind for block in second] and all(
        a.nodes is b.nodes or np.array_equal(a.nodes, b.nodes) for a, b in zip(first, second, strict=True)
    )


def middles_of(cells: Sequence[Cells], corner: np.ndarray) -> np.ndarray:
    """Find the mid-nodes of solid blocks of the second order, and the ends of their edges, (k, 3) int32.

    Nodes that are a corner of some cell (n,) bool are left out.
    """
    found = [np.empty((0, 3), np.int32)]
    for block in cells:
        if block.kind in MIDDLE_EDGES:
            edges, first = MIDDLE_EDGES[block.kind], SOLID_BLOCKS[block.kind].nodes
            middles = block.nodes[:, first:, None]
            found.append(np.concatenate([middles, block.nodes[:, edges]], axis=2).reshape(-1, 3))
    middles = np.concatenate(found)
    return middles[~corner[middles[:, 0]]]


def _volumes(points: np.ndarray, kind: SolidKind, nodes: np.ndarray) -> np.ndarray:
    """Compute six times the sum of the corner tetrahedra of cells of one kind, (k,)."""
    total = np.zeros(len(nodes))
    for apex, *ends in kind.corners:
        edges = [points[nodes[:, end]] - points[nodes[:, apex]] for end in ends]
        with np.errstate(all="ignore"):
            total += np.einsum("ki,ki->k", edges[0], cross_products(edges[1], edges[2]))
    return np.nan_to_num(total)


def kinds_of(elements: np.ndarray) -> np.ndarray:
    """Find the numbers of the kinds of cells (m, 8), (m,) uint8.

    >>> kinds_of(np.array([[0, 1, 2, 3, 4, 5, 6, 7], [0, 1, 2, 3, 3, 3, 3, 3]])).tolist()
    [0, 3]
    """
    found = np.zeros(len(elements), dtype=np.uint8)
    some = np.flatnonzero((elements[:, 5] == elements[:, 7]) & (elements[:, 6] == elements[:, 7]))
    if some.size:
        equal = elements[some] == elements[some, 7:]
        run = np.logical_and.accumulate(equal[:, ::-1], axis=1).sum(axis=1)
        found[some] = np.where(run <= 5, run - 2, 0)
    return found


def rows_by_kind(elements: np.ndarray) -> Iterator[tuple[SolidKind, np.ndarray | slice]]:
    """Yield each kind that cells (m, 8) have, and its rows: all of them as a slice if there is no other."""
    kinds = kinds_of(elements)
    for number, kind in enumerate(SOLID_KINDS):
        rows = np.flatnonzero(kinds == number)
        if rows.size:
            yield kind, slice(None) if rows.size == len(kinds) else rows


def cell_faces(elements: np.ndarray) -> np.ndarray:
    """Return the nodes of the faces of cells (m, 8), (m, 6, 4), as of `SolidKind.faces`; -1 for those that are not."""
    kinds = kinds_of(elements)
    if not kinds.any():
        return elements[:, hexahedron.FACES]
    places = _FACES[kinds]
    found = np.take_along_axis(elements, places.reshape(len(elements), -1), axis=1).reshape(places.shape)
    found[places < 0] = -1
    return found


def face_nodes(elements: np.ndarray, cells: np.ndarray, faces: np.ndarray) -> np.ndarray:
    """Return the nodes of some faces: each is a row of `SolidKind.faces` (k,) of one of the cells (k,); (k, 4)."""
    return elements[cells[:, None], _FACES[kinds_of(elements[cells]), faces]]


def corner_tetrahedra(elements: np.ndarray) -> np.ndarray:
    """Return the nodes of the corner tetrahedra of cells (m, 8), (m, 8, 4); corners that are not repeat the first."""
    kinds = kinds_of(elements)
    if not kinds.any():
        return elements[:, hexahedron.CORNER_TETRAHEDRA]
    places = _CORNERS[kinds]
    return np.take_along_axis(elements, places.reshape(len(elements), -1), axis=1).reshape(places.shape)


def has_corner(elements: np.ndarray) -> np.ndarray:
    """Mark the corners that cells (m, 8) have among those of `corner_tetrahedra`, (m, 8) bool."""
    return np.arange(8) < np.array([len(kind.corners) for kind in SOLID_KINDS])[kinds_of(elements), None]


def has_node(elements: np.ndarray) -> np.ndarray:
    """Mark the places of rows (m, 8) that do not repeat the last node, (m, 8) bool."""
    return np.arange(8) < np.array([kind.nodes for kind in SOLID_KINDS])[kinds_of(elements), None]


def centres(points: np.ndarray, elements: np.ndarray) -> np.ndarray:
    """Compute the means of points, or other values (n, ...) of the nodes, over the nodes of cells (m, 8), (m, ...)."""
    found = np.empty((len(elements), *points.shape[1:]))
    for kind, rows in rows_by_kind(elements):
        found[rows] = points[elements[rows][:, : kind.nodes]].mean(axis=1)
    return found


def edges_of(elements: np.ndarray) -> np.ndarray:
    """Return the ends of the edges of cells (m, 8), kind after kind, (e, 2); an edge is there for each of its cells."""
    edges = [elements[rows][:, kind.edges].reshape(-1, 2) for kind, rows in rows_by_kind(elements)]
    return np.concatenate([np.empty((0, 2), elements.dtype), *edges])


def nouns(elements: np.ndarray) -> tuple[str, str]:
    """Return the word for one of these cells (m, 8) and for several: those of hexes if there is no other cell."""
    return ("cell", "cells") if kinds_of(elements).any() else ("hex", "hexes")


def count_cells(elements: np.ndarray) -> str:
    """Return the numbers of cells (m, 8) by kind as words: "3 hexes", "1 hex, 2 pyramids and 5 tetrahedra"."""
    plurals = {HEXAHEDRON: "hexes", TETRAHEDRON: "tetrahedra"}
    words = [
        count_phrase(int(count), "hex" if kind is HEXAHEDRON else kind.name, plurals.get(kind))
        for kind, count in zip(SOLID_KINDS, np.bincount(kinds_of(elements), minlength=4), strict=True)
        if count
    ]
    return listed(words, "and")
