"""Layers of the mesh structure: irregular and sharp edges; fixed, free and locked nodes."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np
from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import QCheckBox, QGridLayout, QHBoxLayout, QVBoxLayout, QWidget

from hexmend.boundary import NodeClass
from hexmend.boundary.feature_edges.features import FEATURE_ANGLE
from hexmend_app.feature import Action, Feature, Host, Panel, PanelPlace
from hexmend_app.picture.appearance import Structure
from hexmend_app.picture.layer_switch import EDGE_LAYERS, ordered_layers
from hexmend_app.scene.layers.optional.structure import (
    BOUNDARY,
    FREE,
    IRREGULAR_NODE,
    KINDS,
    LOCKED,
    OTHER,
    PINNED,
    SHARP,
    VALENCES,
)  # fmt: skip
from hexmend_app.state.mesh.structure import MeshStructure
from hexmend_app.state.tasks.boundary_classifier import LEFT, PIN, WHISKER, BoundaryClasses
from hexmend_app.theme.palette import MUTED, RIM, Role
from hexmend_app.theme.spacing import clear, fill
from hexmend_app.theme.style import set_help, smaller, tabular, tint
from hexmend_app.translation import tr
from hexmend_app.widgets.eliding_label import ElidingLabel
from hexmend_app.widgets.legend import Swatch
from hexmend_app.widgets.wording import counted

#: Texts of the classes of boundary nodes.
_KIND_TEXT = {
    NodeClass.CORNER: "corners", NodeClass.CURVE: "on curves", NodeClass.PATCH: "on patches",
    WHISKER: "on whiskers", PIN: "pinned", LEFT: "moved off",
}  # fmt: skip
#: Legend entry: colour (None without a mark), True for a line, and text.
Entry = tuple[str | Role | None, bool, str]


class FeatureStructure(Feature):
    """Shows and hides the layers of the mesh structure, with counts."""

    def __init__(self, host: Host):
        super().__init__(host)
        self._view = self.session.view
        self.panel = StructurePanel()
        self.panel.structure_changed.connect(lambda structure: self._view.change(structure=structure))

    def actions(self) -> Iterable[Action]:
        """Yield an action for each layer."""
        for layer in ordered_layers():
            yield Action(
                id=f"show_{layer.name}",
                text=tr(layer.action or layer.title),
                menu="View/Show",
                keys=layer.keys,
                help=tr(layer.action_help or layer.help),
                handle=lambda on, name=layer.name: self._switch(name, on),
                enabled=lambda name=layer.name: self.panel.offered()[name],
                checked=lambda name=layer.name: self._view.look.structure.is_on(name),
            )

    def panels(self) -> Iterable[Panel]:
        """Yield the panel with the layers and their legends."""
        yield Panel(
            id="show",
            title=tr("Show"),
            widget=self.panel,
            place=PanelPlace.TOOLS,
            tab=tr("Look"),
            order=21,
            help=tr("Edges, nodes and surfaces that are drawn over the mesh."),
        )

    def refresh(self) -> None:
        """Update check boxes, legends and counts."""
        session = self.session
        self.panel.setEnabled(session.document.is_open)
        self.panel.set_structure(self._view.look.structure)
        if not session.document.is_open:
            return
        self._classify_boundary()
        if self._seen.changed("found", session.structure_finder.result, session.document.start):
            self.panel.set_found(session.structure_finder.result)
        now = session.document.now
        of_mesh = now.mesh.cells, now.mesh.materials, now.mesh.target, now.mesh.mid_nodes
        if self._seen.changed("legends", session.document.start, *of_mesh):
            for layer in ordered_layers():
                if layer.drawn_by is not None:
                    self.panel.set_legend(layer.name, layer.drawn_by.legend(now.mesh))  # type: ignore[attr-defined]
            self.panel.set_curved(now.mesh.mid_nodes)
        summary = now.summary
        counted = now.mesh.pinned, summary.free_nodes, summary.locked_inverted
        if self._seen.changed("counts", session.document.start, *counted):
            mesh, boundary = now.mesh, now.mesh.topology.boundary
            pinned = 0 if mesh.pinned is None else int(np.sum(mesh.pinned & mesh.topology.used & ~boundary))
            interfaces = mesh.interfaces
            between = 0 if interfaces is None else int(np.sum(interfaces.interface_nodes & ~boundary))
            counts = int(np.sum(boundary)), pinned, summary.free_nodes, summary.locked_inverted
            self.panel.set_nodes(*counts, between)

    def _classify_boundary(self) -> None:
        """Classify the boundary nodes for the next run if the result is visible."""
        session = self.session
        now, smoother = session.document.now, session.run_setup.smoother
        visible = self.panel.isVisible() or self._view.look.structure.is_on("kinds")
        if visible and smoother is not None and not session.run.busy:
            session.boundary_classifier.ask(
                now.mesh, now.quality, smoother.values().get("feature_angle", FEATURE_ANGLE)
            )
        classes = session.boundary_classifier.of(now.mesh)
        error = session.boundary_classifier.error
        if self._seen.changed("classes", classes, error, session.document.start):
            self.panel.set_classes(classes, error)

    def _switch(self, layer: str, on: bool) -> None:
        self._view.change(structure=self._view.look.structure.switched(layer, on))


class StructurePanel(QWidget):
    """Panel that shows and hides the layers of the mesh structure, with counts.

    Attributes
    ----------
    layers : dict of str to LayerRow
        Rows of the layers, by their names in `LAYERS`.

    Signals
    -------
    structure_changed(Structure)
        The user has shown or hidden a layer.
    """

    structure_changed = Signal(object)

    def __init__(self, parent: QWidget | None = None):
        super().__init__(parent)
        self._structure = Structure()
        self._locked = 0
        self._classes: BoundaryClasses | None = None
        self.layers = {
            switch.name: LayerRow(tr(switch.title), tr(switch.help), tr(switch.empty), switch.hidden_when_empty)
            for switch in ordered_layers()
        }
        grid = QGridLayout(self)
        grid.setContentsMargins(0, 0, 0, 0)
        grid.setHorizontalSpacing(8)
        grid.setVerticalSpacing(4)
        grid.setColumnStretch(1, 1)
        for row, (name, layer) in enumerate(self.layers.items()):
            grid.addWidget(layer.box, row, 0, Qt.AlignmentFlag.AlignTop)
            grid.addWidget(layer.entries, row, 1)
            layer.box.clicked.connect(lambda on, name=name: self._switch(name, on))
        self.set_structure(self._structure)

    def offered(self) -> dict[str, bool]:
        """Return for each layer whether it can be switched on or off."""
        return {name: layer.box.isEnabled() for name, layer in self.layers.items()}

    def set_structure(self, structure: Structure) -> None:
        """Show which layers are on, without sending a signal."""
        self._structure = structure
        for name, layer in self.layers.items():
            layer.set_on(structure.is_on(name))

    def set_found(self, found: MeshStructure | None) -> None:
        """Show the counts of edges; None while they are being found."""
        if found is None:
            for name in EDGE_LAYERS:
                self.layers[name].set_entries(None)
            return
        nodes: list[Entry] = []
        if len(found.nodes):
            nodes = [(IRREGULAR_NODE, False, counted(len(found.nodes), "node"))]
        self.layers["irregular"].set_entries(_by_valence(found.interior_valence) + nodes)
        self.layers["boundary"].set_entries(_by_valence(found.boundary_valence))
        self.layers["sharp"].set_entries([(SHARP, True, f"{len(found.sharp):,}")] if len(found.sharp) else [])

    def set_nodes(self, boundary: int, pinned: int, free: int, locked: int, between: int = 0) -> None:
        """Show the numbers of boundary, pinned and free nodes, of locked hexes, and of nodes between materials."""
        self._locked = locked
        fixed: list[Entry] = [(BOUNDARY, False, tr("{count:,} boundary", count=boundary))] if boundary else []
        if between:
            fixed.append((BOUNDARY, False, tr("{count:,} between materials", count=between)))
        if pinned:
            fixed.append((PINNED, False, tr("{count:,} pinned", count=pinned)))
        self.layers["fixed"].set_entries(fixed)
        self.layers["free"].set_entries([(FREE, False, f"{free:,}")] if free else [])
        self._show_locked()

    def set_legend(self, name: str, entries: list[Entry]) -> None:
        """Show the entries of an optional layer, by its name."""
        self.layers[name].set_entries([(look, line, tr(text)) for look, line, text in entries])

    def set_curved(self, mid_nodes: np.ndarray | None) -> None:
        """Show the number of hexes with mid-nodes, (m, 19) int32; None if the mesh has none."""
        count = 0 if mid_nodes is None else int((mid_nodes >= 0).any(axis=1).sum())
        self.layers["curved"].set_entries([(None, False, counted(count, "hex"))] if count else [])

    def set_classes(self, classes: BoundaryClasses | None, error: BaseException | None = None) -> None:
        """Show the classes of boundary nodes; None while they are being found, with the error if that failed."""
        self._classes = classes
        entries: list[Entry] | None = None
        if classes is not None:
            counts = {kind: classes.count(kind) for kind in _KIND_TEXT}
            entries = [
                (KINDS[kind], False, f"{count:,} {tr(_KIND_TEXT[kind])}") for kind, count in counts.items() if count
            ]
            if classes.departures is not None and counts[LEFT]:
                entries.append((None, False, tr("up to {most:.2g} edge lengths", most=classes.departures.max)))
        self.layers["kinds"].set_entries(entries, error)
        self._show_locked()

    def _show_locked(self) -> None:
        """Show the number of locked hexes and, once known, how many of them sliding frees."""
        locked, classes = self._locked, self._classes
        entries: list[Entry] = [(LOCKED, False, tr("of {hexes}", hexes=counted(locked, "hex")))] if locked else []
        if locked and classes is not None and classes.locked == locked:
            entries.append((None, False, tr("{freed:,} freed by sliding", freed=classes.freed)))
        self.layers["locked"].set_entries(entries)

    def _switch(self, name: str, on: bool) -> None:
        self._structure = self._structure.switched(name, on)
        self.layers[name].set_on(on)
        self.structure_changed.emit(self._structure)


def _by_valence(valence: np.ndarray) -> list[Entry]:
    """Return the counts of edges by valence; valences without a colour are merged."""
    numbers, counts = np.unique(valence, return_counts=True)
    pairs = list(zip(numbers, counts, strict=True))
    entries: list[Entry] = [
        (VALENCES[n], True, tr("{count:,} of {hexes}", count=count, hexes=n)) for n, count in pairs if n in VALENCES
    ]
    rest = [(n, count) for n, count in pairs if n not in VALENCES]
    if len(rest) == 1:
        entries.append((OTHER, True, tr("{count:,} of {hexes}", count=rest[0][1], hexes=rest[0][0])))
    elif rest:
        entries.append((OTHER, True, tr("{count:,} others", count=sum(count for _, count in rest))))
    return entries


class LayerRow:
    """Check box and legend of a layer.

    Parameters
    ----------
    name, help : str
        Text of the check box, and its tooltip.
    reason : str
        Tooltip if the layer is empty.
    hidden_when_empty : bool
        True if the row is hidden while the layer is empty.

    Attributes
    ----------
    box : QCheckBox
    entries : QWidget
    """

    def __init__(self, name: str, help: str, reason: str, hidden_when_empty: bool = False):
        self._name, self._help, self._reason = name, help, reason
        self._hidden_when_empty = hidden_when_empty
        self._entries: list[Entry] | None = []
        self._error: BaseException | None = None
        self.box = QCheckBox(name)
        self.entries = QWidget()
        self._lines = fill(QVBoxLayout(self.entries), margins=(0, 4, 0, 0), spacing=4)

    def set_on(self, on: bool) -> None:
        """Check or uncheck the box."""
        self.box.setChecked(on)
        self._enable()

    def set_entries(self, entries: list[Entry] | None, error: BaseException | None = None) -> None:
        """Show the legend; None while it is unknown, with the error if finding it failed."""
        self._entries, self._error = entries, error
        clear(self._lines)
        text = tr("failed") if error is not None else tr("counting…") if entries is None else tr("none")
        for entry in entries or [(None, False, text)]:
            self._lines.addWidget(_entry(*entry))
        self._enable()

    def _enable(self) -> None:
        # A layer that is on before its contents are known is drawn once they are.
        offered = bool(self._entries) or (self._entries is None and self._error is None)
        # A layer that is on can be switched off.
        self.box.setEnabled(offered or (self.box.isChecked() and not self._hidden_when_empty))
        if self._hidden_when_empty:
            self.box.setVisible(offered)
            self.entries.setVisible(offered)
        reason = self._reason
        if self._error is not None:
            reason = tr("Not counted: {error}.", error=str(self._error).rstrip("."))
        set_help(self.box, self._name, self._help if offered else reason)


def _entry(colour: str | Role | None, line: bool, text: str) -> QWidget:
    entry, label = QWidget(), ElidingLabel(text)
    label.setFont(tabular(smaller(label.font())))
    label.setToolTip(text)
    tint(label, MUTED)
    marks = [] if colour is None else [Swatch(colour, *((11, 7) if line else (9, 9)), rim=RIM)]
    fill(QHBoxLayout(entry), *marks, (label, 1), margins=(0, 0, 0, 0), spacing=4)
    return entry
