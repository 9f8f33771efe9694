"""Merging of the pieces of a grid, without ghost cells."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np

from hexmend.io.coordinates.unread import unread_note
from hexmend.io.formats.vtk.grid import Grid

#: Arrays that mark cells and nodes of other pieces, and the bits that do.
_GHOSTS = {"vtkGhostType": 1, "vtkGhostLevels": 255}
#: Arrays that number the nodes of all pieces.
_GLOBAL_IDS = ("GlobalNodeIds", "GlobalNodeId", "GlobalPointIds")


def merge_grids(grids: Sequence[Grid]) -> Grid:
    """Merge the pieces of a grid; its notes say how.

    Ghost cells are removed. Nodes are merged if the pieces have global ids, in an array such as "GlobalNodeIds"; else
    duplicate nodes between pieces stay, as in VTK.

    Parameters
    ----------
    grids : sequence of Grid
        At least one.

    Returns
    -------
    Grid
    """
    notes = list(dict.fromkeys(note for grid in grids for note in grid.notes))
    marked = any(name in grid.cell_data for grid in grids for name in _GHOSTS)
    if marked:
        before = sum(len(grid.types) for grid in grids)
        grids = [_without_ghosts(grid) for grid in grids]
        dropped = before - sum(len(grid.types) for grid in grids)
        if dropped:
            notes.append(f"{dropped:,} ghost cells, which repeat cells of other pieces, are left out.")
    if len(grids) == 1:
        return replace(grids[0], notes=tuple(notes))
    grids = [grid for grid in grids if len(grid.points) or len(grid.types)] or list(grids[:1])
    counts = np.array([len(grid.points) for grid in grids])
    first = np.concatenate([[0], np.cumsum(counts)])
    starts = np.concatenate([[0], np.cumsum([len(grid.nodes) for grid in grids])])
    node_data, lost = _concatenate_common([grid.node_data for grid in grids])
    cell_data, more = _concatenate_common([grid.cell_data for grid in grids])
    if lost + more:
        notes.append(unread_note(f"arrays that are missing or different in some pieces ({', '.join(lost + more)})"))
    points, types = (np.concatenate([getattr(grid, name) for grid in grids]) for name in ("points", "types"))
    start = np.concatenate([[0], *(grid.start[1:] + begin for grid, begin in zip(grids, starts, strict=False))])
    nodes = np.concatenate([_shift_nodes(grid, int(begin)) for grid, begin in zip(grids, first, strict=False)])
    fields = {name: values for grid in reversed(grids) for name, values in grid.field_data.items()}
    merged, phrase = _merge_nodes(Grid(points, types, start, nodes, node_data, cell_data, fields))
    return replace(merged, notes=(f"Its {len(grids)} pieces are merged{phrase}.", *notes))


def _shift_nodes(grid: Grid, by: int) -> np.ndarray:
    """Nodes counted through all pieces; -1 for nodes that the piece does not have."""
    nodes = np.asarray(grid.nodes, np.int64)
    return np.where((nodes >= 0) & (nodes < len(grid.points)), nodes + by, -1)


def _concatenate_common(parts: Sequence[Mapping[str, np.ndarray]]) -> tuple[dict[str, np.ndarray], list[str]]:
    """Concatenate arrays that all pieces have with the same width; returns them and the names of the others."""
    common, lost = {}, []
    for name in dict.fromkeys(name for part in parts for name in part):
        arrays = [np.asarray(part[name]) for part in parts if name in part]
        if len(arrays) == len(parts) and len({array.shape[1:] for array in arrays}) == 1:
            common[name] = np.concatenate(arrays)
        else:
            lost.append(name)
    return common, lost


def _without_ghosts(grid: Grid) -> Grid:
    """Remove ghost cells and the nodes that only these use."""
    marks = {name: np.asarray(grid.cell_data[name]) & bits for name, bits in _GHOSTS.items() if name in grid.cell_data}
    data = {name: values for name, values in grid.cell_data.items() if name not in _GHOSTS}
    node_data = {name: values for name, values in grid.node_data.items() if name not in _GHOSTS}
    ghost = np.zeros(len(grid.types), bool)
    for mark in marks.values():
        ghost |= mark.reshape(len(ghost), -1).any(axis=1)
    nodes = np.asarray(grid.nodes, np.int64)
    if not ghost.any() or (nodes.size and (nodes.min() < 0 or nodes.max() >= len(grid.points))):
        return replace(grid, nodes=nodes, node_data=node_data, cell_data=data, notes=())
    widths = np.diff(grid.start)
    dropped = np.zeros(len(grid.points), bool)
    dropped[nodes[np.repeat(ghost, widths)]] = True
    dropped[nodes[np.repeat(~ghost, widths)]] = False
    types, start = np.asarray(grid.types)[~ghost], np.concatenate([[0], np.cumsum(widths[~ghost])])
    nodes = (np.cumsum(~dropped) - 1)[nodes[np.repeat(~ghost, widths)]]
    node_data = {name: np.asarray(values)[~dropped] for name, values in node_data.items()}
    data = {name: np.asarray(values)[~ghost] for name, values in data.items()}
    return Grid(grid.points[~dropped], types, start, nodes, node_data, data, grid.field_data)


def _merge_nodes(grid: Grid) -> tuple[Grid, str]:
    """Merge nodes with the same global id; returns the grid and a phrase about nodes for a note."""
    name = next((name for name in _GLOBAL_IDS if name in grid.node_data), None)
    if name is None or np.ndim(grid.node_data[name]) != 1:
        x, y, z = grid.points.T
        duplicates = len(x) - len(np.unique(x + np.e * y + np.pi * z))  # a rare collision only changes the note
        return grid, f"; {duplicates:,} duplicate nodes remain where they meet" if duplicates else ""
    _, first, which = np.unique(np.asarray(grid.node_data[name]), return_index=True, return_inverse=True)
    if len(first) == len(grid.points) or not np.array_equal(grid.points[first][which], grid.points):
        return grid, ""
    order = np.argsort(first)
    new_index = np.argsort(order)[which]
    chosen = first[order]
    nodes = np.where(grid.nodes >= 0, new_index[grid.nodes], -1)
    node_data = {name: values[chosen] for name, values in grid.node_data.items()}
    merged = replace(grid, points=grid.points[chosen], nodes=nodes, node_data=node_data)
    return merged, f" where their {name} agree"
