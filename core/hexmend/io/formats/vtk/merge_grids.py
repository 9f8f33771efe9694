"""Merging of the pieces of a grid, without ghost cells.

Names in PVTU files: those of pieces, and of arrays that number the nodes and cells of all pieces.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np

from hexmend.arrays import index_of, mask
from hexmend.io.base.remedies import unread_note
from hexmend.io.formats.vtk.grid import Grid
from hexmend.io.formats.vtk.xml_document import Document
from hexmend.kernels import closest_point

#: Arrays of the numbers, from 0, that nodes and cells of a piece have in the whole mesh.
NODE_ID, CELL_ID = "GlobalNodeId", "GlobalElementId"


def piece_names(path: Path) -> list[str]:
    """List the names of the pieces of a PVTU file.

    Raises
    ------
    FileError
        For another file, and for one without pieces.
    """
    with Document(path, "PUnstructuredGrid") as document:
        names = [piece.get("Source") for piece in document.root.first("PUnstructuredGrid").all("Piece")]
        if not names:
            raise document.error("lists no pieces")
    return names


#: Arrays that mark cells and nodes of other pieces, and the bits that do.
GHOSTS = {"vtkGhostType": 1, "vtkGhostLevels": 255}
#: Arrays that number the nodes of all pieces.
_GLOBAL_IDS = ("GlobalNodeIds", "GlobalNodeId", "GlobalPointIds")


def merge_grids(grids: Sequence[Grid], in_files: bool = False) -> Grid:
    """Merge the pieces of a grid; its notes say how.

    Ghost cells are removed. Nodes are merged if the pieces have global ids, in an array such as "GlobalNodeIds".

    Parameters
    ----------
    grids : sequence of Grid
        At least one.
    in_files : bool
        Pieces are files of their own. Without global ids, nodes of different pieces at exactly the same place are
        merged then; else duplicate nodes between pieces stay, as in VTK. Nodes and cells are put into the order of the
        numbers that Hexmend has written.

    Returns
    -------
    Grid
    """
    notes = list(dict.fromkeys(note for grid in grids for note in grid.notes))
    marked = any(name in grid.cell_data for grid in grids for name in GHOSTS)
    if marked:
        before = sum(len(grid.types) for grid in grids)
        grids = [_without_ghosts(grid) for grid in grids]
        dropped = before - sum(len(grid.types) for grid in grids)
        if dropped:
            notes.append(f"{dropped:,} ghost cells, which repeat cells of other pieces, are left out.")
    if len(grids) == 1:
        grid = replace(grids[0], notes=tuple(notes))
        return (_in_written_order(grid) or grid) if in_files else grid
    grids = [grid for grid in grids if len(grid.points) or len(grid.types)] or list(grids[:1])
    counts = np.array([len(grid.points) for grid in grids])
    first = np.concatenate([[0], np.cumsum(counts)])
    whole, lost = join_grids(grids, [_shift_nodes(*pair) for pair in zip(grids, first.tolist(), strict=False)])
    if lost:
        notes.append(unread_note(f"arrays that are missing or different in some pieces ({', '.join(lost)})"))
    merged, phrase = _merge_nodes(whole, np.repeat(np.arange(len(grids)), counts) if in_files else None)
    ordered = _in_written_order(merged) if in_files else None
    if ordered is not None:
        return replace(ordered, notes=tuple(notes))
    return replace(merged, notes=(f"Its {len(grids)} pieces are merged{phrase}.", *notes))


def _in_written_order(grid: Grid) -> Grid | None:
    """Put nodes and cells into the order of their numbers, without these; None unless they have all from 0 on."""
    numbers = grid.node_data.get(NODE_ID), grid.cell_data.get(CELL_ID)
    counts = len(grid.points), len(grid.types)
    if not all(_is_numbering(ids, count) for ids, count in zip(numbers, counts, strict=True)):
        return None
    node_data = {name: values for name, values in grid.node_data.items() if name != NODE_ID}
    cell_data = {name: values for name, values in grid.cell_data.items() if name != CELL_ID}
    return _chosen(replace(grid, node_data=node_data, cell_data=cell_data), *map(np.argsort, numbers))


def _chosen(grid: Grid, nodes: np.ndarray, cells: np.ndarray) -> Grid:
    """Return a grid of some nodes (k,) and cells (j,), in this order."""
    widths = np.diff(grid.start)[cells]
    start = np.concatenate([[0], np.cumsum(widths)])
    of_cells = np.arange(start[-1]) + np.repeat(grid.start[:-1][cells] - start[:-1], widths)
    new_number = np.append(index_of(nodes, len(grid.points)), -1)  # nodes that no piece has stay -1
    return replace(
        grid,
        points=grid.points[nodes],
        types=np.asarray(grid.types)[cells],
        start=start,
        nodes=new_number[grid.nodes[of_cells]],
        node_data={name: np.asarray(values)[nodes] for name, values in grid.node_data.items()},
        cell_data={name: np.asarray(values)[cells] for name, values in grid.cell_data.items()},
    )


def _is_numbering(ids: np.ndarray | None, count: int) -> bool:
    """Return True for the numbers from 0 to `count` - 1 in any order."""
    if ids is None or np.shape(ids) != (count,) or np.asarray(ids).dtype.kind not in "iu" or not count:
        return False
    return int(ids.min()) == 0 and int(ids.max()) == count - 1 and bool((np.bincount(ids, minlength=count) == 1).all())


def _shift_nodes(grid: Grid, by: int) -> np.ndarray:
    """Nodes counted through all pieces; -1 for nodes that the piece does not have."""
    nodes = np.asarray(grid.nodes, np.int64)
    return np.where((nodes >= 0) & (nodes < len(grid.points)), nodes + by, -1)


def join_grids(grids: Sequence[Grid], nodes: Sequence[np.ndarray]) -> tuple[Grid, list[str]]:
    """Put grids one after the other.

    Parameters
    ----------
    grids : sequence of Grid
    nodes : sequence of (k,) int
        Nodes of the cells of each, counted through all of them.

    Returns
    -------
    grid : Grid
    lost : list of str
        Names of arrays that are left out, since some of the grids lack them or have them in another width.
    """
    node_data, lost = _concatenate_common([grid.node_data for grid in grids])
    cell_data, more = _concatenate_common([grid.cell_data for grid in grids])
    points, types = (np.concatenate([getattr(grid, name) for grid in grids]) for name in ("points", "types"))
    begins = np.cumsum([0, *(grid.start[-1] for grid in grids)])
    start = np.concatenate([[0], *(grid.start[1:] + begin for grid, begin in zip(grids, begins, strict=False))])
    fields = {name: values for grid in reversed(grids) for name, values in grid.field_data.items()}
    return Grid(points, types, start, np.concatenate(nodes), node_data, cell_data, fields), lost + more


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
    ghost = np.zeros(len(grid.types), bool)
    for name in GHOSTS.keys() & grid.cell_data.keys():
        ghost |= (np.asarray(grid.cell_data[name]) & GHOSTS[name]).reshape(len(ghost), -1).any(axis=1)
    data = {name: values for name, values in grid.cell_data.items() if name not in GHOSTS}
    node_data = {name: values for name, values in grid.node_data.items() if name not in GHOSTS}
    nodes = np.asarray(grid.nodes, np.int64)
    grid = replace(grid, nodes=nodes, node_data=node_data, cell_data=data)
    if not ghost.any() or (nodes.size and (nodes.min() < 0 or nodes.max() >= len(grid.points))):
        return grid
    of_ghosts = np.repeat(ghost, np.diff(grid.start))
    dropped = mask(nodes[of_ghosts], len(grid.points))
    dropped[nodes[~of_ghosts]] = False
    return _chosen(grid, np.flatnonzero(~dropped), np.flatnonzero(~ghost))


def _merge_nodes(grid: Grid, piece: np.ndarray | None) -> tuple[Grid, str]:
    """Merge nodes with the same global id, else those of different pieces (n,) at the same place.

    Returns the grid and a phrase about nodes for a note. Without `piece`, places do not count.
    """
    known = [name for name in _GLOBAL_IDS if np.ndim(grid.node_data.get(name)) == 1]
    if known:
        name = NODE_ID if NODE_ID in known and piece is not None else known[0]  # others may have come with the mesh
        keys, phrase = np.asarray(grid.node_data[name]), f" where their {name} agree"
    else:
        keys = _keys_of_places(grid.points, piece)
        duplicates = len(keys) - len(np.unique(keys))
        if piece is None or not duplicates:
            return grid, f"; {duplicates:,} duplicate nodes remain where they meet" if duplicates else ""
        phrase = f"; {duplicates:,} nodes are merged with others at the same place"
    _, first, which = np.unique(keys, return_index=True, return_inverse=True)
    if len(first) == len(grid.points) or not np.array_equal(grid.points[first][which], grid.points):
        return grid, ""
    order = np.argsort(first)
    new_index = np.argsort(order)[which]
    chosen = first[order]
    nodes = np.where(grid.nodes >= 0, new_index[grid.nodes], -1)
    node_data = {name: values[chosen] for name, values in grid.node_data.items()}
    return replace(grid, points=grid.points[chosen], nodes=nodes, node_data=node_data), phrase


def _keys_of_places(points: np.ndarray, piece: np.ndarray | None) -> np.ndarray:
    """Number the places of nodes (n, 3), (n,) int64; nodes of a place where one piece has several have their own."""
    keys = closest_point.numbers_of_different_points(np.ascontiguousarray(points)).astype(np.int64)
    if piece is not None and len(points):
        pairs, counts = np.unique(keys * (piece.max() + 1) + piece, return_counts=True)
        several = np.isin(keys, pairs[counts > 1] // (piece.max() + 1))
        keys[several] = len(points) + np.arange(np.count_nonzero(several))
    return keys
