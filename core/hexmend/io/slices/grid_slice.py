"""Slice of a grid, and files that can be read in slices."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Protocol

import numpy as np

from hexmend.io.formats.vtk.grid import Grid
from hexmend.io.formats.vtk.merge_grids import join_grids


@dataclass(frozen=True, eq=False, kw_only=True)
class GridSlice(Grid):
    """Some cells and some nodes of a grid, not necessarily the nodes of these cells.

    `nodes` are numbers in the whole grid, and all slices of a file have the same arrays of data.

    Parameters
    ----------
    node_ids, cell_ids : (k,) or (c,) int64
        Their numbers in the whole grid.
    """

    node_ids: np.ndarray
    cell_ids: np.ndarray


class SlicedFile(Protocol):
    """Grid in a file that can be read in slices.

    Attributes
    ----------
    n_nodes, n_cells : int
    field_data : mapping of str to object
    """

    n_nodes: int
    n_cells: int
    field_data: Mapping[str, object]

    def read(self, nodes: slice, cells: slice) -> Grid:
        """Read rows of nodes and of cells; cells have the file's numbers of nodes."""

    def ids(self) -> tuple[np.ndarray, np.ndarray] | None:
        """Return the numbers of all nodes and cells of the file in a larger grid; None if it is no piece of one."""


def slice_of(files: Sequence[SlicedFile], part: int, count: int) -> GridSlice:
    """Read one of `count` parts of about the same size of the grids of some files, counted from 0."""
    sizes = {"nodes": [file.n_nodes for file in files], "cells": [file.n_cells for file in files]}
    ranges = {name: _ranges(of, part, count) for name, of in sizes.items()}
    found = []
    for k, file in enumerate(files):
        nodes, cells = ranges["nodes"][k], ranges["cells"][k]
        if nodes.stop == nodes.start and cells.stop == cells.start and (found or k + 1 < len(files)):
            continue
        grid, ids = file.read(nodes, cells), file.ids()
        node_ids, cell_ids = (np.arange(rows.start, rows.stop) for rows in (nodes, cells))
        numbers = np.asarray(grid.nodes, np.int64)
        if ids is not None:
            node_ids, cell_ids, numbers = ids[0][nodes], ids[1][cells], ids[0][numbers]
        types, start = np.asarray(grid.types).astype(np.uint8), np.asarray(grid.start, np.int64)
        cells_alone = {"types": types, "start": start, "nodes": numbers}
        found.append(GridSlice(**vars(grid) | cells_alone, node_ids=node_ids, cell_ids=cell_ids))
    if len(found) == 1:
        return found[0]
    node_ids, cell_ids = (np.concatenate([getattr(one, name) for one in found]) for name in ("node_ids", "cell_ids"))
    grid, _ = join_grids(found, [one.nodes for one in found])
    return GridSlice(**vars(grid), node_ids=node_ids, cell_ids=cell_ids)


def _ranges(sizes: Sequence[int], part: int, count: int) -> list[slice]:
    """Rows of each file that are in a part, if all rows are counted through."""
    begins = np.concatenate([[0], np.cumsum(sizes)])
    low, high = (int(begins[-1]) * which // count for which in (part, part + 1))
    bounds = np.clip(np.array([[low], [high]]) - begins[:-1], 0, sizes)
    return [slice(*own) for own in bounds.T.tolist()]
