"""Buttons to run, pause, step, stop and reset."""

from __future__ import annotations

from collections.abc import Mapping
from typing import NamedTuple

from PySide6.QtGui import QAction
from PySide6.QtWidgets import QGridLayout, QSizePolicy, QWidget

from hexmend_app.theme.palette import ON_ACCENT
from hexmend_app.theme.style import set_variant
from hexmend_app.translation import tr
from hexmend_app.widgets.action_button import ActionButton


class RunState(NamedTuple):
    """Controls in a run state: text, icon and help of the main button, and which controls are enabled."""

    text: str
    icon: str
    help: str
    run: bool
    step: bool
    stop: bool
    reset: bool
    edit: bool


_RUN = "Smooth the mesh with this method until a stopping criterion is met."
STATES = {
    "idle": RunState("Run", "play", _RUN, run=True, step=True, stop=False, reset=False, edit=True),
    "preparing": RunState(
        "Preparing", "timer-sand", "Preparing the method.", run=False, step=False, stop=True, reset=False, edit=False
    ),
    "stopping": RunState(
        "Stopping", "timer-sand", "Stopping the run.", run=False, step=False, stop=False, reset=False, edit=False
    ),
    "running": RunState(
        "Pause", "pause", "Pause after this iteration.", run=True, step=False, stop=True, reset=False, edit=False
    ),
    "paused": RunState("Resume", "play", "Continue the run.", run=True, step=True, stop=True, reset=True, edit=True),
    "finished": RunState("Run", "play", _RUN, run=True, step=True, stop=False, reset=True, edit=True),
}


class RunButtons(QWidget):
    """Row of buttons that run, step, stop and reset; the first one runs, pauses or resumes, depending on the state."""

    def __init__(self, parent: QWidget | None = None):
        super().__init__(parent)
        self._buttons = {
            "run": ActionButton(role=ON_ACCENT, with_text=True),
            "step": ActionButton(with_text=True),
            "stop": ActionButton(),  # no text: the column is narrow
            "reset": ActionButton(),
        }
        run = self._buttons["run"]
        set_variant(run, "main")
        row = QGridLayout(self)
        row.setContentsMargins(0, 0, 0, 0)
        row.setSpacing(4)
        for column, (name, button) in enumerate(self._buttons.items()):
            if name in ("run", "step"):
                button.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Fixed)
                row.setColumnStretch(column, 1)
            row.addWidget(button, 0, column)
        run.reserve_width((tr(state.text) for state in STATES.values()), around=20)

    def show_actions(self, actions: Mapping[str, QAction]) -> None:
        """Show the actions "run", "step", "stop" and "reset"."""
        for name, button in self._buttons.items():
            button.show_action(actions[name])

    def button(self, name: str) -> ActionButton:
        """Return the button of an action."""
        return self._buttons[name]
