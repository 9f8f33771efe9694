"""Cells beside refined ones: their split faces joined, without the nodes that hang there, they are hexes again."""

from __future__ import annotations

import numpy as np

from hexmend.io.base.polyhedra import RaggedArray, cells_from_faces
from hexmend.mesh.topology.split_faces import quads_in_four

#: Least cosine of the angle between one of four faces and their mean plane where they are one face.
_LEAST_COSINE = 0.7


def cells_with_split_faces(
    points: np.ndarray, faces: RaggedArray, cells: RaggedArray, turned: np.ndarray
) -> dict[str, tuple[np.ndarray, np.ndarray]]:
    """Find the nodes of polyhedra that are cells of known kinds but for hanging nodes; see `cells_from_faces`.

    Four quads around a node become one, and nodes that are then in at most two faces of a cell are left out.

    Parameters
    ----------
    points : (n, 3) float64
    faces, cells, turned
        Of the polyhedra, as of `cells_from_faces`.
    """
    n, lengths = len(points), faces.lengths[cells.values]
    cell_of = np.repeat(np.arange(len(cells)), cells.lengths)
    loop_of = np.repeat(np.arange(cells.values.size), lengths)
    place = np.arange(loop_of.size) - np.repeat(np.cumsum(lengths) - lengths, lengths)
    place = np.where(turned[loop_of], lengths[loop_of] - 1 - place, place)
    nodes = faces.values[faces.start[cells.values][loop_of] + place] + n * cell_of[loop_of]  # each cell has its own
    four = np.flatnonzero(lengths == 4)
    quads = nodes[(lengths == 4)[loop_of]].reshape(-1, 4)
    corners, parts, _ = quads_in_four(quads)
    x = points[quads % n]
    normals = np.cross(x[:, 2] - x[:, 0], x[:, 3] - x[:, 1])[parts]
    mean = normals.sum(axis=1, keepdims=True)
    sizes = np.linalg.norm(normals, axis=2) * np.linalg.norm(mean, axis=2)
    flat = ((normals * mean).sum(axis=2) > _LEAST_COSINE * sizes).all(axis=1)
    joined, corners = four[parts[flat]].ravel(), corners[flat]
    stays = ~np.isin(loop_of, joined)
    nodes, loop_of = np.append(nodes[stays], corners), np.append(loop_of[stays], four[parts[flat, 0]].repeat(4))
    _, number, count = np.unique(nodes, return_inverse=True, return_counts=True)
    used = count[number] > 2
    order = np.argsort(loop_of[used], kind="stable")
    nodes, loop_of = nodes[used][order], loop_of[used][order]
    loops, width = np.unique(loop_of, return_counts=True)
    rows = RaggedArray(np.concatenate([[0], np.cumsum(width)]), nodes % n)
    start = np.searchsorted(cell_of[loops], np.arange(len(cells) + 1))
    return cells_from_faces(rows, RaggedArray(start, np.arange(len(loops))), np.zeros(len(loops), bool))
