"""Hex inspector: the list of the worst hexes and the details of the selected hex."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path

from hexmend.boundary import NodeClass
from hexmend_app.feature import Action, Feature, Host, Panel, PanelPlace, StatePart
from hexmend_app.features.hex_inspector.hex_panel import HexPanel
from hexmend_app.features.hex_inspector.worst_list import WorstList, write_worst
from hexmend_app.state.mesh.inspection import describe_hex, describe_node
from hexmend_app.state.tasks.boundary_classifier import LEFT, WHISKER
from hexmend_app.translation import tr
from hexmend_app.widgets.dialogs.questions import ask_to_save
from hexmend_app.widgets.inputs.saved_values import saved_values
from hexmend_app.widgets.wording import counted

#: Descriptions of the classes of boundary nodes, which limit how a node slides.
_BOUNDARY_CLASSES = {
    NodeClass.CORNER: "a corner",
    NodeClass.CURVE: "on a curve",
    NodeClass.PATCH: "on a patch",
    WHISKER: "on a whisker",
}
_LEFT = {NodeClass.CORNER: "its corner", NodeClass.CURVE: "its curve", NodeClass.PATCH: "its patch"}


class FeatureHexInspector(Feature):
    """Selects hexes and nodes, and shows their details."""

    def __init__(self, host: Host):
        super().__init__(host)
        session = self.session
        selection = self._selection = session.selection
        self._document, self._view = session.document, session.view
        self.worst_list = WorstList()
        self.worst_list.chosen.connect(self._go_to_worst)
        self.worst_list.save_button.clicked.connect(self.ask)
        self.worst_list.metric_chosen.connect(selection.rank_by)
        selection.rank_by(self.worst_list.chosen_metric)
        panel = self.panel = HexPanel()
        panel.neighbours.followed.connect(selection.visit)
        panel.zoom_button.clicked.connect(lambda: selection.visit(selection.hex))
        panel.corners_box.toggled.connect(host.refresh_soon)
        panel.node_chosen.connect(lambda node: selection.choose(selection.hex, node))
        panel.pin_toggled.connect(session.commands.pin)

    def actions(self) -> Iterable[Action]:
        """Yield the actions that step through the list and act on the selection."""
        yield from self._list_actions()
        yield from self._selection_actions()

    def _list_actions(self) -> Iterable[Action]:
        yield Action(
            id="next_worst",
            text=tr("&Next worst hex"),
            menu="Hex",
            keys="N",
            icon="bullseye-arrow",
            help=tr("Go to the next hex in the list of the worst."),
            tool=tr("Worst"),
            handle=self.worst_list.next,
        )
        yield Action(
            id="previous_worst",
            text=tr("&Previous worst hex"),
            menu="Hex",
            keys="Shift+N",
            icon="chevron-up",
            help=tr("Go to the previous hex in the list of the worst."),
            handle=self.worst_list.previous,
        )

    def _selection_actions(self) -> Iterable[Action]:
        session = self.session
        yield Action(
            id="visit",
            text=tr("&Zoom to hex"),
            menu="Hex",
            keys="Shift+F",
            help=tr("Move the camera to the selected hex."),
            handle=lambda: self._selection.visit(self._selection.hex),
            enabled=lambda: self._selection.hex is not None,
            in_view=True,
        )
        yield Action(
            id="pin",
            text=tr("&Pin node"),
            menu="Hex",
            keys="Shift+P",
            icon="pin-outline",
            help=tr("Pin the selected node so that no method moves it, or unpin it; undo reverts this."),
            handle=lambda on: session.commands.pin(self._selection.node, on),
            enabled=lambda: session.editable and self._can_be_pinned(),
            checked=self._is_pinned,
            in_view=True,
        )
        yield Action(
            id="free_isolated",
            text=tr("Pin &all but the isolated hexes"),
            menu="Hex",
            icon="pin-off-outline",
            help=tr("Pin all nodes except those of the isolated hexes and the rings around them; undo reverts this."),
            handle=self._free_isolated,
            enabled=lambda: session.editable and self._view.look.show.isolate is not None,
        )
        yield Action(
            id="back",
            text=tr("&Show all or clear selection"),
            menu="Hex",
            section=3,
            keys="Esc",
            help=tr("End measuring or show all hexes; if neither applies, clear the selection."),
            handle=self._back,
            enabled=lambda: (
                not self.host.messages.takes_escape
                and not self.session.opener.busy
                and (self._selection.hex is not None or self._view.look.show.isolate is not None or self._measures)
            ),
        )

    def states(self) -> Iterable[StatePart]:
        """Yield the settings of the list of worst hexes, and of the labels of corners."""
        worst = self.worst_list
        yield saved_values("worst", metric=worst.metric_box, isolate=worst.isolate, corners=self.panel.corners_box)

    def panels(self) -> Iterable[Panel]:
        """Yield the list of the worst hexes and the panel of the selected hex."""
        yield Panel(
            id="worst",
            title=tr("Worst"),
            widget=self.worst_list,
            place=PanelPlace.DRAWER,
            order=1,
            help=tr("The worst hexes by any metric."),
        )
        yield Panel(
            id="hex",
            title=tr("Hex"),
            widget=self.panel,
            place=PanelPlace.DRAWER,
            order=2,
            help=tr("Details of the selected hex and its nodes."),
            scrolls=True,
        )

    def canvas_ready(self) -> None:
        """Connect to clicks in the view."""
        self.canvas.clicked.connect(self._on_clicked)

    def refresh(self) -> None:
        """Update the selection and the list of the worst hexes."""
        if not self._document.is_open:
            return
        now, selection = self._document.now, self._selection
        if self._seen.changed("figures", now):
            self.worst_list.set_quality(now.mesh, now.quality)
        self.worst_list.set_selected(selection.hex)
        corners, editable = self.panel.corners_box.isChecked(), self.session.editable
        classes = self.session.boundary_classifier.result
        if self._seen.changed("selection", now, selection.hex, selection.node, corners, editable, self.canvas, classes):
            self._show_selection()

    def _show_selection(self) -> None:
        selection, mesh = self._selection, self._document.now.mesh
        if selection.hex is None:
            self.panel.show_hex(None)
        else:
            tags = [name for name, members in mesh.hex_sets.items() if (members == selection.hex).any()]
            self.panel.show_hex(describe_hex(mesh, selection.hex), tags)
        node = None if selection.node is None else describe_node(mesh, selection.node)
        self.panel.show_node(node, not self.session.editable, self._boundary_class(selection.node))
        if self.canvas is not None:
            self.canvas.select(selection.hex, self.panel.corners_box.isChecked(), node)

    def _can_be_pinned(self) -> bool:
        node = self._selection.node
        return node is not None and bool(self._document.now.mesh.topology.used[node])

    def _is_pinned(self) -> bool:
        node, mesh = self._selection.node, self._document.now.mesh if self._document.is_open else None
        return node is not None and mesh is not None and mesh.pinned is not None and bool(mesh.pinned[node])

    def _boundary_class(self, node: int | None) -> str:
        """Describe the class of a boundary node; "" for other nodes and while the classes are unknown."""
        mesh = self._document.now.mesh
        classes = self.session.boundary_classifier.of(mesh)
        if node is None or classes is None:
            return ""
        if classes.kinds[node] == LEFT and classes.mesh.points is mesh.points:
            left = classes.departures
            return tr(
                "{distance} mean edge lengths from {place}",
                distance=f"{left.distance[node] / left.edge_length:.2g}",
                place=tr(_LEFT[left.node_class[node]]),
            )
        return tr(_BOUNDARY_CLASSES.get(int(classes.original_kinds[node]), ""))

    def _on_clicked(self, hit: tuple[int, int] | None) -> None:
        self._selection.choose(*(hit or (None, None)))
        if hit is not None and not self.host.is_visible("node"):  # that panel shows the selection as well
            self.host.raise_if_open("hex")

    def _go_to_worst(self, h: int) -> None:
        if self.worst_list.isolate.isChecked():
            self._view.isolate((h,))
        self._selection.visit(h)
        self.worst_list.set_selected(h)  # before the refresh: the next step through the list begins at this hex

    def _free_isolated(self) -> None:
        isolation = self._view.look.show.isolate
        self.session.commands.free_only(isolation.hexes, isolation.rings)

    @property
    def _measures(self) -> bool:
        return self._view.measuring or bool(self._view.look.measurement.points)

    def _back(self) -> None:
        """End measuring, else the isolation; clear the selection if nothing is isolated."""
        if self._measures:
            self._view.end_measuring()
        elif self._view.look.show.isolate is not None:
            self._view.end_isolation()
        else:
            self._selection.choose(None)

    # Files

    def ask(self) -> None:
        """Ask for a file and write the list of the worst hexes to it."""
        name = f"{self.host.default_file_stem}-worst.csv"
        if path := ask_to_save(self.host.dialog_parent, tr("Save list as"), name, tr("Table (*.csv)")):
            self.save(path)

    def save(self, path: str | Path) -> bool:
        """Write the list of the worst hexes as CSV; return True if it was written."""
        subject, metric = (
            tr("List of {count}", count=counted(len(self.worst_list.hexes), "hex")),
            self.worst_list.chosen_metric,
        )
        return self.write_file(subject, path, lambda at: write_worst(at, self._document.now.mesh, metric))
