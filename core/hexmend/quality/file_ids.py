"""Numbers that the file of a mesh gives to its hexes and nodes, for messages about them."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from hexmend.mesh.mesh import Mesh
from hexmend.mesh.solid_cells import SOLID_KINDS, kinds_of, solid_blocks

#: Name of the node and hex data that hold the numbers of the file.
ID = "id"


def hex_ids(mesh: Mesh) -> np.ndarray | None:
    """Return the file's numbers of the cells, (m,) int; None if it has none, or counts from 0 as well."""
    blocks = [mesh.hex_data] if mesh.n_hexes else []
    blocks += [cells.data for cells in solid_blocks(mesh.cells)]
    ids = [data[ID] for data in blocks if ID in data]
    return _ids(np.concatenate(ids), mesh.n_elements) if ids else None


def node_ids(mesh: Mesh) -> np.ndarray | None:
    """Return the file's numbers of the nodes, (n,) int; None if it has none, or counts from 0 as well."""
    return _ids(mesh.node_data.get(ID), mesh.n_nodes)


def with_ids(numbers: Sequence[int] | np.ndarray, ids: np.ndarray | None) -> str:
    """List numbers, with the ids of the file in brackets if it has any.

    >>> with_ids([0, 2], None), with_ids([0, 2], np.array([501, 502, 503]))
    ('0, 2', '0, 2 (in the file 501, 503)')
    """
    own = ", ".join(map(str, numbers))
    return own if ids is None else f"{own} (in the file {', '.join(map(str, ids[numbers].tolist()))})"


def name_cells(mesh: Mesh, numbers: Sequence[int] | np.ndarray) -> str:
    """List numbers of solid cells, with the kinds of those that are no hexes, and the ids of the file if it has any.

    >>> from hexmend.gallery import make
    >>> name_cells(make("cube", size=8), [0, 2])
    '0, 2'
    """
    kinds = kinds_of(mesh.elements[np.asarray(numbers, np.int64)])
    words = [f"{i} ({SOLID_KINDS[kind].name})" if kind else str(i) for i, kind in zip(numbers, kinds, strict=True)]
    ids = hex_ids(mesh)
    return ", ".join(words) + ("" if ids is None else f" (in the file {', '.join(map(str, ids[numbers].tolist()))})")


def _ids(values: np.ndarray | None, count: int) -> np.ndarray | None:
    if values is None or values.shape != (count,) or values.dtype.kind not in "iu":
        return None
    return None if np.array_equal(values, np.arange(count)) else values
