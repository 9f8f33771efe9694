"""Form for the breakpoints of a run."""

from __future__ import annotations

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QVBoxLayout, QWidget

from hexmend.parameters import Parameter
from hexmend_app.state.run.breakpoints import Breakpoints
from hexmend_app.theme.spacing import fill
from hexmend_app.widgets.inputs.parameter_form import ParameterForm

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
#: Word for a breakpoint that is not set.
_NONE = "none"


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
        self._form = ParameterForm(_declarations(0, 0), has_buttons=False)
        fill(QVBoxLayout(self), self._form, margins=(0, 0, 0, 0))
        self._form.changed.connect(lambda: self.changed.emit(self.breakpoints()))

    def breakpoints(self) -> Breakpoints:
        """Return the breakpoints set in the form."""
        values = self._form.values()
        return Breakpoints(**{name: None if value == _NONE else value for name, value in values.items()})

    def set_breakpoints(self, breakpoints: Breakpoints) -> None:
        """Show breakpoints."""
        values = vars(breakpoints)
        self._form.set_values({name: _NONE if value is None else value for name, value in values.items()})
        self.changed.emit(breakpoints)

    def set_mesh(self, hexes: int, nodes: int) -> None:
        """Set the size of a new mesh; all breakpoints are removed."""
        self._form.set_declarations(_declarations(hexes, nodes))
        self.changed.emit(self.breakpoints())


def _declarations(hexes: int, nodes: int) -> list[Parameter]:
    """Return the declarations of the fields of `Breakpoints` for a mesh of a size."""

    def number(name: str, count: int, label: str, help: str) -> Parameter:
        return Parameter(name, int, _NONE, 0, max(count - 1, 0), label=label, help=help, automatic=_NONE)

    return [
        Parameter("inverts", bool, False, label="A hex inverts", help=_INVERTS),
        Parameter("q_min_falls", bool, False, label="Minimum q drops", help=_FALLS),
        number("node", nodes, "Node no.", _NODE),
        Parameter("move", float, 0.1, 0, 9.999, label="Move above", unit="edges", help=_MOVE),
        number("hex", hexes, "Hex no.", _HEX),
        Parameter("change", float, 0.1, 0, 9.999, label="Change of q above", help=_CHANGE),
        number("backtracks", 100, "Backtracks above", _BACKTRACKS),
    ]
