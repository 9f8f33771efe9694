"""Faces that several faces of other cells cover, and the nodes that hang there.

Two triangles cover a quad where hexes meet tetrahedra without pyramids between them; four quads cover one where the
cells on one side are refined. The nodes in the middle of its edges and of the face hang: they are no corners of the
coarse cell.
"""

from __future__ import annotations

import numpy as np

from hexmend.arrays import find_rows
from hexmend.mesh.solid_cells import face_nodes, kinds_of


def close_split_faces(elements: np.ndarray, neighbours: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Close the faces of cells that others cover, and these: they are no boundary.

    Parameters
    ----------
    elements : (m, 8) int32
    neighbours : (m, 6) int32
        Of the cells, -1 where there is none.

    Returns
    -------
    neighbours : (m, 6) int32
        With the cell itself as neighbour across a closed face.
    hanging : (h, 5) int32
        Each hanging node once, ascending, and the four nodes whose mean it is in a regular refinement: those of the
        face, or each end of the edge twice.
    """
    cells, faces = np.nonzero(neighbours < 0)
    nodes = face_nodes(elements, cells, faces)
    is_triangle = nodes[:, 2] == nodes[:, 3]
    triangles, quads = np.flatnonzero(is_triangle), np.flatnonzero(~is_triangle)
    corners, parts, middles = quads_in_four(nodes[quads])
    coarse = _covered(nodes[quads], corners)
    covers = np.flatnonzero(coarse >= 0)
    nine = np.sort(np.hstack([corners[covers], middles[covers]]), axis=1)
    covers = covers[(np.diff(nine, axis=1) > 0).all(axis=1)]
    closed = [quads[coarse[covers]], quads[parts[covers]].ravel()]
    if triangles.size and quads.size and kinds_of(elements).any():
        closed += _halved_by_triangles(nodes[triangles, :3], nodes[quads], triangles, quads)
    rows = np.concatenate(closed)
    if not rows.size:
        return neighbours, np.zeros((0, 5), np.int32)
    answer = neighbours.copy()
    answer[cells[rows], faces[rows]] = cells[rows]
    of_face, after = corners[covers], np.roll(corners[covers], -1, axis=1)
    masters = np.concatenate([np.stack([of_face, of_face, after, after], axis=2), of_face[:, None]], axis=1)
    hanging = np.concatenate([middles[covers][:, :, None], masters], axis=2).reshape(-1, 5)
    return answer, hanging[np.unique(hanging[:, 0], return_index=True)[1]]


def _halved_by_triangles(
    triangles: np.ndarray, quads: np.ndarray, of_triangle: np.ndarray, of_quad: np.ndarray
) -> list[np.ndarray]:
    """Numbers of the quads (k, 4) that two of the triangles (j, 3) cover along either diagonal, and of these."""
    known, closed = _from_lowest(triangles), []
    for corners in ([[0, 2, 1], [0, 3, 2]], [[0, 3, 1], [1, 3, 2]]):  # seen from the other side
        halves = [find_rows(known, _from_lowest(quads[:, half])) for half in corners]
        covered = (halves[0] >= 0) & (halves[1] >= 0)
        closed += [of_quad[covered], *(of_triangle[half[covered]] for half in halves)]
    return closed


def quads_in_four(quads: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Find the nodes at which four of the quads (k, 4) meet.

    Returns
    -------
    corners : (j, 4) int32
        Outer corners of the four, counter-clockwise.
    parts : (j, 4) int64
        Their numbers.
    middles : (j, 5) int32
        The nodes between each corner and the next, and the node itself.
    """
    flat = quads.ravel()
    order = np.argsort(flat, kind="stable")
    centre, first, count = np.unique(flat[order], return_index=True, return_counts=True)
    places = order[first[count == 4][:, None] + np.arange(4)]  # of the node in the four quads at it
    ahead, across, behind = ((places & ~3 | places + step & 3) for step in (1, 2, 3))
    turn = np.zeros(places.shape, np.int64)  # the quads in their order around the node
    for k in range(3):
        end = np.take_along_axis(flat[behind], turn[:, k : k + 1], axis=1)
        turn[:, k + 1] = (flat[ahead] == end).argmax(axis=1)
    is_ring = (np.sort(turn, axis=1) == np.arange(4)).all(axis=1)
    places, across, behind = (np.take_along_axis(each, turn, axis=1)[is_ring] for each in (places, across, behind))
    return flat[across], places >> 2, np.column_stack([flat[behind], centre[count == 4][is_ring]])


def _covered(quads: np.ndarray, corners: np.ndarray) -> np.ndarray:
    """Number of the quad (k, 4) with some corners (j, 4), seen from its other side, (j,) int64; -1 where none has."""
    n = int(quads.max(initial=0)) + 1
    sought, known = (np.sort(rows, axis=1).astype(np.int64) for rows in (corners, quads))
    number = np.full(len(corners), -1)
    alike = np.isin(sought[:, 0] * n + sought[:, 3], known[:, 0] * n + known[:, 3])  # few are
    number[alike] = find_rows(known, sought[alike])
    there = np.flatnonzero(number >= 0)
    rows = quads[number[there]]
    place = (rows == corners[there, :1]).argmax(axis=1)
    number[there[rows[np.arange(len(rows)), place - 1] != corners[there, 1]]] = -1
    return number


def _from_lowest(triangles: np.ndarray) -> np.ndarray:
    """Turn triangles (k, 3) so that the lowest node comes first, in the same sense."""
    return np.take_along_axis(triangles, (triangles.argmin(axis=1)[:, None] + np.arange(3)) % 3, axis=1)
