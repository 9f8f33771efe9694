"""Curves that are marked by hand: chains of boundary edges that stay features when the boundary slides."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from hexmend.boundary.marking import marked_segments
from hexmend.errors import HexmendError
from hexmend.mesh.mesh import Mesh
from hexmend_app.feature import Action, Feature, Host
from hexmend_app.features.curves.edge_path import curve_through, edge_path
from hexmend_app.translation import tr
from hexmend_app.widgets.wording import counted


class FeatureCurves(Feature):
    """Marks and unmarks curves between nodes of the boundary that the user selects."""

    def __init__(self, host: Host):
        super().__init__(host)
        self._start: int | None = None  # first node of the next curve
        self._segments: tuple[object, np.ndarray] = (None, np.empty((0, 2), np.int64))  # of these cells
        self.session.document.mesh_replaced.connect(self._forget_start)

    def actions(self) -> Iterable[Action]:
        """Yield the actions that mark and unmark curves."""
        yield Action(
            id="mark_curve",
            text=tr("&Mark curve"),
            menu="Hex",
            section=1,
            keys="Shift+E",
            icon="vector-polyline",
            help=tr("Mark the boundary edges between two selected nodes as a curve, which sliding keeps."),
            handle=self.mark,
            enabled=lambda: self.session.editable and self._on_boundary,
            title=self._title,
            in_view=True,
        )
        yield Action(
            id="unmark_curve",
            text=tr("&Unmark curve"),
            menu="Hex",
            section=1,
            help=tr("Remove the marks of the curve through the selected node; undo reverts this."),
            handle=self.unmark,
            enabled=lambda: self.session.editable and self._is_marked,
            in_view=True,
        )
        yield Action(
            id="unmark_all_curves",
            text=tr("Unmark all curves"),
            menu="Hex",
            section=1,
            help=tr("Remove the marks of all curves; undo reverts this."),
            handle=lambda: self.session.commands.unmark_curves(),
            enabled=lambda: self.session.editable and len(self._marked) > 0,
        )

    def mark(self) -> None:
        """Begin a curve at the selected node, or mark the edges from its begin to there; at its begin, cancel it."""
        node, start = self.session.selection.node, self._start
        messages = self.host.messages
        if start is None:
            self._start = node
            messages.show_info(tr("The curve starts at node {node}: select its other end, then Mark curve.", node=node))
            return
        self._start = None
        if node == start:
            messages.show_info(tr("No curve is marked."))
            return
        mesh = self._mesh
        try:
            chain = edge_path(mesh, start, node)
        except HexmendError as error:
            messages.show_error(tr("No curve marked"), str(error))
            return
        self.session.commands.mark_curve(chain)
        view = self.session.view
        view.change(structure=view.look.structure.switched("kinds", True))
        messages.show_info(tr("A curve of {edges} is marked.", edges=counted(len(chain) - 1, "edge")))

    def unmark(self) -> None:
        """Remove the marks of the curve through the selected node."""
        self.session.commands.unmark_curves(curve_through(self._mesh, self.session.selection.node))

    @property
    def _mesh(self) -> Mesh:
        return self.session.document.now.mesh

    @property
    def _on_boundary(self) -> bool:
        node = self.session.selection.node
        return node is not None and bool(self._mesh.topology.boundary[node])

    @property
    def _marked(self) -> np.ndarray:
        """Marked edges of the open mesh, (e, 2)."""
        cells = self._mesh.cells
        if self._segments[0] is not cells:
            self._segments = cells, marked_segments(self._mesh)
        return self._segments[1]

    @property
    def _is_marked(self) -> bool:
        node = self.session.selection.node
        return node is not None and bool((self._marked == node).any())

    def _title(self) -> str:
        if self._start is None:
            return tr("&Mark curve from this node")
        if self._start == self.session.selection.node:
            return tr("Do not &mark a curve")
        return tr("&Mark curve from node {start} to this one", start=self._start)

    def _forget_start(self) -> None:
        self._start = None
