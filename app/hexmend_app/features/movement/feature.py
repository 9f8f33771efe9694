"""Displacement of the mesh since a reference: arrows and counts."""

from __future__ import annotations

import dataclasses
from collections.abc import Iterable
from typing import Any

from PySide6.QtCore import QSignalBlocker, Signal
from PySide6.QtWidgets import QAbstractSpinBox, QDoubleSpinBox, QPushButton, QWidget

from hexmend_app.feature import Feature, Host, Panel, PanelPlace
from hexmend_app.picture.appearance import Arrows, Since, Traces
from hexmend_app.picture.displacement import Displacement, DisplacementCounts
from hexmend_app.scene.layers.arrows import MAX_ARROWS
from hexmend_app.state.mesh.hex_groups import hexes_of_group
from hexmend_app.theme.style import set_help, small_label, tabular
from hexmend_app.translation import tr
from hexmend_app.widgets.form import form_layout
from hexmend_app.widgets.inputs.combo import ComboBox, let_shrink
from hexmend_app.widgets.wording import counted, figure, short_number

_SINCE = (
    (Since.OPENED, "file opened", "Compare with the mesh as it was opened."),
    (Since.RUN, "run started", "Compare with the mesh at the start of the run."),
    (Since.ITERATION, "last iteration", "Compare each iteration with the previous stored iteration."),
)
_ARROWS = (
    (Arrows.NONE, "none", "No arrows."),
    (
        Arrows.SIGHT,
        "at visible faces",
        "Arrows at the nodes of visible faces, from the old to the new position; pale where they are hidden. Boundary "
        "nodes move only if they slide: cut or peel the mesh to see others.",
    ),
    (Arrows.ALL, "at all shown hexes", "Arrows at the nodes of all shown hexes, drawn through the faces before them."),
)
_SINCE_HELP = (
    "State with which the displacement compares the mesh: in the colours Distance moved, Change of q(H) and Distance "
    "from the surface, in the arrows, and in the counts below."
)
_FACTOR = "Scale factor of the arrows relative to the displacement."


class FeatureMovement(Feature):
    """Shows the displacement of the nodes since a reference state."""

    def __init__(self, host: Host):
        super().__init__(host)
        self._document, view = self.session.document, self.session.view
        self._view = view
        panel = self.panel = MovementPanel()
        panel.traces_changed.connect(lambda traces: view.change(movement=traces))
        panel.show_newly.clicked.connect(self._show_newly_invalid)

    def panels(self) -> Iterable[Panel]:
        """Yield the panel of the displacement."""
        yield Panel(
            id="movement",
            title=tr("Movement"),
            widget=self.panel,
            place=PanelPlace.TOOLS,
            tab=tr("Look"),
            order=22,
            help=tr("Displacement of the nodes and change of quality since a reference state."),
        )

    def refresh(self) -> None:
        """Show the settings of the view, the counts of moved nodes and the number of arrows."""
        self.panel.setEnabled(self._document.is_open)
        self.panel.set_traces(self._view.look.movement)
        if not (self.panel.isVisible() and self._document.is_open):
            return
        displacement = self._displacement
        if self._seen.changed("counts", displacement):
            name = displacement.before.name
            self.panel.set_counts(displacement.counts, name, self._document.now.summary.free_nodes)
        if self.canvas is not None:
            layer = self.canvas.viewport.overlay_layers.arrows
            self.panel.set_arrows(layer.drawn, layer.moved)

    @property
    def _displacement(self) -> Displacement:
        return self.session.comparison_bases.displacement(self._view.look.movement.since)

    def _show_newly_invalid(self) -> None:
        now = self._document.now
        self._view.isolate(hexes_of_group("newly invalid", now.mesh, now.quality, self._displacement))


