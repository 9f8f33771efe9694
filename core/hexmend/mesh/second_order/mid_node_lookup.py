"""Mid-nodes of faces and edges of second-order hexes, found by the corners."""

from __future__ import annotations

import numpy as np

from hexmend.mesh.hexahedron import FACES
from hexmend.mesh.second_order import MID_EDGES

#: Column of `mid_nodes` of the edge between two corners of a hex, -1 for diagonals, (8, 8).
EDGE_COLUMNS = np.full((8, 8), -1)
EDGE_COLUMNS[MID_EDGES[:, 0], MID_EDGES[:, 1]] = EDGE_COLUMNS[MID_EDGES[:, 1], MID_EDGES[:, 0]] = np.arange(12)

#: Column of `mid_nodes` of the centre of a face, -1 for others, (256,), by the sum of 2^corner over its corners.
_CENTRE_COLUMNS = np.full(256, -1)
_CENTRE_COLUMNS[(1 << FACES).sum(axis=1)] = np.arange(12, 18)


def face_mid_nodes(hexes: np.ndarray, mid_nodes: np.ndarray, owners: np.ndarray, corners: np.ndarray) -> np.ndarray:
    """Return the mid-nodes of faces.

    Parameters
    ----------
    hexes : (m, 8) int32
    mid_nodes : (m, 19) int32
    owners : (k,) int32
        A hex of each face.
    corners : (k, 4) int32
        Nodes of the faces, in order around them.

    Returns
    -------
    (k, 5) int32
        Midpoints of the edges 01, 12, 23 and 30 of the face, and its centre; -1 where there is none.
    """
    local = (hexes[owners][:, None] == corners[:, :, None]).argmax(axis=2)
    edges = EDGE_COLUMNS[local, np.roll(local, -1, axis=1)]
    # Corners that coincide have one number, so that sums of collapsed faces are those of no face.
    columns = np.column_stack([edges, _CENTRE_COLUMNS[(1 << local).sum(axis=1) & 255]])
    return np.where(columns >= 0, mid_nodes[owners[:, None], columns], -1)
