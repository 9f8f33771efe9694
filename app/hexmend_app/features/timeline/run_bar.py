"""Buttons to run, step, stop and reset below the view, with the state of the run in a word."""

from __future__ import annotations

from collections.abc import Mapping

from PySide6.QtCore import QSize
from PySide6.QtGui import QAction
from PySide6.QtWidgets import QHBoxLayout, QWidget

from hexmend.iteration import Outcome
from hexmend_app.state.run.run_controller import Phase
from hexmend_app.theme.palette import AMBER, BETTER, BLUE, MUTED, ON_ACCENT, WORSE
from hexmend_app.theme.spacing import fill
from hexmend_app.theme.style import bold, set_variant, tint
from hexmend_app.translation import tr
from hexmend_app.widgets.action_button import ActionButton
from hexmend_app.widgets.eliding_label import ElidingLabel

#: Words and colours of the phases of a run that has not ended.
_PHASES = {
    Phase.IDLE: ("Ready", MUTED),
    Phase.PREPARING: ("Preparing", BLUE),
    Phase.RUNNING: ("Running", BLUE),
    Phase.PAUSED: ("Paused", AMBER),
    Phase.STOPPING: ("Stopping", AMBER),
}

#: Words and colours of the ends of a run.
_ENDS = {
    Outcome.CONVERGED: ("Converged", BETTER),
    Outcome.NO_IMPROVEMENT: ("Converged", BETTER),
    Outcome.SUFFICIENT: ("Done", BETTER),
    Outcome.FINISHED: ("Done", BETTER),
    Outcome.MAX_ITERATIONS: ("Iteration limit", AMBER),
    Outcome.MAX_SECONDS: ("Time limit", AMBER),
    Outcome.STOPPED: ("Stopped", AMBER),
    Outcome.NO_DESCENT: ("No descent", AMBER),
    Outcome.NOT_FINITE: ("Non-finite values", AMBER),
    Outcome.NOTHING_FREE: ("No free nodes", AMBER),
}

_FAILED = "Failed", WORSE
_UNDONE = "Undone", MUTED

_BUTTONS = "step", "stop", "reset"

#: Texts that the first button has in turn.
_FACES = "Run", "Pause", "Resume", "Preparing", "Stopping"


class _State(ElidingLabel):
    """Label that has the width of the longest word, and is elided in a narrow window."""

    def sizeHint(self) -> QSize:
        words = (tr(word) for word, _ in (*_PHASES.values(), *_ENDS.values()))
        return QSize(max(map(self.fontMetrics().horizontalAdvance, words)) + 4, super().sizeHint().height())

    def minimumSizeHint(self) -> QSize:
        return QSize(self.fontMetrics().horizontalAdvance(tr("Converged")), super().minimumSizeHint().height())


class RunBar(QWidget):
    """Row of buttons that run, step, stop and reset, and the word for the state of the run."""

    def __init__(self, parent: QWidget | None = None):
        super().__init__(parent)
        run = ActionButton(role=ON_ACCENT, with_text=True)
        set_variant(run, "main")
        self._buttons = {"run": run} | {name: ActionButton() for name in _BUTTONS}
        self._state = _State()
        self._state.setAccessibleName(tr("State of the run"))
        self._state.setFont(bold(self._state.font()))
        for name in _BUTTONS:
            self._buttons[name].setAutoRaise(True)
        fill(QHBoxLayout(self), *self._buttons.values(), self._state, margins=(0, 0, 0, 0), spacing=4)
        run.reserve_width(map(tr, _FACES), around=20)

    def show_actions(self, actions: Mapping[str, QAction]) -> None:
        """Show the actions "run", "step", "stop" and "reset"."""
        for name, button in self._buttons.items():
            button.show_action(actions[name])

    def set_state(
        self, phase: Phase, outcome: Outcome | None, failed: bool = False, undone: bool = False, inverted: int = 0
    ) -> None:
        """Show the word for a phase of a run, for its outcome if it has ended, or that it failed or was undone.

        For a run that ended well but left some hexes inverted, their number in the colour of a warning.
        """
        if failed or undone:
            word, colour = _FAILED if failed else _UNDONE
        else:
            word, colour = _ENDS[outcome] if phase is Phase.FINISHED else _PHASES[phase]
        text = help = tr(word)
        if inverted and colour is BETTER:
            text, colour = tr("{count:,} inverted", count=inverted), AMBER
            help = f"{tr(word)}, {text}"
        if self._state.toolTip() != help:
            self._state.setText(text)
            self._state.setToolTip(help)
            tint(self._state, colour)

    @property
    def state(self) -> str:
        """The word shown."""
        return self._state.text()

    def button(self, name: str) -> ActionButton:
        """Return the button of an action."""
        return self._buttons[name]
