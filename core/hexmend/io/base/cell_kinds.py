"""Number of nodes and dimension of every kind of cell, hexahedra included."""

from __future__ import annotations

from hexmend.io.base.content import HEX_KINDS
from hexmend.mesh.cells import CELL_KINDS


def node_count(kind: str) -> int:
    """Number of nodes of a cell of a kind, one of `HEX_KINDS` or `CELL_KINDS`."""
    return HEX_KINDS[kind] if kind in HEX_KINDS else CELL_KINDS[kind].nodes


def dimension(kind: str) -> int:
    """Dimension of a cell of a kind: 0 for a vertex up to 3 for a volume."""
    return 3 if kind in HEX_KINDS else CELL_KINDS[kind].dimension
