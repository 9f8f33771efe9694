"""The panel for looking inside: peel, shrink, isolate, dig, and the outline of what is hidden."""

from __future__ import annotations

from PySide6.QtCore import QSignalBlocker, Signal
from PySide6.QtWidgets import QCheckBox, QGridLayout, QHBoxLayout, QLabel, QPushButton, QSpinBox, QWidget

from hexmend_app.picture.appearance import Look
from hexmend_app.scene.geometry.skin import WHOLE
from hexmend_app.theme.style import icon, note, set_help, tabular
from hexmend_app.widgets.inputs.slider_box import SliderBox
from hexmend_app.widgets.wording import counted

_MOST_SHRUNK = 60  # per cent
_MOST_RINGS = 99

_PEEL = (
    "Hide the outer layers of hexes. Layer 1 are the hexes with a face on the boundary, layer 2 those that share "
    "a face with them, and so on."
)
_NO_LAYERS = "Nothing to peel: every hex has a face on the boundary."
_SHRINK = (
    "Draw each hex smaller, about its centre, to see its shape and the hexes behind it. Of more than "
    f"{WHOLE:,} hexes only those with a face in sight are drawn, and their sides when the view rests."
)
_CUT_SMOOTHLY = "Hexes that are cut through cannot be shrunk: choose <i>Whole hexes</i> for the cut."
_RINGS = (
    "Number of rings of hexes shown as ghosts around the isolated hexes: ring 1 are those that share a node with them, "
    "ring 2 those that share one with ring 1, and so on."
)


class InsidePanel(QWidget):
    """Hides hexes to show the hexes behind them.

    Attributes
    ----------
    isolated, dug, shown : QLabel
        Say how many are isolated, dug away and shown.

    Signals
    -------
    peel_changed(int), shrink_changed(float), rings_changed(int), outline_changed(bool)
        The user chose; shrink is a share.
    all_requested
        End the isolation.
    undo_requested, put_back_requested
        Restore the hex that was dug away last, or all.
    """

    peel_changed = Signal(int)
    shrink_changed = Signal(float)
    rings_changed = Signal(int)
    outline_changed = Signal(bool)
    all_requested = Signal()
    undo_requested = Signal()
    restore_requested = Signal()

    def __init__(self, parent: QWidget | None = None):
        super().__init__(parent)
        self._peel = SliderBox("Layers peeled from the boundary", _PEEL, 0)
        self._shrink = SliderBox("Shrink the hexes", _SHRINK, _MOST_SHRUNK, " %")
        width = max(self._peel.box_width(), self._shrink.box_width())
        for part in (self._peel, self._shrink):
            part.set_box_width(width)
        self._rings = QSpinBox()
        self._rings.setRange(0, _MOST_RINGS)
        self._rings.setFont(tabular(self._rings.font()))
        self._rings.setFixedWidth(width)
        set_help(self._rings, "Rings around what is isolated", _RINGS)
        self.isolated = QLabel()
        self._all = QPushButton("All")
        self._all.setFixedWidth(44)  # the style's 80 pixels are more than the column has
        set_help(self._all, "Show all", "End the isolation and show all hexes.")
        self.dug = QLabel()
        self._undo = QPushButton(icon("undo"), "")
        set_help(self._undo, "Undo digging", "Restore the hex that was dug away last.")
        self._restore = QPushButton(icon("restore"), "")
        for button in (self._undo, self._restore):
            button.setFixedWidth(34)
        set_help(self._restore, "Restore all", "Restore all hexes that were dug away.")
        self._outline = QCheckBox("Sharp edges and outline")
        set_help(
            self._outline,
            "Sharp edges and outline",
            "Draw where the boundary has an edge; where a part is hidden, paler; of a round body, its shade.",
        )
        self.shown = note()
        self.shown.setFont(tabular(self.shown.font()))
        self.shown.setWordWrap(False)  # a second line would be kept free for what never comes
        self._cut_smoothly = False
        self._lay_out()

        self._peel.changed.connect(self.peel_changed)
        self._shrink.changed.connect(lambda share: self.shrink_changed.emit(share / 100))
        self._rings.valueChanged.connect(self.rings_changed)
        self._all.clicked.connect(self.all_requested)
        self._undo.clicked.connect(self.undo_requested)
        self._restore.clicked.connect(self.restore_requested)
        self._outline.clicked.connect(self.outline_changed)
        self.set_layers(0)
        self.set_look(Look(), 1)
        self.set_shown(0, 0)

    def _lay_out(self) -> None:
        grid = QGridLayout(self)
        grid.setContentsMargins(0, 0, 0, 0)
        grid.setHorizontalSpacing(8)
        grid.setVerticalSpacing(7)
        grid.setColumnStretch(1, 1)
        lines = QHBoxLayout(), QHBoxLayout()
        groups = (self.isolated, self._all), (self.dug, self._undo, self._restore)
        for line, parts in zip(lines, groups, strict=True):
            line.setSpacing(8)
            for part in parts:
                line.addWidget(part, isinstance(part, QLabel))
        for row, (text, widget) in enumerate((("Peel", self._peel), ("Shrink", self._shrink), ("Rings", self._rings))):
            label = QLabel(text)
            label.setBuddy(widget)
            grid.addWidget(label, row, 0)
        grid.addWidget(self._peel, 0, 1)
        grid.addWidget(self._shrink, 1, 1)
        grid.addWidget(self._rings, 2, 1)
        for row, line in enumerate(lines, start=3):
            grid.addLayout(line, row, 0, 1, 2)
        grid.addWidget(self._outline, 5, 0, 1, 2)
        grid.addWidget(self.shown, 6, 0, 1, 2)

    def set_layers(self, layers: int) -> None:
        """Set the number of layers that can be peeled; without a signal."""
        self._peel.set_most(layers)
        self._peel.set_help(_PEEL if layers else _NO_LAYERS)
        self._peel.setEnabled(layers > 0)

    def set_look(self, look: Look, rings: int) -> None:
        """Show a look, and how many rings what is isolated has or would have; without a signal."""
        self._peel.set_value(look.peel)
        self._cut_smoothly = look.clip is not None and not look.clip.crinkle
        self._shrink.set_value(round(100 * look.shrink))
        self._shrink.setEnabled(not self._cut_smoothly)
        self._shrink.set_help(_CUT_SMOOTHLY if self._cut_smoothly else _SHRINK)
        if self._rings.value() != rings:  # or what is being typed would be written anew
            with QSignalBlocker(self._rings):
                self._rings.setValue(rings)
        isolated = len(look.isolation.hexes) if look.isolation is not None else 0
        self.isolated.setText(f"{counted(isolated, 'hex')} isolated" if isolated else "Nothing isolated")
        self._all.setEnabled(look.isolation is not None)
        self.dug.setText(f"{counted(len(look.dug), 'hex')} dug away" if look.dug else "Nothing dug away")
        for button in (self._undo, self._restore):
            button.setEnabled(bool(look.dug))
        self._outline.setChecked(look.outline)

    def set_shown(self, shown: int, total: int) -> None:
        """Show how many hexes of the total are shown, whole or in part; 0 of 0 without a mesh."""
        if shown == 0 < total:
            self.shown.setText(f"None of {counted(total, 'hex')} is left to show.")
            return
        cut = ", then cut" if self._cut_smoothly else ""
        self.shown.setText(f"{shown:,} of {counted(total, 'hex')} shown{cut}" if total else "")