class MovementPanel(QWidget):
    """Sets how a displacement is displayed, and shows its size.

    Attributes
    ----------
    since, arrows : ComboBox
    factor : QDoubleSpinBox
    show_newly : QPushButton

    Signals
    -------
    traces_changed(Traces)
        The user changed the reference state or the arrows.
    """

    traces_changed = Signal(object)

    def __init__(self, parent: QWidget | None = None):
        super().__init__(parent)
        self._traces = Traces()
        self.since, self.arrows = _box(_SINCE), _box(_ARROWS)
        set_help(self.since, tr("Since"), tr(_SINCE_HELP))
        set_help(self.arrows, tr("Arrows"), tr("Arrows from the old to the new positions of nodes."))
        self.factor = QDoubleSpinBox()
        self.factor.setRange(0.01, 100_000)
        self.factor.setDecimals(2)
        self.factor.setStepType(QAbstractSpinBox.StepType.AdaptiveDecimalStepType)
        self.factor.setPrefix("× ")
        self.factor.setKeyboardTracking(False)
        self.factor.setFont(tabular(self.factor.font()))
        set_help(self.factor, tr("Length of arrows"), tr(_FACTOR))
        self.show_newly = QPushButton(tr("Show newly invalid"))
        self._drawn, self._counts = small_label(), small_label()
        self._drawn.setAccessibleName(tr("Number of arrows"))
        self._counts.setAccessibleName(tr("Counts of the movement"))
        form = form_layout(self)
        form.addRow(tr("Since"), self.since)
        form.addRow(tr("Arrows"), self.arrows)
        form.addRow(tr("Length"), self.factor)
        for widget in (self._drawn, self._counts, self.show_newly):
            form.addRow(widget)
        self.since.activated.connect(lambda: self._change(since=Since(self.since.currentData())))
        self.arrows.activated.connect(lambda: self._change(arrows=Arrows(self.arrows.currentData())))
        self.factor.valueChanged.connect(lambda value: self._change(factor=value))
        self.set_traces(self._traces)
        self.set_counts(None, "", 0)
        self.set_arrows(0, 0)

    def set_traces(self, traces: Traces) -> None:
        """Show the reference state and the arrows, without emitting a signal."""
        self._traces = traces
        self.since.setCurrentIndex(self.since.findData(traces.since.value))
        self.arrows.setCurrentIndex(self.arrows.findData(traces.arrows.value))
        self.factor.setEnabled(traces.arrows is not Arrows.NONE)
        if self.factor.value() != traces.factor:
            with QSignalBlocker(self.factor):
                self.factor.setValue(traces.factor)

    def set_arrows(self, drawn: int, moved: int) -> None:
        """Show the number of arrows that are drawn, of `moved` nodes."""
        self._drawn.setText(arrows_in_words(self._traces, drawn, moved))

    def set_counts(self, counts: DisplacementCounts | None, name: str, free: int) -> None:
        """Show the size of the displacement.

        Parameters
        ----------
        counts : DisplacementCounts or None
            None if no mesh is open.
        name : str
            Name of the reference state.
        free : int
            Number of free nodes.
        """
        enabled = counts is not None and counts.newly_invalid > 0
        self.show_newly.setEnabled(enabled)
        help = tr("Show only the hexes that became invalid since the reference state; Esc shows all hexes again.")
        set_help(self.show_newly, tr("Show newly invalid"), help if enabled else tr("No hex is newly invalid."))
        self._counts.setText(tr("No mesh is open.") if counts is None else counts_in_words(counts, name, free))

    def _change(self, **fields: Any) -> None:
        traces = dataclasses.replace(self._traces, **fields)
        if traces != self._traces:
            self.set_traces(traces)
            self.traces_changed.emit(traces)


def arrows_in_words(traces: Traces, drawn: int, moved: int) -> str:
    """Describe the number and length of the arrows.

    >>> arrows_in_words(Traces(arrows=Arrows.ALL, factor=10), 5000, 28899)
    'The 5,000 longest of 28,899 arrows, 10 × true length.'
    >>> arrows_in_words(Traces(arrows=Arrows.ALL), 1, 1)
    '1 arrow, true length.'
    """
    if traces.arrows is Arrows.NONE:
        return tr("At most the {max_arrows:,} longest arrows are drawn.", max_arrows=MAX_ARROWS)
    if not drawn:
        return tr("No visible node has moved.") if traces.arrows is Arrows.SIGHT else tr("No shown node has moved.")
    number = (
        tr("The {drawn:,} longest of {moved:,} arrows", drawn=drawn, moved=moved)
        if drawn < moved
        else counted(drawn, "arrow")
    )
    factor = "" if traces.factor == 1 else f"{short_number(traces.factor)} × "
    return tr("{number}, {factor}true length.", number=number, factor=factor)


def counts_in_words(counts: DisplacementCounts, name: str, free: int) -> str:
    """Describe the nodes that have moved since a reference state, and the hexes whose quality has changed."""
    slid = tr(" and {count:,} boundary", count=counts.slid) if counts.slid else ""
    values = {"moved": counts.moved - counts.slid, "free": free, "slid": slid, "name": tr(name)}
    sentences = [tr("{moved:,} of {free:,} free{slid} nodes moved since {name}.", **values)]
    if counts.moved:
        lengths = {"mean": figure(counts.mean), "most": figure(counts.largest)}
        sentences.append(tr("Mean {mean}, at most {most} mean edge lengths.", **lengths))
    sentences.append(tr("{better:,} hexes better, {worse:,} worse.", better=counts.better, worse=counts.worse))
    changes = {"newly": counts.newly_invalid, "repaired": counts.mended}
    sentences.append(tr("{newly:,} newly invalid, {repaired:,} repaired.", **changes))
    return "\n".join(sentences)


def _box(options: tuple[tuple[Any, str, str], ...]) -> ComboBox:
    """Return a combo box of values with texts and tooltips."""
    box = ComboBox()
    let_shrink(box, 8)
    for value, text, help in options:
        box.add(tr(text), tr(help), value.value)
    return box
