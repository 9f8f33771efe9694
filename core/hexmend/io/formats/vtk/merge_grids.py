"""Grids that are pieces of one: put together, without the cells that a piece only has for its neighbours' sake."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np

from hexmend.io.formats.vtk.grid import Grid

#: How pieces mark cells and nodes that belong to another one, and how they number nodes through all pieces.
_GHOSTS = {"vtkGhostType": 1, "vtkGhostLevels": 255}
_NUMBERS = ("GlobalNodeIds", "GlobalNodeId", "GlobalPointIds")


def merge_grids(grids: Sequence[Grid]) -> Grid:
    """One grid of several; its notes say what was done.

    Ghost cells are dropped. Nodes are one where the pieces number them through (by an array "GlobalNodeIds" or the
    like); else those where pieces meet stay double, as VTK keeps them.

    Parameters
    ----------
    grids : sequence of Grid
        At least one.
    """
    notes = list(dict.fromkeys(note for grid in grids for note in grid.notes))
    marked = any(name in grid.cell_data for grid in grids for name in _GHOSTS)
    if marked:
        before = sum(len(grid.types) for grid in grids)
        grids = [_without_ghosts(grid) for grid in grids]
        dropped = before - sum(len(grid.types) for grid in grids)
        if dropped:
            notes.append(f"{dropped:,} ghost cells, which pieces of the file have of their neighbours, are left out.")
    if len(grids) == 1:
        return replace(grids[0], notes=tuple(notes))
    grids = [grid for grid in grids if len(grid.points) or len(grid.types)] or list(grids[:1])
    counts = np.array([len(grid.points) for grid in grids])
    first = np.concatenate([[0], np.cumsum(counts)])
    starts = np.concatenate([[0], np.cumsum([len(grid.nodes) for grid in grids])])
    node_data, lost = _data([grid.node_data for grid in grids])
    cell_data, more = _data([grid.cell_data for grid in grids])
    if lost + more:
        notes.append(f"Arrays that not all pieces have alike are left out: {', '.join(lost + more)}.")
    whole = Grid(
        np.concatenate([grid.points for grid in grids]),
        np.concatenate([grid.types for grid in grids]),
        np.concatenate([[0], *(grid.start[1:] + begin for grid, begin in zip(grids, starts, strict=False))]),
        np.concatenate([_moved(grid, int(begin)) for grid, begin in zip(grids, first, strict=False)]),
        node_data,
        cell_data,
        {name: values for grid in reversed(grids) for name, values in grid.field_data.items()},
    )
    whole, said = _merged(whole)
    return replace(whole, notes=(f"Its {len(grids)} pieces are put together{said}.", *notes))


def _moved(grid: Grid, by: int) -> np.ndarray:
    """Nodes counted through all pieces; those that the piece has not stay such."""
    nodes = np.asarray(grid.nodes, np.int64)
    return np.where((nodes >= 0) & (nodes < len(grid.points)), nodes + by, -1)


def _data(parts: Sequence[Mapping[str, np.ndarray]]) -> tuple[dict[str, np.ndarray], list[str]]:
    """Arrays that all pieces have, and the names of the others."""
    answer, lost = {}, []
    for name in dict.fromkeys(name for part in parts for name in part):
        arrays = [np.asarray(part[name]) for part in parts if name in part]
        if len(arrays) == len(parts) and len({array.shape[1:] for array in arrays}) == 1:
            answer[name] = np.concatenate(arrays)
        else:
            lost.append(name)
    return answer, lost


def _without_ghosts(grid: Grid) -> Grid:
    """A grid without cells of other pieces and the nodes that only these use."""
    marks = {name: np.asarray(grid.cell_data[name]) & bits for name, bits in _GHOSTS.items() if name in grid.cell_data}
    data = {name: values for name, values in grid.cell_data.items() if name not in _GHOSTS}
    node_data = {name: values for name, values in grid.node_data.items() if name not in _GHOSTS}
    ghost = np.zeros(len(grid.types), bool)
    for mark in marks.values():
        ghost |= mark.reshape(len(ghost), -1).any(axis=1)
    nodes = np.asarray(grid.nodes, np.int64)
    if not ghost.any() or (nodes.size and (nodes.min() < 0 or nodes.max() >= len(grid.points))):
        return Grid(grid.points, grid.types, grid.start, nodes, node_data, data, grid.field_data)
    widths = np.diff(grid.start)
    dropped = np.zeros(len(grid.points), bool)
    dropped[nodes[np.repeat(ghost, widths)]] = True
    dropped[nodes[np.repeat(~ghost, widths)]] = False
    place = np.cumsum(~dropped) - 1
    return Grid(
        grid.points[~dropped],
        np.asarray(grid.types)[~ghost],
        np.concatenate([[0], np.cumsum(widths[~ghost])]),
        place[nodes[np.repeat(~ghost, widths)]],
        {name: np.asarray(values)[~dropped] for name, values in node_data.items()},
        {name: np.asarray(values)[~ghost] for name, values in data.items()},
        grid.field_data,
    )


def _merged(grid: Grid) -> tuple[Grid, str]:
    """A grid whose nodes of the same number are one, and what is to be said of nodes at the same place."""
    name = next((name for name in _NUMBERS if name in grid.node_data), None)
    if name is None or np.ndim(grid.node_data[name]) != 1:
        x, y, z = grid.points.T
        double = len(x) - len(np.unique(x + np.e * y + np.pi * z))  # of other places a sum that is the same is no risk
        return grid, f"; {double:,} nodes where they meet are double" if double else ""
    _, first, which = np.unique(np.asarray(grid.node_data[name]), return_index=True, return_inverse=True)
    if len(first) == len(grid.points) or not np.array_equal(grid.points[first][which], grid.points):
        return grid, ""
    order = np.argsort(first)
    place = np.argsort(order)[which]
    chosen = first[order]
    nodes = np.where(grid.nodes >= 0, place[grid.nodes], -1)
    node_data = {name: values[chosen] for name, values in grid.node_data.items()}
    said = f" where their {name} agree"
    return Grid(grid.points[chosen], grid.types, grid.start, nodes, node_data, grid.cell_data, grid.field_data), said
