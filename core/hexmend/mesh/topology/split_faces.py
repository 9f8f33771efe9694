"""Quads that two triangles of other cells cover, as where hexes meet tetrahedra without pyramids between them."""

from __future__ import annotations

import numpy as np

from hexmend.arrays import find_rows
from hexmend.mesh.solid_cells import face_nodes, kinds_of


def close_split_faces(elements: np.ndarray, neighbours: np.ndarray) -> np.ndarray:
    """Return the neighbours (m, 6) of cells (m, 8) with such quads and their triangles closed: they are no boundary.

    A closed face has the cell itself as neighbour. The quad may be divided along either diagonal.
    """
    if not kinds_of(elements).any():
        return neighbours
    cells, faces = np.nonzero(neighbours < 0)
    nodes = face_nodes(elements, cells, faces)
    is_triangle = nodes[:, 2] == nodes[:, 3]
    triangles, quads = np.flatnonzero(is_triangle), np.flatnonzero(~is_triangle)
    known, closed = _from_lowest(nodes[triangles, :3]), []
    for corners in ([[0, 2, 1], [0, 3, 2]], [[0, 3, 1], [1, 3, 2]]):  # seen from the other side
        halves = [find_rows(known, _from_lowest(nodes[quads][:, half])) for half in corners]
        covered = (halves[0] >= 0) & (halves[1] >= 0)
        closed += [quads[covered], *(triangles[half[covered]] for half in halves)]
    rows = np.concatenate(closed)
    answer = neighbours.copy()
    answer[cells[rows], faces[rows]] = cells[rows]
    return answer


def _from_lowest(triangles: np.ndarray) -> np.ndarray:
    """Turn triangles (k, 3) so that the lowest node comes first, in the same sense."""
    return np.take_along_axis(triangles, (triangles.argmin(axis=1)[:, None] + np.arange(3)) % 3, axis=1)
