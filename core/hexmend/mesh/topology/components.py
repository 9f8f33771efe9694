"""Connected components.

Pairs of points that lie almost at one position.

Faces, hexes and other rows of nodes with at least one marked node.

Parity of corner numbering: hexes that share a face are numbered alike if they traverse it in opposite directions.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from hexmend.kernels import incidence
from hexmend.mesh.hexahedron import FACES


def components(count: int, *groups: np.ndarray) -> np.ndarray:
    """Number the connected components of some items.

    Parameters
    ----------
    count : int
        Number of items.
    *groups : (k, w) int
        Each row holds items that are connected, such as the two ends of an edge or the nodes of a cell.

    Returns
    -------
    (count,) int32
        Component of each item, numbered from 0 in the order of their lowest items.

    Examples
    --------
    >>> components(5, np.array([[1, 3], [0, 4]]))
    array([0, 1, 2, 1, 0], dtype=int32)
    """
    parent = np.arange(count, dtype=np.int32)
    for group in groups:
        incidence.join(parent, np.ascontiguousarray(group, np.int32).ravel(), group.shape[1])
    own = parent == np.arange(count, dtype=np.int32)  # the lowest items of components
    while not own[parent].all():
        parent = parent[parent]
    return (np.cumsum(own, dtype=np.int32) - 1)[parent]


def components_of_cells(count: int, cells: np.ndarray, *others: np.ndarray) -> np.ndarray:
    """Number the components of cells that are connected by common nodes.

    Parameters
    ----------
    count : int
        Number of nodes.
    cells : (m, w) int
        Nodes of each cell.
    *others : (k, w) int
        Nodes of cells that connect these, without being numbered.

    Returns
    -------
    (m,) int64
        Component of each of `cells`, numbered from 0 in the order of their first cells.
    """
    _, first, component = np.unique(
        components(count, cells, *others)[cells[:, 0]], return_index=True, return_inverse=True
    )
    return np.argsort(np.argsort(first))[component]


#: A direction along which the points of no lattice coincide; its length is 1.
LATTICE_FREE_DIRECTION = np.array([0.5378216, 0.6219573, 0.5690947]) / np.linalg.norm([0.5378216, 0.6219573, 0.5690947])
#: Neighbours of a point in the order along it, beyond which a tree finds the pairs sooner.
_MAX_NEIGHBOURS = 64


def close_pairs(points: np.ndarray, distance: float) -> np.ndarray:
    """Find the pairs of points that are no further apart than a distance, small beside that of their neighbours.

    Points of a pair are as close along any direction: they follow each other closely in the order along it.

    Parameters
    ----------
    points : (n, 3) float64
    distance : float
        In the unit of the points.

    Returns
    -------
    (k, 2) int64
        The smaller number first; in no particular order.
    """
    along = points @ LATTICE_FREE_DIRECTION
    order = np.argsort(along)
    along, found = along[order], [np.empty((0, 2), dtype=np.int64)]
    reach = distance + 4 * np.finfo(float).eps * float(np.abs(along).max(initial=0.0))
    first = np.arange(len(points))
    for offset in range(1, len(points)):
        first = first[first + offset < len(points)]
        first = first[along[first + offset] - along[first] <= reach]
        if not first.size:
            break
        if offset > _MAX_NEIGHBOURS:
            from scipy.spatial import cKDTree

            return cKDTree(points).query_pairs(distance, output_type="ndarray")
        pairs = order[np.stack([first, first + offset], axis=1)]
        close = np.linalg.norm(points[pairs[:, 0]] - points[pairs[:, 1]], axis=1) <= distance
        found.append(pairs[close])
    return np.sort(np.concatenate(found), axis=1)


def any_of_rows(marks: np.ndarray, rows: np.ndarray) -> np.ndarray:
    """Mark rows (k, w) of numbers with at least one number marked in `marks` (n,) bool, (k,) bool.

    >>> any_of_rows(np.array([True, False, False]), np.array([[1, 2], [2, 0]])).tolist()
    [False, True]
    """
    found = marks.take(rows[:, 0])  # in half the time of marks[...]
    for column in range(1, rows.shape[1]):
        found |= marks.take(rows[:, column])
    return found


#: Hexes whose faces are compared at a time.
_CHUNK = 1 << 16


def face_parity(hexes: np.ndarray, neighbours: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Solve which hexes are numbered alike, for each face-connected component.

    Hexes that share the nodes of a face but not its edges, as a voxel and a hexahedron, are not connected.

    Parameters
    ----------
    hexes : (m, 8) int32
    neighbours : (m, 6) int32
        `Topology.neighbours_in_any_order`.

    Returns
    -------
    component : (m,) int64
        Component of each hex.
    sign : (m,) int64
        1 for hexes numbered like the first of their component, -1 for those numbered the other way round; 0 in
        components where the faces contradict each other.
    """
    pairs, unlike = zip(*_shared_faces(hexes, neighbours), strict=True)
    return signed_components(len(hexes), np.concatenate(pairs), np.concatenate(unlike))


def signed_components(count: int, pairs: np.ndarray, unlike: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Solve the relative signs of items in each connected component, by the components of the double cover.

    The double cover has each item twice, with either sign: a pair of items with like signs connects their copies of
    equal signs, one with unlike signs those of opposite signs. An item whose copies are connected has no sign.

    Parameters
    ----------
    count : int
    pairs : (k, 2) int
        Items that are connected.
    unlike : (k,) bool
        True for pairs of unlike signs.

    Returns
    -------
    component, sign : (count,) int64
        As of `face_parity`.

    Examples
    --------
    >>> signed_components(4, np.array([[0, 1], [1, 2]]), np.array([True, False]))
    (array([0, 0, 0, 3]), array([ 1, -1, -1,  1]))
    """
    first, second = pairs[:, 0], pairs[:, 1]
    copies = [np.stack([first + own, second + np.where(unlike, count - own, own)], axis=1) for own in (0, count)]
    upper, lower = components(2 * count, *copies).reshape(2, -1).astype(np.int64)
    order = np.unique(np.minimum(upper, lower), return_index=True, return_inverse=True)
    return order[1][order[2]], np.sign(lower - upper)


def _shared_faces(hexes: np.ndarray, neighbours: np.ndarray) -> Iterator[tuple[np.ndarray, np.ndarray]]:
    """Yield pairs of hexes (k, 2) that share a face, each once, and True where both traverse it alike, (k,) bool."""
    for begin in range(0, max(len(hexes), 1), _CHUNK):
        rows = neighbours[begin : begin + _CHUNK]
        own, face = np.nonzero(rows > np.arange(begin, begin + len(rows))[:, None])
        other, own = rows[own, face], own + begin
        back = (neighbours[other] == own[:, None]).argmax(axis=1)
        after, before = _around_lowest(hexes[own[:, None], FACES[face]])
        after_there, before_there = _around_lowest(hexes[other[:, None], FACES[back]])
        alike = (after == after_there) & (before == before_there)
        known = (alike | (after == before_there) & (before == after_there)) & (after != before)
        yield np.stack([own, other], axis=1)[known], alike[known]


def _around_lowest(faces: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Find the nodes after and before the lowest node of each face (k, 4), both (k,); corners may coincide."""
    from_lowest = (faces.argmin(axis=1)[:, None] + np.arange(4)) % 4
    lowest, after, across, before = np.take_along_axis(faces, from_lowest, axis=1).T
    return np.where(after == lowest, across, after), np.where(before == lowest, across, before)
