"""Side sets of a padded mesh: outer faces pass to the new hexes, faces inside go on to the faces of the layer.

Quads and lines of a padded mesh: those inside go on through the layer, those on its faces stay.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from hexmend.arrays import find_rows
from hexmend.mesh.cells import Cells
from hexmend.mesh.hexahedron import EDGES, FACES
from hexmend.mesh.second_order.mid_node_lookup import EDGE_COLUMNS
from hexmend.padding.inserted_layer import LATERAL, OUTER, Sheet
from hexmend.padding.mid_nodes import CENTRES
from hexmend.padding.padded_data import Numbering, extended_data, extended_set

#: Largest number of hexes around an edge that are passed.
_MAX_AROUND = 256


class Extension(NamedTuple):
    """Faces between new hexes in which sides of the mesh go on through the layer.

    Parameters
    ----------
    rows : (j,) int64
        Row of the side that each continues.
    hexes : (j,) int64
        New hex, counted from 0.
    sides : (j,) int64
        Side of its outer face, from corner i to corner i + 1.
    """

    rows: np.ndarray
    hexes: np.ndarray
    sides: np.ndarray


def extensions(sheet: Sheet, sides: np.ndarray) -> Extension:
    """Find the faces in which sides inside the mesh, or beside the sheet, go on through the layer.

    At an edge of the sheet the hexes around it are passed, from the side's own hex on, up to a face of the sheet: the
    new hex there has the face that goes on.

    Parameters
    ----------
    sheet : Sheet
    sides : (j, 2) int
        A hex and its face, in each row; none is a face of the sheet.

    Returns
    -------
    Extension
    """
    mesh = sheet.mesh
    near = np.flatnonzero((sheet.copy_of_corner[sides[:, :1], FACES[sides[:, 1]]] >= 0).sum(axis=1) >= 2)
    rows = np.repeat(near, 4)
    hexes, faces = sides[rows].T.astype(np.int64)
    side = np.tile(np.arange(4), near.size)
    corners = FACES[faces[:, None], np.stack([side, (side + 1) % 4], axis=1)]
    ends = mesh.hexes[hexes[:, None], corners]
    whole = (sheet.copy_of_corner[hexes[:, None], corners] >= 0).all(axis=1)
    rows, hexes, faces, ends = rows[whole], hexes[whole], faces[whole], ends[whole]
    found: list[tuple[np.ndarray, ...]] = []
    for _ in range(_MAX_AROUND):
        if not rows.size:
            break
        faces = _other_face(mesh.hexes[hexes], faces, ends)
        number = sheet.face_number[hexes, faces]
        at = np.flatnonzero(number >= 0)
        at_corner = sheet.quads[number[at]]
        first = (at_corner[:, :, None] == ends[at][:, None, :]).any(axis=2)
        follows = first & np.roll(first, -1, axis=1)
        found.append((rows[at], number[at], follows.argmax(axis=1)))
        across = mesh.topology.hex_neighbours[hexes, faces].astype(np.int64)
        on = np.flatnonzero((number < 0) & (across >= 0) & sheet.region[across])
        back = (mesh.topology.hex_neighbours[across[on]] == hexes[on][:, None]).argmax(axis=1)
        rows, hexes, faces, ends = rows[on], across[on], back, ends[on]
    if not found:
        found = [(np.empty(0, np.int64),) * 3]
    return Extension(*(np.concatenate(parts) for parts in zip(*found, strict=True)))


def _other_face(hexes: np.ndarray, faces: np.ndarray, ends: np.ndarray) -> np.ndarray:
    """Face of each hex (j, 8) at the edge between two nodes (j, 2) that is not a given one (j,), (j,) int64."""
    at = (hexes[:, FACES][..., None] == ends[:, None, None, :]).any(axis=2).all(axis=2)
    at[np.arange(len(faces)), faces] = False
    return at.argmax(axis=1)


def padded_side_set(sheet: Sheet, sides: np.ndarray) -> np.ndarray:
    """Return a side set of the padded mesh.

    Parameters
    ----------
    sheet : Sheet
    sides : (j, 2) int
        The set in the mesh: a hex and its face in each row.

    Returns
    -------
    (i, 2) int64
        Sides on the sheet are those of the new hexes; the others have those added in which they go on.
    """
    number, m = sheet.face_number[sides[:, 0], sides[:, 1]], sheet.mesh.n_hexes
    answer = np.where((number >= 0)[:, None], np.stack([m + number, np.full_like(number, OUTER)], axis=1), sides)
    more = extensions(sheet, sides[number < 0])
    _, first = np.unique(sheet.lateral_of_side[more.hexes, more.sides], return_index=True)
    first.sort()
    added = np.stack([m + more.hexes[first], LATERAL[more.sides[first]]], axis=1)
    return np.concatenate([answer, added])


def padded_cells(sheet: Sheet, cells: Cells, mid_nodes: np.ndarray | None, ids: Numbering) -> Cells:
    """Return cells other than hexes, as they are in the padded mesh.

    Parameters
    ----------
    sheet : Sheet
    cells : Cells
        Quads and lines on faces and edges of hexes follow these; others stay as they are.
    mid_nodes : (m + k, 19) int or None
        Of the padded mesh.
    ids : Numbering
        Numbers for cells that are added.

    Returns
    -------
    Cells
    """
    if not len(cells.nodes):
        return cells
    if cells.kind in ("quad", "quad8", "quad9"):
        nodes, rows, added = _padded_quads(sheet, cells.nodes, mid_nodes)
    elif cells.kind in ("line", "line3"):
        nodes, rows, added = _padded_lines(sheet, cells.nodes, mid_nodes)
    else:
        return cells
    if not rows.size:
        return Cells(cells.kind, nodes, cells.data, cells.sets)
    return Cells(
        cells.kind,
        np.concatenate([nodes, added]).astype(np.int32),
        extended_data(cells.data, rows, ids),
        {name: extended_set(members, rows, len(nodes)) for name, members in cells.sets.items()},
    )


def _padded_quads(
    sheet: Sheet, quads: np.ndarray, mid_nodes: np.ndarray | None
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Quads (j, 4 to 9) with the nodes behind the layer; rows (i,) that go on, and the quads (i, ...) in which."""
    rows, sides = _sides_of(sheet, quads)
    nodes, width = quads.astype(np.int64), quads.shape[1]
    hexes, faces = sides.T
    corners = (sheet.mesh.hexes[hexes][:, None, :] == quads[rows, :4, None]).argmax(axis=2)
    nodes[rows, :4] = sheet.inner_hexes[hexes[:, None], corners]
    if mid_nodes is not None and width > 4:
        columns = EDGE_COLUMNS[corners, np.roll(corners, -1, axis=1)]
        columns = np.concatenate([columns, CENTRES + faces[:, None]], axis=1)[:, : width - 4]
        nodes[rows, 4:] = mid_nodes[hexes[:, None], columns]
    more = extensions(sheet, sides)
    _, first = np.unique(sheet.lateral_of_side[more.hexes, more.sides], return_index=True)
    row, new, side = rows[more.rows[first]], more.hexes[first], more.sides[first]
    after = (side + 1) % 4
    at = (quads[row, :4] == sheet.quads[new, side][:, None]).argmax(axis=1)
    same = quads[row, (at + 1) % 4] == sheet.quads[new, after]
    start, end = np.where(same, after, side), np.where(same, side, after)
    added = sheet.new_hexes[new[:, None], np.stack([start, end, end + 4, start + 4], axis=1)]
    if mid_nodes is not None and width > 4:
        columns = np.stack([side, 8 + end, 4 + side, 8 + start, CENTRES + LATERAL[side]], axis=1)[:, : width - 4]
        added = np.concatenate([added, mid_nodes[sheet.mesh.n_hexes + new[:, None], columns]], axis=1)
    return nodes, row, added


