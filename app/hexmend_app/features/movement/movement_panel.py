"""Panel of the displacement: reference state, colours, arrows and counts."""

from __future__ import annotations

import dataclasses
from typing import Any

from PySide6.QtCore import QSignalBlocker, Signal
from PySide6.QtWidgets import QAbstractSpinBox, QDoubleSpinBox, QGridLayout, QHBoxLayout, QLabel, QPushButton, QWidget

from hexmend_app.picture.appearance import Arrows, Since, Traces
from hexmend_app.picture.displacement import DISPLACEMENT_QUANTITIES, DisplacementCounts
from hexmend_app.scene.layers.arrows import MAX_ARROWS
from hexmend_app.theme.spacing import fill
from hexmend_app.theme.style import labelled, note, set_help, tabular
from hexmend_app.translation import tr
from hexmend_app.widgets.inputs.segmented import Segmented
from hexmend_app.widgets.wording import counted, figure, short_number

_SINCE = [
    (Since.OPENED.value, "File opened", "Compare with the mesh as it was opened."),
    (Since.RUN.value, "Run started", "Compare with the mesh at the start of the run."),
    (Since.ITERATION.value, "Last iteration", "Compare each iteration with the previous stored iteration."),
]
_COLOURS = [
    ("", "Quality", "Colour by the metric selected in the Colour panel."),
    (
        "moved-most",
        DISPLACEMENT_QUANTITIES["moved-most"].label,
        "Colour each hex by the largest displacement of its nodes.",
    ),
    (
        "q-change",
        DISPLACEMENT_QUANTITIES["q-change"].label,
        "Colour each hex by the increase (teal) or decrease (brown) of its quality; newly invalid and repaired hexes "
        "have separate colours.",
    ),
    (
        "surface-distance",
        DISPLACEMENT_QUANTITIES["surface-distance"].label,
        "Colour each hex by the distance of its boundary nodes from the reference surface, for a sliding boundary.",
    ),
]
_ARROWS = [
    (Arrows.NONE.value, "None", "No arrows."),
    (
        Arrows.SIGHT.value,
        "Visible",
        "Arrows at the nodes of visible faces, from the old to the new position; pale where they are hidden. Boundary "
        "nodes move only if they slide: cut or peel the mesh to see others.",
    ),
    (Arrows.ALL.value, "All shown", "Arrows at the nodes of all shown hexes, drawn through the faces before them."),
]
_FIGURES = {
    "Nodes": "Number of nodes that have moved.",
    "Distance": "Displacement of these nodes, in mean edge lengths of the mesh as it was opened.",
    "Hexes": "Hexes with a higher or lower q(H) than in the reference state.",
    "Invalid": "Hexes that became invalid since the reference state, and hexes that no longer are.",
}
_DRAWN = "Number and length of the arrows."
_FACTOR = "Scale factor of the arrows relative to the displacement."


class MovementPanel(QWidget):
    """Sets how a displacement is displayed, and shows its size.

    Signals
    -------
    traces_changed(Traces)
        The user changed the reference state or the arrows.
    """

    traces_changed = Signal(object)

    def __init__(self, parent: QWidget | None = None):
        super().__init__(parent)
        self._traces = Traces()
        self.since = Segmented(tr("Compare with"), _translated(_SINCE))
        self.colours = Segmented(tr("Colours of the movement"), _translated(_COLOURS))
        self.arrows = Segmented(tr("Arrows"), _translated(_ARROWS))
        self.factor = QDoubleSpinBox()
        self.factor.setRange(0.01, 100_000)
        self.factor.setDecimals(2)
        self.factor.setStepType(QAbstractSpinBox.StepType.AdaptiveDecimalStepType)
        self.factor.setPrefix("× ")
        self.factor.setKeyboardTracking(False)
        self.factor.setFont(tabular(self.factor.font()))
        set_help(self.factor, tr("Length of arrows"), tr(_FACTOR))
        self.show_newly = QPushButton(tr("Show newly invalid"))
        self._drawn = note()
        set_help(self._drawn, tr("Number of arrows"), tr(_DRAWN))
        self._figures = {name: _figure_label() for name in _FIGURES}
        self._lay_out()
        self.since.chosen.connect(lambda key: self._change(since=Since(key)))
        self.arrows.chosen.connect(lambda key: self._change(arrows=Arrows(key)))
        self.factor.valueChanged.connect(lambda value: self._change(factor=value))
        self.set_traces(self._traces)
        self.set_counts(None, "", 0)
        self.set_arrows(0, 0)

    def _lay_out(self) -> None:
        grid = QGridLayout(self)
        grid.setContentsMargins(0, 0, 0, 0)
        grid.setHorizontalSpacing(12)
        grid.setVerticalSpacing(4)
        grid.setColumnStretch(1, 1)
        lengths = fill(QHBoxLayout(), self.factor, (self._drawn, 1))
        rows = ((tr("Since"), self.since), (tr("Colours"), self.colours), (tr("Arrows"), self.arrows))
        for row, (text, buttons) in enumerate(rows):
            grid.addWidget(labelled(text, buttons), row, 0)
            grid.addWidget(buttons, row, 1)
        grid.addLayout(lengths, 3, 1)
        invalid = fill(QHBoxLayout(), (self._figures["Invalid"], 1), self.show_newly)
        for row, (text, label) in enumerate(self._figures.items(), start=4):
            grid.addWidget(QLabel(tr(text)), row, 0)
            set_help(label, tr(text), tr(_FIGURES[text]))
            if text == "Invalid":
                grid.addLayout(invalid, row, 1)
            else:
                grid.addWidget(label, row, 1)
        grid.setRowStretch(8, 1)

    # Display

    def set_traces(self, traces: Traces) -> None:
        """Show the reference state and the arrows, without emitting a signal."""
        self._traces = traces
        self.since.set_value(traces.since.value)
        self.arrows.set_value(traces.arrows.value)
        self.factor.setEnabled(traces.arrows is not Arrows.NONE)
        if self.factor.value() != traces.factor:
            with QSignalBlocker(self.factor):
                self.factor.setValue(traces.factor)

    def set_colours(self, name: str) -> None:
        """Show the quantity of the colours, a name of `DISPLACEMENT_QUANTITIES` or "", without emitting a signal."""
        self.colours.set_value("moved-most" if name == "moved-mean" else name)

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
        texts = (tr("No mesh is open."), "", "", "") if counts is None else _count_texts(counts, name, free)
        for label, text in zip(self._figures.values(), texts, strict=True):
            label.setText(text)

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


def _count_texts(counts: DisplacementCounts, name: str, free: int) -> tuple[str, str, str, str]:
    distance = (
        tr("mean {mean}, max {max}", mean=figure(counts.mean), max=figure(counts.largest)) if counts.moved else "–"
    )
    slid = tr(" and {count:,} boundary", count=counts.slid) if counts.slid else ""
    return (
        tr(
            "{moved:,} of {free:,} free{slid} nodes moved since {name}",
            moved=counts.moved - counts.slid,
            free=free,
            slid=slid,
            name=tr(name),
        ),
        distance,
        tr("{better:,} better, {worse:,} worse", better=counts.better, worse=counts.worse),
        tr(
            "{newly_invalid:,} newly invalid, {mended:,} repaired",
            newly_invalid=counts.newly_invalid,
            mended=counts.mended,
        ),
    )


def _figure_label() -> QLabel:
    label = note()
    label.setFont(tabular(label.font()))
    label.setWordWrap(False)
    return label


def _translated(options: list[tuple[str, str, str]]) -> list[tuple[str, str, str]]:
    return [(key, tr(text), tr(help)) for key, text, help in options]
