"""The form for what a run pauses at."""

from __future__ import annotations

from PySide6.QtCore import QSignalBlocker, Signal
from PySide6.QtWidgets import QCheckBox, QDoubleSpinBox, QGridLayout, QHBoxLayout, QLabel, QSpinBox, QWidget

from hexmend.run.breakpoints import Breakpoints
from hexmend_app.theme.style import set_help, tabular

_INVERTS = "Pause after an iteration in which a hex that was sound inverts, and choose it."
_FALLS = "Pause after an iteration that lowers the least quality, and choose the hex that has it now."
_NODE = (
    "Pause when this node moves further in an iteration, in mean edge lengths. Ticked, it takes the node that is "
    "chosen in the view."
)
_HEX = "Pause when q(H) of this hex changes by more in one iteration. Ticked, it takes the hex that is chosen."
_CUTS = (
    "Pause when the line search (Algorithm A.5) has to shorten the step more often than this. Methods that search for "
    "each node by itself do not tell."
)


class BreakpointForm(QWidget):
    """Chooses what a run pauses at.

    Signals
    -------
    changed(Breakpoints)
        The user chose.
    """

    changed = Signal(object)

    def __init__(self, parent: QWidget | None = None):
        super().__init__(parent)
        self._chosen: tuple[int | None, int | None] = (None, None)
        grid = QGridLayout(self)
        grid.setContentsMargins(0, 0, 0, 0)
        grid.setHorizontalSpacing(6)
        grid.setVerticalSpacing(4)
        self._inverts = self._check(grid, 0, "A hex inverts", _INVERTS)
        self._falls = self._check(grid, 1, "q min falls", _FALLS)
        self._node, self._node_box, self._move = self._watch(grid, 2, "Node", "moves", _NODE, " edge")
        self._hex, self._hex_box, self._change = self._watch(grid, 4, "Hex", "changes", _HEX, " q")
        self._cut = self._check(grid, 6, "Line search backtracks", _CUTS)
        self._cuts = self._number(QSpinBox(), "Most cuts of the line search", _CUTS)
        self._cuts.setRange(0, 99)
        self._cuts.setValue(3)
        self._ask(grid, 7, "more often than", self._cuts)
        grid.setColumnStretch(0, 1)
        self._node.clicked.connect(lambda on: self._take(self._node_box, self._chosen[1], on))
        self._hex.clicked.connect(lambda on: self._take(self._hex_box, self._chosen[0], on))
        for check in (self._inverts, self._falls, self._node, self._hex, self._cut):
            check.clicked.connect(self._tell)
        for box in (self._node_box, self._move, self._hex_box, self._change, self._cuts):
            box.valueChanged.connect(self._tell)
        self._enable()

    def breakpoints(self) -> Breakpoints:
        """Return the chosen breakpoints."""
        return Breakpoints(
            inverts=self._inverts.isChecked(),
            q_min_falls=self._falls.isChecked(),
            node=self._node_box.value() if self._node.isChecked() else None,
            move=self._move.value(),
            hex=self._hex_box.value() if self._hex.isChecked() else None,
            change=self._change.value(),
            backtracks=self._cuts.value() if self._cut.isChecked() else None,
        )

    def set_breakpoints(self, breakpoints: Breakpoints) -> None:
        """Choose these."""
        for check, on in (
            (self._inverts, breakpoints.inverts),
            (self._falls, breakpoints.q_min_falls),
            (self._node, breakpoints.node is not None),
            (self._hex, breakpoints.hex is not None),
            (self._cut, breakpoints.backtracks is not None),
        ):
            check.setChecked(on)
        for box, value in (
            (self._node_box, breakpoints.node),
            (self._move, breakpoints.move),
            (self._hex_box, breakpoints.hex),
            (self._change, breakpoints.change),
            (self._cuts, breakpoints.backtracks),
        ):
            if value is not None:
                with QSignalBlocker(box):
                    box.setValue(value)
        self._tell()

    def set_chosen(self, hex: int | None, node: int | None) -> None:
        """Take which element and node are chosen in the view, for when one is to be watched."""
        self._chosen = (hex, node)

    def set_mesh(self, hexes: int, nodes: int) -> None:
        """Take another mesh, of so many elements and nodes, of which none is watched yet."""
        for check, box, count in ((self._hex, self._hex_box, hexes), (self._node, self._node_box, nodes)):
            check.setChecked(False)
            box.setRange(0, max(count - 1, 0))
        self._tell()

    def _check(self, grid: QGridLayout, row: int, text: str, help: str, span: int = 2) -> QCheckBox:
        check = QCheckBox(text)
        set_help(check, text, help)
        grid.addWidget(check, row, 0, 1, span)
        return check

    def _watch(
        self, grid: QGridLayout, row: int, subject: str, verb: str, help: str, suffix: str
    ) -> tuple[QCheckBox, QSpinBox, QDoubleSpinBox]:
        """Two rows: which one, and how much."""
        check = self._check(grid, row, f"{subject} {verb}", help, span=1)
        which = self._number(QSpinBox(), f"Number of the {subject.lower()}", help)
        amount = self._number(QDoubleSpinBox(), f"How much the {subject.lower()} {verb}", help)
        amount.setRange(0, 10)
        amount.setDecimals(3)
        amount.setSingleStep(0.01)
        amount.setValue(0.1)
        amount.setSuffix(suffix)
        grid.addWidget(which, row, 1)
        self._ask(grid, row + 1, "by more than", amount)
        return check, which, amount

    @staticmethod
    def _ask(grid: QGridLayout, row: int, words: str, box: QWidget) -> None:
        """A row for how much, below what."""
        line = QHBoxLayout()
        line.setContentsMargins(22, 0, 0, 0)
        line.addWidget(QLabel(words))
        grid.addLayout(line, row, 0)
        grid.addWidget(box, row, 1)

    @staticmethod
    def _number(box, name: str, help: str):
        box.setFont(tabular(box.font()))
        set_help(box, name, help)
        return box

    def _take(self, box: QSpinBox, chosen: int | None, on: bool) -> None:
        if on and chosen is not None:
            box.setValue(chosen)

    def _enable(self) -> None:
        for check, boxes in (
            (self._node, (self._node_box, self._move)),
            (self._hex, (self._hex_box, self._change)),
            (self._cut, (self._cuts,)),
        ):
            for box in boxes:
                box.setEnabled(check.isChecked())

    def _tell(self) -> None:
        self._enable()
        self.changed.emit(self.breakpoints())