def _sides_of(sheet: Sheet, quads: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Rows (i,) of quads that are faces of hexes behind the layer, but not of the sheet; and these sides (i, 2)."""
    near = np.flatnonzero((sheet.copy_of_corner >= 0).any(axis=1))
    sides = np.stack([np.repeat(near, 6), np.tile(np.arange(6), near.size)], axis=1)
    on_sheet = sheet.is_padded[sides[:, 0], sides[:, 1]]
    sides = np.concatenate([sides[on_sheet], sides[~on_sheet]])  # a face of the sheet has another hex across
    corners = np.sort(sheet.mesh.hexes[sides[:, :1], FACES[sides[:, 1]]], axis=1)
    found = find_rows(corners, np.sort(quads[:, :4], axis=1))
    rows = np.flatnonzero(found >= np.count_nonzero(on_sheet))
    return rows, sides[found[rows]]


def _padded_lines(
    sheet: Sheet, lines: np.ndarray, mid_nodes: np.ndarray | None
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Lines (j, 2 or 3) with the nodes behind the layer; rows (i,) that go on, and the lines (i, ...) in which."""
    mesh, copies, n = sheet.mesh, sheet.copy_of_corner, sheet.mesh.n_nodes
    near = np.flatnonzero((copies >= 0).any(axis=1))
    pairs = mesh.hexes[near][:, EDGES].reshape(-1, 2).astype(np.int64)
    numbers = copies[near][:, EDGES].reshape(-1, 2)
    on_sheet = np.sort(sheet.originals[sheet.edges], axis=1)
    given = np.sort(lines[:, :2], axis=1)
    found = find_rows(np.sort(pairs, axis=1), given)
    rows = np.flatnonzero((found >= 0) & (find_rows(on_sheet, given) < 0))
    edge, number = pairs[found[rows]], numbers[found[rows]]
    turned = edge[:, 0] != lines[rows, 0]
    number[turned] = number[turned, ::-1]
    nodes = lines.astype(np.int64)
    nodes[rows, :2] = np.where(number >= 0, n + number, lines[rows, :2])
    at, end = np.nonzero(number >= 0)
    added = np.stack([n + number[at, end], lines[rows[at], end]], axis=1)
    if lines.shape[1] == 3 and mid_nodes is not None:
        upright = np.full(len(sheet.originals), -1)
        upright[sheet.new_hexes[:, :4] - n] = mid_nodes[mesh.n_hexes :, 8:12]
        added = np.concatenate([added, upright[number[at, end]][:, None]], axis=1)
    added, once = np.unique(added, axis=0, return_index=True)
    return nodes, rows[at[once]], added
