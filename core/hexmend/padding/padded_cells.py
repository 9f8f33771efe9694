"""Quads and lines of a padded mesh: those inside go on through the layer, those on its faces stay."""

from __future__ import annotations

import numpy as np

from hexmend.mesh.cells import Cells
from hexmend.mesh.hexahedron import EDGES, FACES
from hexmend.padding.inserted_layer import LATERAL, Sheet
from hexmend.padding.mid_nodes import CENTRES, COLUMN
from hexmend.padding.padded_data import Numbering, extended_data, extended_set
from hexmend.padding.sides import extensions


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
        columns = COLUMN[corners, np.roll(corners, -1, axis=1)]
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
    keys = np.concatenate([corners, np.sort(quads[:, :4], axis=1)])
    _, first, which = np.unique(keys, axis=0, return_index=True, return_inverse=True)
    found = first[which.reshape(-1)[len(corners) :]]
    rows = np.flatnonzero((found >= np.count_nonzero(on_sheet)) & (found < len(corners)))
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
    keys, given = _keys(pairs, n), _keys(lines[:, :2].astype(np.int64), n)
    _, first, which = np.unique(np.concatenate([keys, given]), return_index=True, return_inverse=True)
    found = first[which.reshape(-1)[len(keys) :]]
    rows = np.flatnonzero((found < len(keys)) & ~np.isin(given, _keys(on_sheet, n)))
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


def _keys(pairs: np.ndarray, n: int) -> np.ndarray:
    """Number of each pair of nodes (j, 2), whatever its order."""
    return pairs.min(axis=1) * n + pairs.max(axis=1)
