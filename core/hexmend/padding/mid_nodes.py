"""Mid-nodes of second-order hexes at a layer: the faces keep theirs, what lies behind gets copies."""

from __future__ import annotations

import numpy as np

from hexmend.arrays import find_rows
from hexmend.mesh.second_order import MID_EDGES
from hexmend.mesh.second_order.curved_geometry import FACE_COLUMNS
from hexmend.padding.inserted_layer import INNER, LATERAL, OUTER, Sheet

#: Columns of the mid-nodes of the sides of each face, from corner i to corner i + 1, (6, 4).
SIDE_COLUMNS = FACE_COLUMNS[:, :4]
#: Column of the centre of the first face, and of the centre of the hex.
CENTRES, MIDDLE = 12, 18


def padded_mid_nodes(sheet: Sheet) -> tuple[np.ndarray, np.ndarray]:
    """Find the mid-nodes of a mesh with a layer; additional nodes follow the nodes of the mesh and the copies.

    Parameters
    ----------
    sheet : Sheet
        Of a mesh of second order.

    Returns
    -------
    mid_nodes : (m + k, 19) int32
        Of the hexes of the mesh, then of the new ones.
    sources : (j,) int64
        Node at whose place each additional node begins, while the layer has no thickness.
    """
    given, (hexes, faces) = sheet.mesh.mid_nodes, sheet.faces.T
    numbers = _Numbers(sheet.mesh.n_nodes + len(sheet.originals))
    new = np.full((len(hexes), 19), -1, dtype=np.int64)
    inner = sheet.new_hexes[:, :4].astype(np.int64)
    sides = given[hexes[:, None], SIDE_COLUMNS[faces]].astype(np.int64)
    centres = given[hexes, CENTRES + faces].astype(np.int64)
    new[:, 4:8], new[:, CENTRES + OUTER] = sides, centres

    ends = np.sort(np.stack([inner, np.roll(inner, -1, axis=1)], axis=-1), axis=2)
    keys = np.concatenate([sides[..., None], ends], axis=2).reshape(-1, 3)
    copies = numbers.of(keys, sides.ravel())
    new[:, :4] = copies.reshape(-1, 4)
    new[:, CENTRES + INNER] = numbers.of(np.arange(len(hexes))[:, None], centres)
    whole = (sides >= 0).all(axis=1)
    upright = np.where(whole[:, None], sheet.quads, -1)
    new[:, 8:12] = numbers.of(inner.reshape(-1, 1), upright.ravel()).reshape(-1, 4)
    lateral = np.where((centres >= 0)[:, None], sides, -1)
    found = numbers.of(sheet.lateral_of_side.reshape(-1, 1), lateral.ravel())
    new[:, CENTRES + LATERAL] = found.reshape(-1, 4)
    middle = np.where(given[hexes, MIDDLE] >= 0, np.where(centres >= 0, centres, sheet.quads[:, 0]), -1)
    new[:, MIDDLE] = numbers.of(np.arange(len(hexes))[:, None], middle)

    behind = given.astype(np.int64)
    behind[hexes, CENTRES + faces] = new[:, CENTRES + INNER]
    _replace_sides(behind, sheet, keys, copies)
    return np.concatenate([behind, new]).astype(np.int32), numbers.sources


def _replace_sides(behind: np.ndarray, sheet: Sheet, keys: np.ndarray, copies: np.ndarray) -> None:
    """Replace mid-nodes (m, 19) on edges of the sheet: keys (j, 3) of mid-node and ends, and the copy (j,) of each."""
    rows = np.flatnonzero((sheet.copy_of_corner >= 0).sum(axis=1) >= 2)
    ends = np.sort(sheet.inner_hexes[rows][:, MID_EDGES], axis=2)
    own = np.concatenate([behind[rows, :12, None], ends], axis=2).reshape(-1, 3)
    given = keys[:, 0] >= 0
    found = find_rows(keys[given], own).reshape(-1, 12)
    behind[rows, :12] = np.where(found >= 0, np.append(copies[given], -1)[found], behind[rows, :12])


class _Numbers:
    """Numbers of additional nodes, given out by keys."""

    def __init__(self, first: int):
        self._next = first
        self._sources: list[np.ndarray] = []

    def of(self, keys: np.ndarray, sources: np.ndarray) -> np.ndarray:
        """Number each of the keys (j, w), (j,) int64, equal for equal keys; -1 where its source (j,) is -1."""
        numbers = np.full(len(keys), -1)
        there = np.flatnonzero(sources >= 0)
        if there.size:
            _, first, which = np.unique(keys[there], axis=0, return_index=True, return_inverse=True)
            numbers[there] = self._next + which.reshape(-1)
            self._next += first.size
            self._sources.append(sources[there[first]])
        return numbers

    @property
    def sources(self) -> np.ndarray:
        """Source of each number given out, in order, (j,) int64."""
        return np.concatenate([np.empty(0, np.int64), *self._sources])
