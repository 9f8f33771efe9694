"""Buttons to run, pause, step, stop and reset."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QGridLayout, QPushButton, QWidget

from hexmend_app.theme.palette import ACCENT, ACCENT_HOVER, ACCENT_PRESSED, FAINT, INACTIVE, LINE, ON_ACCENT, TEXT
from hexmend_app.theme.style import icon, on_theme_change, set_help


@dataclass(frozen=True)
class RunState:
    """Controls in a run state: text, icon and help of the main button, and whether each control is enabled."""

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
_HELP = {
    "step": "Run the number of iterations set below, then pause.",
    "stop": "Stop the run after this iteration and keep its result.",
    "reset": "Restore all node positions of the mesh as it was opened.",
}


class RunButtons(QWidget):
    """Row of buttons; the first one runs, pauses or resumes, depending on the state.

    Signals
    -------
    pressed(name)
        "run", "step", "stop" or "reset".
    """

    pressed = Signal(str)

    def __init__(self, parent: QWidget | None = None):
        super().__init__(parent)
        self._state = "idle"
        self._shortcuts: dict[str, str] = {}
        self._buttons = {
            "run": QPushButton(),
            "step": QPushButton(icon("skip-next"), "Step"),
            "stop": QPushButton(icon("stop"), ""),  # no text: the column is narrow
            "reset": QPushButton(icon("restore"), ""),
        }
        on_theme_change(self, lambda: self._buttons["run"].setStyleSheet(_main_button()))
        row = QGridLayout(self)
        row.setContentsMargins(0, 0, 0, 0)
        row.setSpacing(6)
        for column, (name, button) in enumerate(self._buttons.items()):
            row.setColumnStretch(column, 1 if button.text() or name == "run" else 0)
            button.clicked.connect(lambda _=False, name=name: self.pressed.emit(name))
            row.addWidget(button, 0, column)
        self._reserve_space()
        self.set_state("idle", True)

    def _reserve_space(self) -> None:
        """Reserve the width of the longest text, so that no button moves when the state changes."""
        widest = 0
        for state in STATES:
            self.set_state(state, True)
            self._buttons["run"].ensurePolished()
            widest = max(widest, self._buttons["run"].minimumSizeHint().width())
        self._buttons["run"].setMinimumWidth(widest)
        for name in ("step", "stop", "reset"):  # four buttons of the style's 80 pixels do not fit
            button = self._buttons[name]
            text = button.fontMetrics().horizontalAdvance(button.text())
            button.setMinimumWidth(text + button.iconSize().width() + 18)

    def set_state(self, state: str, available: bool) -> None:
        """Show a state of `STATES`; no button is enabled unless `available`."""
        self._state = state
        controls = STATES[state]
        self._buttons["run"].setText(controls.text)
        self._buttons["run"].setIcon(icon(controls.icon, ON_ACCENT))
        for name, button in self._buttons.items():
            button.setEnabled(available and getattr(controls, name))
        self._explain()

    def set_shortcuts(self, shortcuts: Mapping[str, str]) -> None:
        """Name keys in the tooltips, by button."""
        self._shortcuts = dict(shortcuts)
        self._explain()

    def button(self, name: str) -> QPushButton:
        """Return the button with a name that `pressed` sends."""
        return self._buttons[name]

    def _explain(self) -> None:
        for name, button in self._buttons.items():
            help = STATES[self._state].help if name == "run" else _HELP[name]
            keys = f" ({self._shortcuts[name]})" if name in self._shortcuts else ""
            set_help(button, button.text() or name.capitalize(), f"{help}{keys}")


def _main_button() -> str:
    """Return the style sheet of the main button."""
    return f"""
QPushButton {{ background: {ACCENT}; color: {ON_ACCENT}; border: 1px solid {ACCENT}; border-radius: 3px;
    padding: 4px 6px; }}
QPushButton:hover {{ background: {ACCENT_HOVER}; }}
QPushButton:pressed {{ background: {ACCENT_PRESSED}; }}
QPushButton:focus {{ border: 2px solid {TEXT}; padding: 3px 5px; outline: none; }}
QPushButton:disabled {{ background: {INACTIVE}; color: {FAINT}; border-color: {LINE}; }}
"""
