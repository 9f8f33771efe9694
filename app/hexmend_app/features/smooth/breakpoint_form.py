"""Form for the breakpoints of a run."""

from __future__ import annotations

from PySide6.QtCore import QSignalBlocker, Signal
from PySide6.QtWidgets import QCheckBox, QDoubleSpinBox, QGridLayout, QHBoxLayout, QLabel, QSpinBox, QWidget

from hexmend_app.state.run.breakpoints import Breakpoints
from hexmend_app.theme.spacing import fill
from hexmend_app.theme.style import set_help, tabular
from hexmend_app.translation import tr

_INVERTS = "Pause after an iteration that inverts a valid hex, and select that hex."
_FALLS = "Pause after an iteration that lowers the minimum quality, and select the worst hex."
_NODE = (
    "Pause when this node moves further than this in one iteration, in mean edge lengths. Select the box to use the "
    "node selected in the view."
)
_HEX = (
    "Pause when q(H) of this hex changes by more than this in one iteration. Select the box to use the hex selected in "
    "the view."
)
_BACKTRACKS = (
    "Pause when the line search (Algorithm A.5) shortens the step more often than this. Not available for methods that "
    "search node by node."
)


class BreakpointForm(QWidget):
    """Form that edits the breakpoints of a run.

    Signals
    -------
    changed(Breakpoints)
        The breakpoints have changed.
    """

    changed = Signal(object)

    def __init__(self, parent: QWidget | None = None):
        super().__init__(parent)
        self._selected_hex: int | None = None
        self._selected_node: int | None = None
        grid = QGridLayout(self)
        grid.setContentsMargins(0, 0, 0, 0)
        grid.setHorizontalSpacing(4)
        grid.setVerticalSpacing(4)
        self._inverts = self._check(grid, 0, tr("A hex inverts"), tr(_INVERTS))
        self._falls = self._check(grid, 1, tr("Minimum q drops"), tr(_FALLS))
        self._node, self._node_box, self._move = self._watch(
            grid,
            2,
            (tr("Node moves"), tr("Node number"), tr("Node moves by more than")),
            tr(_NODE),
            tr(" edge"),
        )
        self._hex, self._hex_box, self._change = self._watch(
            grid, 4, (tr("Hex changes"), tr("Hex number"), tr("Hex changes by more than")), tr(_HEX), " q"
        )
        self._backtracks = self._check(grid, 6, tr("Line search backtracks"), tr(_BACKTRACKS))
        self._backtracks_box = self._number(QSpinBox(), tr("Maximum backtracks of the line search"), tr(_BACKTRACKS))
        self._backtracks_box.setRange(0, 99)
        self._backtracks_box.setValue(3)
        self._add_limit(grid, 7, tr("more often than"), self._backtracks_box)
        grid.setColumnStretch(0, 1)
        self._node.clicked.connect(lambda on: self._use_selected(self._node_box, self._selected_node, on))
        self._hex.clicked.connect(lambda on: self._use_selected(self._hex_box, self._selected_hex, on))
        for check in (self._inverts, self._falls, self._node, self._hex, self._backtracks):
            check.clicked.connect(self._on_changed)
        for box in (self._node_box, self._move, self._hex_box, self._change, self._backtracks_box):
            box.valueChanged.connect(self._on_changed)
        self._enable()

    def breakpoints(self) -> Breakpoints:
        """Return the breakpoints set in the form."""
        return Breakpoints(
            inverts=self._inverts.isChecked(),
            q_min_falls=self._falls.isChecked(),
            node=self._node_box.value() if self._node.isChecked() else None,
            move=self._move.value(),
            hex=self._hex_box.value() if self._hex.isChecked() else None,
            change=self._change.value(),
            backtracks=self._backtracks_box.value() if self._backtracks.isChecked() else None,
        )

    def set_breakpoints(self, breakpoints: Breakpoints) -> None:
        """Show `breakpoints` in the form."""
        for check, on in (
            (self._inverts, breakpoints.inverts),
            (self._falls, breakpoints.q_min_falls),
            (self._node, breakpoints.node is not None),
            (self._hex, breakpoints.hex is not None),
            (self._backtracks, breakpoints.backtracks is not None),
        ):
            check.setChecked(on)
        for box, value in (
            (self._node_box, breakpoints.node),
            (self._move, breakpoints.move),
            (self._hex_box, breakpoints.hex),
            (self._change, breakpoints.change),
            (self._backtracks_box, breakpoints.backtracks),
        ):
            if value is not None:
                with QSignalBlocker(box):
                    box.setValue(value)  # type: ignore[arg-type]  # of the type of its box
        self._on_changed()

    def set_selected(self, hex: int | None, node: int | None) -> None:
        """Set the hex and node selected in the view, which are proposed when a box is selected."""
        self._selected_hex, self._selected_node = hex, node

    def set_mesh(self, hexes: int, nodes: int) -> None:
        """Set the size of a new mesh; breakpoints on a single hex or node are removed."""
        for check, box, count in ((self._hex, self._hex_box, hexes), (self._node, self._node_box, nodes)):
            check.setChecked(False)
            box.setRange(0, max(count - 1, 0))
        self._on_changed()

    def _check(self, grid: QGridLayout, row: int, text: str, help: str, span: int = 2) -> QCheckBox:
        check = QCheckBox(text)
        set_help(check, text, help)
        grid.addWidget(check, row, 0, 1, span)
        return check

    def _watch(
        self, grid: QGridLayout, row: int, names: tuple[str, str, str], help: str, suffix: str
    ) -> tuple[QCheckBox, QSpinBox, QDoubleSpinBox]:
        """Add two rows for a hex or node: a check box, its number, and the limit of its change, with these names."""
        check = self._check(grid, row, names[0], help, span=1)
        number = self._number(QSpinBox(), names[1], help)
        amount = self._number(QDoubleSpinBox(), names[2], help)
        amount.setRange(0, 9.999)
        amount.setDecimals(3)
        amount.setSingleStep(0.01)
        amount.setValue(0.1)
        amount.setSuffix(suffix)
        grid.addWidget(number, row, 1)
        self._add_limit(grid, row + 1, tr("more than"), amount)
        return check, number, amount

    @staticmethod
    def _add_limit(grid: QGridLayout, row: int, label: str, box: QWidget) -> None:
        """Add an indented row with a label and the box of a limit."""
        line = fill(QHBoxLayout(), QLabel(label), margins=(8, 0, 0, 0), spacing=None)
        grid.addLayout(line, row, 0)
        grid.addWidget(box, row, 1)

    @staticmethod
    def _number(box, name: str, help: str):
        box.setFont(tabular(box.font()))
        set_help(box, name, help)
        return box

    @staticmethod
    def _use_selected(box: QSpinBox, selected: int | None, on: bool) -> None:
        if on and selected is not None:
            box.setValue(selected)

    def _enable(self) -> None:
        for check, boxes in (
            (self._node, (self._node_box, self._move)),
            (self._hex, (self._hex_box, self._change)),
            (self._backtracks, (self._backtracks_box,)),
        ):
            for box in boxes:
                box.setEnabled(check.isChecked())

    def _on_changed(self) -> None:
        self._enable()
        self.changed.emit(self.breakpoints())
