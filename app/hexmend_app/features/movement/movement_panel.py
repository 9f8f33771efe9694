"""Panel of the displacement: reference state, colours, arrows and counts."""

from __future__ import annotations

import dataclasses

from PySide6.QtCore import QSignalBlocker, Signal
from PySide6.QtWidgets import QAbstractSpinBox, QDoubleSpinBox, QGridLayout, QHBoxLayout, QLabel, QPushButton, QWidget

from hexmend.boundary.displacement import DISPLACEMENT_QUANTITIES, DisplacementCounts
from hexmend_app.picture.appearance import Arrows, Since, Traces
from hexmend_app.scene.layers.arrows import MOST
from hexmend_app.theme.style import note, set_help, tabular
from hexmend_app.widgets.inputs.segmented import Segmented
from hexmend_app.widgets.wording import counted, figure, short_number

_SINCE = [
    (Since.OPENED.value, "Opening", "Compare with the mesh as it was opened."),
    (Since.RUN.value, "Run", "Compare with the mesh as the run began of which an iteration is shown."),
    (
        Since.ITERATION.value,
        "Iteration",
        "Compare each iteration with the one before it, or with the nearest before it that is kept.",
    ),
]
_COLOURS = [
    ("", "Quality", "Colour by the metric chosen in the Look panel."),
    (
        "moved-most",
        DISPLACEMENT_QUANTITIES["moved-most"].label,
        "Colour each hex by the largest displacement of its nodes.",
    ),
    (
        "q-change",
        DISPLACEMENT_QUANTITIES["q-change"].label,
        "Colour each hex by how much its quality has risen (teal) or fallen (brown); newly inverted and mended "
        "hexes have colours of their own.",
    ),
    (
        "surface-distance",
        DISPLACEMENT_QUANTITIES["surface-distance"].label,
        "Colour each hex by how far its boundary nodes are from the surface as it was: where the boundary slides.",
    ),
]
_ARROWS = [
    (Arrows.NONE.value, "None", "No arrows."),
    (
        Arrows.SIGHT.value,
        "In sight",
        "An arrow from where a node was to where it is, for nodes of the faces in sight. Boundary nodes stay "
        "unless they slide: cut or peel the mesh. Pale where something is before it.",
    ),
    (Arrows.ALL.value, "All shown", "Arrows of all hexes that are shown, through whatever is before them."),
]
_FIGURES = {
    "Nodes": "Number of nodes that have moved.",
    "Distance": "How far these are from where they were, in mean edge lengths of the mesh as it was opened.",
    "Hexes": "Hexes whose q(H) is higher or lower than it was.",
    "Inverted": "Hexes that were not inverted and are, and that were and no longer are.",
}
_DRAWN = "Number and length of the arrows."
_FACTOR = "Scale factor of the arrows relative to the displacement."


