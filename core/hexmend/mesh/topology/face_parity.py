"""Parity of corner numbering: hexes that share a face are numbered alike if they traverse it in opposite directions."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from hexmend.mesh.hexahedron import FACES
from hexmend.mesh.topology.components import components

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
