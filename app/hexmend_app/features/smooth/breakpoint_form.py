"""Form for the breakpoints of a run."""

from __future__ import annotations

from PySide6.QtCore import QSignalBlocker, Signal
from PySide6.QtWidgets import QCheckBox, QDoubleSpinBox, QPushButton, QSpinBox, QWidget

from hexmend_app.state.run.breakpoints import Breakpoints
from hexmend_app.theme.style import set_help, tabular
from hexmend_app.translation import tr
from hexmend_app.widgets.form import form_layout

_INVERTS = "Pause after an iteration that inverts a valid hex, and select that hex."
_FALLS = "Pause after an iteration that lowers the minimum quality, and select the worst hex."
_NODE = "Pause when the node with this number moves further than the limit below in one iteration."
_MOVE = "Limit of the node's move, in mean edge lengths."
_HEX = "Pause when q(H) of the hex with this number changes by more than the limit below in one iteration."
_CHANGE = "Limit of the change of q(H)."
_BACKTRACKS = (
    "Pause when the line search (Algorithm A.5) shortens the step more often than this. Not available for methods that "
    "search node by node."
)
#: Value of a number box that shows a word instead of a number.
_NO_NUMBER = -1


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
        self._selected: tuple[int | None, int | None] = (None, None)
        self._inverts, self._falls = QCheckBox(tr("A hex inverts")), QCheckBox(tr("Minimum q drops"))
        set_help(self._inverts, tr("A hex inverts"), tr(_INVERTS))
        set_help(self._falls, tr("Minimum q drops"), tr(_FALLS))
        self._node, self._move = _number(tr("none"), tr("Node number"), _NODE), _limit(tr(" edge"), _MOVE)
        self._hex, self._change = _number(tr("none"), tr("Hex number"), _HEX), _limit(tr(" q"), _CHANGE)
        self._backtracks = _number(tr("off"), tr("Backtracks of the line search"), _BACKTRACKS)
        self._backtracks.setMaximum(99)
        self._use_selected = QPushButton(tr("Use selected hex and node"))
        set_help(
            self._use_selected,
            tr("Use selected hex and node"),
            tr("Pause at changes of the hex and the node that are selected in the view."),
        )
        form = form_layout(self)
        form.addRow(self._inverts)
        form.addRow(self._falls)
        form.addRow(tr("Node no."), self._node)
        form.addRow(tr("   moves more than"), self._move)
        form.addRow(tr("Hex no."), self._hex)
        form.addRow(tr("   changes more than"), self._change)
        form.addRow(tr("Backtracks above"), self._backtracks)
        form.addRow(self._use_selected)
        self._use_selected.clicked.connect(self._on_use_selected)
        for check in (self._inverts, self._falls):
            check.clicked.connect(self._on_changed)
        for box in (self._node, self._move, self._hex, self._change, self._backtracks):
            box.valueChanged.connect(self._on_changed)
        self.set_mesh(0, 0)

    def breakpoints(self) -> Breakpoints:
        """Return the breakpoints set in the form."""
        return Breakpoints(
            inverts=self._inverts.isChecked(),
            q_min_falls=self._falls.isChecked(),
            node=_value(self._node),
            move=self._move.value(),
            hex=_value(self._hex),
            change=self._change.value(),
            backtracks=_value(self._backtracks),
        )

    def set_breakpoints(self, breakpoints: Breakpoints) -> None:
        """Show `breakpoints` in the form."""
        self._inverts.setChecked(breakpoints.inverts)
        self._falls.setChecked(breakpoints.q_min_falls)
        for box, value in (
            (self._node, breakpoints.node),
            (self._move, breakpoints.move),
            (self._hex, breakpoints.hex),
            (self._change, breakpoints.change),
            (self._backtracks, breakpoints.backtracks),
        ):
            with QSignalBlocker(box):
                box.setValue(_NO_NUMBER if value is None else value)  # type: ignore[arg-type]  # of the type of its box
        self._on_changed()

    def set_selected(self, hex: int | None, node: int | None) -> None:
        """Set the hex and node selected in the view."""
        self._selected = hex, node
        self._use_selected.setEnabled(self._selected != (None, None))

    def set_mesh(self, hexes: int, nodes: int) -> None:
        """Set the size of a new mesh; breakpoints on a single hex or node are removed."""
        for box, count in ((self._hex, hexes), (self._node, nodes)):
            with QSignalBlocker(box):
                box.setRange(_NO_NUMBER, count - 1)
                box.setValue(_NO_NUMBER)
        self._on_changed()

    def _on_use_selected(self) -> None:
        for box, number in zip((self._hex, self._node), self._selected, strict=True):
            if number is not None:
                box.setValue(number)

    def _on_changed(self) -> None:
        self._move.setEnabled(_value(self._node) is not None)
        self._change.setEnabled(_value(self._hex) is not None)
        self.changed.emit(self.breakpoints())


def _number(special: str, name: str, help: str) -> QSpinBox:
    """Return a box for a number from 0, below which it shows the word `special`."""
    box = QSpinBox()
    box.setMinimum(_NO_NUMBER)
    box.setValue(_NO_NUMBER)
    box.setSpecialValueText(special)
    box.setFont(tabular(box.font()))
    set_help(box, name, tr(help))
    return box


def _limit(suffix: str, help: str) -> QDoubleSpinBox:
    """Return a box for the limit of a change."""
    box = QDoubleSpinBox()
    box.setRange(0, 9.999)
    box.setDecimals(3)
    box.setSingleStep(0.01)
    box.setValue(0.1)
    box.setSuffix(suffix)
    box.setFont(tabular(box.font()))
    set_help(box, tr("Limit"), tr(help))
    return box


def _value(box: QSpinBox) -> int | None:
    return None if box.value() == _NO_NUMBER else box.value()
