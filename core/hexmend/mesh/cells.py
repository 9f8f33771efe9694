"""Cells other than hexes, whose nodes a mesh keeps in the order of the file."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np


class CellKind(NamedTuple):
    """Kind of a cell other than a hex: dimension, number of nodes (in VTK's order) and VTK cell type."""

    dimension: int
    nodes: int
    vtk: int


#: Supported kinds of cells other than hexes, by name.
CELL_KINDS = {
    "vertex": CellKind(0, 1, 1),
    "line": CellKind(1, 2, 3),
    "triangle": CellKind(2, 3, 5),
    "quad": CellKind(2, 4, 9),
    "tetra": CellKind(3, 4, 10),
    "wedge": CellKind(3, 6, 13),
    "pyramid": CellKind(3, 5, 14),
    "line3": CellKind(1, 3, 21),
    "triangle6": CellKind(2, 6, 22),
    "quad8": CellKind(2, 8, 23),
    "quad9": CellKind(2, 9, 28),
    "tetra10": CellKind(3, 10, 24),
    "wedge15": CellKind(3, 15, 26),
    "pyramid13": CellKind(3, 13, 27),
}


@dataclass(frozen=True, eq=False)
class Cells:
    """Cells of one kind other than hexes; those that are solid are among `hexmend.Mesh.elements`.

    Parameters
    ----------
    kind : str
        One of `CELL_KINDS`.
    nodes : (k, width) int32
        Nodes of each cell, in VTK's order.
    data : mapping of name to (k, ...) array
        Values of the cells.
    sets : mapping of name to (j,) int array
        Named groups of these cells.
    """

    kind: str
    nodes: np.ndarray
    data: Mapping[str, np.ndarray] = field(default_factory=dict)
    sets: Mapping[str, np.ndarray] = field(default_factory=dict)

    @property
    def dimension(self) -> int:
        """Dimension, from 0 for vertices to 3 for solid cells."""
        return CELL_KINDS[self.kind].dimension
