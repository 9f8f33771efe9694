"""The selected hex and node, and the worst hexes of a mesh."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from PySide6.QtCore import QObject, Signal

from hexmend.mesh.mesh import Mesh
from hexmend.mesh.solid_cells import SOLID_KINDS, kinds_of
from hexmend.quality import METRICS, ElementQuality, locked_hexes, rank_worst
from hexmend.quality.file_ids import hex_ids
from hexmend_app.state.mesh.document import Document
from hexmend_app.state.mesh.metric_cache import metric_values

#: Maximum number of hexes in the list, which is rebuilt at every iteration.
MAX_LISTED = 1000


@dataclass(frozen=True, eq=False)
class WorstHexes:
    """The worst hexes by a metric, worst first.

    Parameters
    ----------
    hexes : (k,) int64
        Numbers of the hexes.
    values, jacobians : (k,) float64
        Values of the metric, and scaled Jacobians.
    states : list of str
        "locked" if fixed nodes alone keep the hex inverted, "inverted" for other inverted hexes, "inside" for hexes
        that are invalid inside, else "".
    ids : (k,) int, optional
        Numbers of the hexes in the file; None if that counts from 0 too, or has none.
    kinds : list of str, optional
        Kinds of the cells by name; None if all cells of the mesh are hexes.
    """

    hexes: np.ndarray
    values: np.ndarray
    jacobians: np.ndarray
    states: list[str]
    ids: np.ndarray | None = None
    kinds: list[str] | None = None

    @classmethod
    def of(cls, mesh: Mesh, quality: ElementQuality, metric: str) -> WorstHexes:
        """Find the worst hexes of a mesh by the metric with this name in `METRICS`; valid ones without a value last."""
        values = metric_values(metric, mesh, quality)
        better = METRICS[metric].better or 1
        ranked = np.where(np.isnan(values) & ~quality.invalid, better * np.inf, values)
        worst = rank_worst(ranked, quality, min(MAX_LISTED, values.size), better)
        inverted = quality.inverted[worst]
        locked = locked_hexes(mesh.points, mesh.elements[worst], mesh.fixed, inverted)
        states = np.select([locked, inverted, quality.invalid[worst]], ["locked", "inverted", "inside"], "").tolist()
        ids = hex_ids(mesh)
        of_file = None if ids is None else ids[worst]
        kinds = [SOLID_KINDS[kind].name for kind in kinds_of(mesh.elements[worst])]
        named = kinds if mesh.n_elements > mesh.n_hexes else None
        return cls(worst, values[worst], quality.scaled_jacobian[worst], states, of_file, named)


@dataclass(frozen=True)
class SelectionData:
    """Data of the selection in a session file."""

    hex: int | None
    node: int | None

    def check(self, hexes: int, nodes: int) -> None:
        """Raise `ValueError` if a mesh with these numbers of hexes and nodes does not have the selected ones."""
        if not (0 <= (self.hex or 0) < hexes and 0 <= (self.node or 0) < nodes):
            raise ValueError(f"hex {self.hex} or node {self.node} is selected, which the mesh does not have")


class Selection(QObject):
    """The selected hex of the open mesh, and the selected one of its nodes.

    Numbers that the open mesh does not have select nothing: a list may still show the previous mesh.

    Parameters
    ----------
    document : Document

    Signals
    -------
    changed
    visited(hexes)
        The camera should show some hexes; a tuple of int.

    Attributes
    ----------
    hex, node : int or None
    worst_metric : str
        Metric by which the worst hexes are ranked.
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
        """Select a hex and a node, or none; emit `changed` if the selection differs."""
        if not self._document.has_hex(hex):
            hex = node = None
        document = self._document
        if node is None or not document.is_open or not 0 <= node < document.now.mesh.n_nodes:
            node = None
        if (hex, node) != (self.hex, self.node):
            self.hex, self.node = hex, node
            self.changed.emit()

    def rank_by(self, metric: str) -> None:
        """Set the metric by which the worst hexes are ranked."""
        self.worst_metric = metric

    def worst_hexes(self) -> np.ndarray:
        """Return the worst hexes of the mesh shown, (k,) int64, worst first; a mesh is open."""
        now = self._document.now
        return WorstHexes.of(now.mesh, now.quality, self.worst_metric).hexes

    def to_data(self) -> SelectionData:
        """Return the data for a session file."""
        return SelectionData(self.hex, self.node)

    def restore(self, data: SelectionData) -> None:
        """Restore the selection of a session file."""
        self.choose(data.hex, data.node)

    def visit(self, *hexes: int) -> None:
        """Let the camera show some hexes; a single hex is selected too."""
        hexes = tuple(int(h) for h in hexes if self._document.has_hex(h))
        if not hexes:
            return
        if len(hexes) == 1:
            self.choose(hexes[0], self.node if hexes[0] == self.hex else None)
        self.visited.emit(hexes)
