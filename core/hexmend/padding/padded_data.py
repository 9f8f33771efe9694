"""Data and sets of the nodes, hexes and cells that padding adds."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from hexmend.arrays import mask
from hexmend.mesh.hexahedron import EDGES, FACES
from hexmend.padding.inserted_layer import Sheet


class Numbering:
    """Numbers that go on after those of data that number the items of a mesh, such as ids.

    Parameters
    ----------
    *tables : mapping of name to array
        Data of items that have one numbering, such as those of hexes and of other cells.
    """

    def __init__(self, *tables: Mapping[str, np.ndarray]):
        self._next: dict[str, int] = {}
        for table in tables:
            for name, values in table.items():
                if values.dtype.kind in "iu" and values.ndim == 1 and len(values):
                    self._next[name] = max(self._next.get(name, 0), int(values.max()) + 1)

    def take(self, name: str, count: int, dtype: np.dtype) -> np.ndarray:
        """Return the next numbers of data of this name, (count,); int64 where they exceed a type of whole numbers."""
        first = self._next[name]
        self._next[name] = last = first + count
        return np.arange(first, last).astype(dtype if last - 1 <= np.iinfo(dtype).max else np.int64)


def extended_data(data: Mapping[str, np.ndarray], rows: np.ndarray, ids: Numbering) -> dict[str, np.ndarray]:
    """Return data with additional rows: copies of the given ones (j,), and new numbers where all are distinct."""
    answer = {}
    for name, values in data.items():
        more = ids.take(name, rows.size, values.dtype) if _numbers_items(values) else values[rows]
        answer[name] = np.concatenate([values, more])
    return answer


def extended_set(members: np.ndarray, rows: np.ndarray, count: int) -> np.ndarray:
    """Return a set of `count` items with those added that copy (j,) one of its members; they follow the others."""
    return np.concatenate([members, count + np.flatnonzero(mask(members, count)[rows])])


def extended_node_data(
    data: Mapping[str, np.ndarray], sources: np.ndarray, behind: np.ndarray, share: np.ndarray
) -> dict[str, np.ndarray]:
    """Return data of nodes with rows for additional nodes.

    Parameters
    ----------
    data : mapping of name to (n, ...) array
    sources : (j,) int
        Node from which each additional node comes.
    behind : (j,) int
        Node behind it; whole numbers are that one's, real ones interpolated.
    share : (j,) float64
        Its place between the two, from 0 to 1.

    Returns
    -------
    dict of name to (n + j, ...) array
    """
    ids, answer = Numbering(data), {}
    for name, values in data.items():
        if _numbers_items(values):
            more = ids.take(name, sources.size, values.dtype)
        elif values.dtype.kind == "f":
            of = share.reshape(-1, *[1] * (values.ndim - 1))
            more = ((1 - of) * values[sources] + of * values[behind]).astype(values.dtype)
        else:
            more = values[behind]
        answer[name] = np.concatenate([values, more])
    return answer


def padded_node_set(sheet: Sheet, members: np.ndarray) -> np.ndarray:
    """Return a node set of the padded mesh.

    A set of boundary nodes stays as it is. To others, such as those of an interface or of a material, the copies of
    members are added that have an edge to a member behind the layer, or a hex or a face inside all whose nodes are
    members.

    Parameters
    ----------
    sheet : Sheet
    members : (j,) int

    Returns
    -------
    (i,) int
    """
    mesh, copies = sheet.mesh, sheet.copy_of_corner
    marks = mask(members, mesh.n_nodes)
    if not (marks & ~mesh.topology.boundary & mesh.topology.used).any() and not marks[mesh.topology.used].all():
        return members
    joins = np.zeros(len(sheet.originals), dtype=bool)
    near = np.flatnonzero((copies >= 0).any(axis=1))
    whole = near[marks[mesh.hexes[near]].all(axis=1)]
    joins[copies[whole][copies[whole] >= 0]] = True
    for face, corners in enumerate(FACES):
        at = near[marks[mesh.hexes[near][:, corners]].all(axis=1) & ~sheet.is_padded[near, face]]
        on_face = copies[at[:, None], corners]
        joins[on_face[on_face >= 0]] = True
    for one, other in np.concatenate([EDGES, EDGES[:, ::-1]]):
        at = near[(copies[near, one] >= 0) & (copies[near, other] < 0)]
        joins[copies[at[marks[mesh.hexes[at, other]]], one]] = True
    joins &= marks[sheet.originals]
    return np.concatenate([members, mesh.n_nodes + np.flatnonzero(joins)])


def _numbers_items(values: np.ndarray) -> bool:
    """Return True for whole numbers that are all distinct, such as ids."""
    return values.dtype.kind in "iu" and values.ndim == 1 and len(np.unique(values)) == len(values) > 1
