"""Number of nodes, dimension and node order of every kind of cell, hexahedra included."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from hexmend.mesh.cells import CELL_KINDS

#: Kinds of hexes and their numbers of nodes, in the order of VTK's types 12, 25 and 29.
HEX_KINDS = {"hex": 8, "hex20": 20, "hex27": 27}


def node_count(kind: str) -> int:
    """Number of nodes of a cell of a kind, one of `HEX_KINDS` or `CELL_KINDS`."""
    return HEX_KINDS[kind] if kind in HEX_KINDS else CELL_KINDS[kind].nodes


def dimension(kind: str) -> int:
    """Dimension of a cell of a kind: 0 for a vertex up to 3 for a volume."""
    return 3 if kind in HEX_KINDS else CELL_KINDS[kind].dimension


def to_vtk_order(nodes: np.ndarray, kind: str, order: Mapping[str, Sequence[int] | np.ndarray]) -> np.ndarray:
    """Reorder the nodes of cells from the order of a format to VTK's.

    Parameters
    ----------
    nodes : (k, width) array
    kind : str
    order : mapping of str to (width,) int
        vtk = format[order[kind]]; kinds without an entry have one order in both.

    Returns
    -------
    (k, width) array
    """
    return nodes[:, order[kind]] if kind in order else nodes


def from_vtk_order(nodes: np.ndarray, kind: str, order: Mapping[str, Sequence[int] | np.ndarray]) -> np.ndarray:
    """Reorder the nodes of cells from VTK's order to the order of a format, the inverse of `to_vtk_order`."""
    return nodes[:, np.argsort(order[kind])] if kind in order else nodes