class MovementPanel(QWidget):
    """Selects how a displacement is shown, and shows its size.

    Signals
    -------
    traces_changed(Traces)
    colours_chosen(name)
        Of `DISPLACEMENT_QUANTITIES`, or "" for a metric.
    newly_inverted_requested
        The user wants to see them.
    """

    traces_changed = Signal(object)
    colours_chosen = Signal(str)
    newly_inverted_requested = Signal()

    def __init__(self, parent: QWidget | None = None):
        super().__init__(parent)
        self._traces = Traces()
        self.since = Segmented("Compare with", _SINCE)
        self.colours = Segmented("Colours of the movement", _COLOURS)
        self.arrows = Segmented("Arrows", _ARROWS)
        self.factor = QDoubleSpinBox()
        self.factor.setRange(0.01, 100_000)
        self.factor.setDecimals(2)
        self.factor.setStepType(QAbstractSpinBox.StepType.AdaptiveDecimalStepType)
        self.factor.setPrefix("× ")
        self.factor.setKeyboardTracking(False)
        self.factor.setFont(tabular(self.factor.font()))
        set_help(self.factor, "Length of arrows", _FACTOR)
        self.show_newly = QPushButton("Show new")
        self._drawn = note()
        set_help(self._drawn, "Arrows that are drawn", _DRAWN)
        self._figures = {name: _figure() for name in _FIGURES}
        self._lay_out()
        self.since.chosen.connect(lambda key: self._change(since=Since(key)))
        self.arrows.chosen.connect(lambda key: self._change(arrows=Arrows(key)))
        self.factor.valueChanged.connect(lambda value: self._change(factor=value))
        self.colours.chosen.connect(self.colours_chosen)
        self.show_newly.clicked.connect(self.newly_inverted_requested)
        self.set_traces(self._traces)
        self.set_counts(None, "", 0)
        self.set_arrows(0, 0)

    def _lay_out(self) -> None:
        grid = QGridLayout(self)
        grid.setContentsMargins(0, 0, 0, 0)
        grid.setHorizontalSpacing(10)
        grid.setVerticalSpacing(5)
        grid.setColumnStretch(1, 1)
        lengths = QHBoxLayout()
        lengths.setSpacing(8)
        lengths.addWidget(self.factor)
        lengths.addWidget(self._drawn, 1)
        rows = (("Since", self.since), ("Colours", self.colours), ("Arrows", self.arrows))
        for row, (text, part) in enumerate(rows):
            label = QLabel(text)
            grid.addWidget(label, row, 0)
            label.setBuddy(part)
            grid.addWidget(part, row, 1)
        grid.addLayout(lengths, 3, 1)
        last = QHBoxLayout()
        last.setSpacing(8)
        last.addWidget(self._figures["Inverted"], 1)
        last.addWidget(self.show_newly)
        for row, (text, label) in enumerate(self._figures.items(), start=4):
            grid.addWidget(QLabel(text), row, 0)
            set_help(label, text, _FIGURES[text])
            if text == "Inverted":
                grid.addLayout(last, row, 1)
            else:
                grid.addWidget(label, row, 1)
        grid.setRowStretch(8, 1)

    # What is shown

    def set_traces(self, traces: Traces) -> None:
        """Show a choice, without a signal."""
        self._traces = traces
        self.since.set_value(traces.since.value)
        self.arrows.set_value(traces.arrows.value)
        self.factor.setEnabled(traces.arrows is not Arrows.NONE)
        if self.factor.value() != traces.factor:
            with QSignalBlocker(self.factor):
                self.factor.setValue(traces.factor)

    def set_colours(self, name: str) -> None:
        """Show what the colours show, by a name of `DISPLACEMENT_QUANTITIES` or ""; without a signal."""
        self.colours.set_value("moved-most" if name == "moved-mean" else name)

    def set_arrows(self, drawn: int, moved: int) -> None:
        """Show how many arrows are drawn of how many moved nodes."""
        self._drawn.setText(arrows_in_words(self._traces, drawn, moved))

    def set_counts(self, counts: DisplacementCounts | None, name: str, free: int) -> None:
        """Show the size of the displacement since `name`; `free` is the number of free nodes, None means no mesh."""
        self.show_newly.setEnabled(counts is not None and counts.newly_inverted > 0)
        reason = (
            "None is." if counts is None or not counts.newly_inverted else "Isolate them; Esc shows the rest again."
        )
        set_help(self.show_newly, "Show newly inverted", f"Hexes that were not inverted then and are now. {reason}")
        texts = ("No mesh is open.", "", "", "") if counts is None else _texts(counts, name, free)
        for label, text in zip(self._figures.values(), texts, strict=True):
            label.setText(text)

    def _change(self, **fields: object) -> None:
        traces = dataclasses.replace(self._traces, **fields)
        if traces != self._traces:
            self.set_traces(traces)
            self.traces_changed.emit(traces)


def arrows_in_words(traces: Traces, drawn: int, moved: int) -> str:
    """Describe the number and length of the arrows.

    >>> arrows_in_words(Traces(arrows=Arrows.ALL, factor=10), 5000, 28899)
    'The 5,000 longest of 28,899 arrows, 10 times true length.'
    >>> arrows_in_words(Traces(arrows=Arrows.ALL), 1, 1)
    '1 arrow, of true length.'
    """
    if traces.arrows is Arrows.NONE:
        return f"At most the {MOST:,} longest are drawn."
    if not drawn:
        where = "Of the nodes in sight none" if traces.arrows is Arrows.SIGHT else "No node of what is shown"
        return f"{where} has moved."
    these = f"The {drawn:,} longest of {moved:,} arrows" if drawn < moved else counted(drawn, "arrow")
    times = "of" if traces.factor == 1 else f"{short_number(traces.factor)} times"
    return f"{these}, {times} true length."


def _texts(counts: DisplacementCounts, name: str, free: int) -> tuple[str, str, str, str]:
    path = f"{figure(counts.mean)} on average, {figure(counts.largest)} at most" if counts.moved else "–"
    slid = f", {counts.slid:,} of the boundary slid" if counts.slid else ""
    return (
        f"{counts.moved - counts.slid:,} of {free:,} free moved since {name}{slid}",
        path,
        f"{counts.better:,} better, {counts.worse:,} worse",
        f"{counts.newly_inverted:,} newly, {counts.mended:,} mended",
    )


def _figure() -> QLabel:
    label = note()
    label.setFont(tabular(label.font()))
    label.setWordWrap(False)
    return label
