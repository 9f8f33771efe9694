"""The element and the node that are looked at."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from PySide6.QtCore import QObject, Signal

from hexmend_app.state.mesh.document import Document
from hexmend_app.state.mesh.worst_hexes import Worst


@dataclass(frozen=True)
class SelectionData:
    """Data of the selection in a session file."""

    hex: int | None
    node: int | None

    def check(self, hexes: int, nodes: int) -> None:
        """Raise `ValueError` unless a mesh of so many hexes and nodes has them."""
        if not (0 <= (self.hex or 0) < hexes and 0 <= (self.node or 0) < nodes):
            raise ValueError(f"hex {self.hex} or node {self.node} is chosen, which the mesh has not")


class Selection(QObject):
    """One element of the open mesh and one of its nodes, or none.

    Numbers that the open mesh does not have select nothing: a list that still shows the mesh before may name them.

    Parameters
    ----------
    document : Document

    Signals
    -------
    changed
    visited(hexes)
        A hex, or several together, are to be brought before the camera; a tuple of int.

    Attributes
    ----------
    hex, node : int or None
    worst_metric : str
        The metric by which the worst hexes are found.
    """

    changed = Signal()
    visited = Signal(object)

    def __init__(self, document: Document, parent: QObject | None = None):
        super().__init__(parent)
        self._document = document
        self.hex: int | None = None
        self.node: int | None = None
        self.worst_metric = "scaled-jacobian"
        document.mesh_replaced.connect(lambda: self.choose(None))

    def choose(self, hex: int | None, node: int | None = None) -> None:
        """Look at another element and node, or at none; says nothing where nothing changes."""
        if not self._document.has_hex(hex):
            hex = node = None
        if not self._document.has_node(node):
            node = None
        if (hex, node) != (self.hex, self.node):
            self.hex, self.node = hex, node
            self.changed.emit()

    def rank_by(self, metric: str) -> None:
        """Choose the metric by which the worst hexes are found."""
        self.worst_metric = metric

    def worst_hexes(self) -> np.ndarray:
        """Return the worst hexes of the mesh as it is shown, (k,) int64, the worst first; the mesh is open."""
        now = self._document.now
        return Worst.of(now.mesh, now.figures, self.worst_metric).hexes

    def to_data(self) -> SelectionData:
        """Return the data for a session file."""
        return SelectionData(self.hex, self.node)

    def restore(self, data: SelectionData) -> None:
        """Look at what a session has kept."""
        self.choose(data.hex, data.node)

    def visit(self, *hexes: int) -> None:
        """Bring a hex, or several together, before the camera; one alone is looked at too."""
        hexes = tuple(int(h) for h in hexes if self._document.has_hex(h))
        if not hexes:
            return
        if len(hexes) == 1:
            self.choose(hexes[0], self.node if hexes[0] == self.hex else None)
        self.visited.emit(hexes)
