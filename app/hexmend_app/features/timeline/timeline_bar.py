"""The bar below the view: a run's iterations to go through, to play, and to go on from."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence

import numpy as np
from PySide6.QtCore import QSignalBlocker, Qt, Signal
from PySide6.QtGui import QAction, QActionGroup
from PySide6.QtWidgets import QComboBox, QHBoxLayout, QLabel, QMenu, QToolButton, QWidget

from hexmend_app.features.timeline.track_slider import TrackSlider
from hexmend_app.theme.style import icon, set_help, tabular
from hexmend_app.widgets.inputs.combo import let_shrink
from hexmend_app.widgets.wording import counted, size

#: What the positions of iterations may take, in MB, and how many are played a second.
LIMITS, SPEEDS = (128, 256, 512, 1024, 2048, 4096), (2, 5, 10, 20, 30)

_STEPS = (
    ("first", "skip-backward", "Before the run", "Show the mesh as it was before the run."),
    ("back", "step-backward", "One iteration back", "Show the iteration before."),
    ("play", "play", "Play", "Show the iterations one after another."),
    ("on", "step-forward", "One iteration on", "Show the next iteration."),
    ("newest", "skip-forward", "Newest iteration", "Show the newest iteration, and those that come."),
)


class TimelineBar(QWidget):
    """Goes through the iterations of a run.

    Signals
    -------
    run_chosen(int)
        Another run is to be gone through: its place in the list.
    number_chosen(int)
        Its iteration of that number is to be shown.
    pressed(name)
        "first", "back", "play", "on", "newest", "branch" or "forget".
    limit_changed(int), speed_changed(int)
        Megabytes; iterations a second.
    """

    run_chosen = Signal(int)
    number_chosen = Signal(int)
    pressed = Signal(str)
    limit_changed = Signal(int)
    speed_changed = Signal(int)

    def __init__(self, parent: QWidget | None = None):
        super().__init__(parent)
        self._runs = QComboBox()
        let_shrink(self._runs, 12)
        self._runs.activated.connect(self.run_chosen)
        set_help(self._runs, "Run", "The run that is gone through; one that began at an iteration of another says so.")
        self._keys: dict[str, str] = {}
        self._buttons = {name: self._tool(name, glyph, text) for name, glyph, text, _ in _STEPS}
        self._playing = False
        self._slider = TrackSlider()
        self._slider.valueChanged.connect(self.number_chosen)
        set_help(self._slider, "Iteration", "The iteration that is shown.")
        self._at = QLabel()
        self._at.setFont(tabular(self._at.font()))
        self._at.setAccessibleName("Iteration shown")
        self._branch = self._tool("branch", "source-branch", "Run from here")
        self._branch.setToolButtonStyle(Qt.ToolButtonStyle.ToolButtonTextBesideIcon)
        self._more = QToolButton()
        self._more.setIcon(icon("cog-outline"))
        self._more.setAutoRaise(True)
        self._more.setPopupMode(QToolButton.ToolButtonPopupMode.InstantPopup)
        self._more.setMenu(self._menu())
        set_help(self._more, "Timeline settings", "How much memory the iterations may take, and how fast they play.")
        layout = QHBoxLayout(self)
        layout.setContentsMargins(8, 1, 8, 1)
        layout.setSpacing(2)
        layout.addWidget(self._runs)
        layout.addSpacing(4)
        for button in self._buttons.values():
            layout.addWidget(button)
        layout.addSpacing(4)
        layout.addWidget(self._slider, 1)
        layout.addSpacing(4)
        for part in (self._at, self._branch, self._more):
            layout.addWidget(part)
        self._explain()
        self.set_runs(())

    def set_runs(self, names: Sequence[tuple[str, str]]) -> None:
        """Offer runs, each its name and what to say of it; without a signal."""
        with QSignalBlocker(self._runs):
            self._runs.clear()
            for at, (name, help) in enumerate(names):
                self._runs.addItem(name)
                self._runs.setItemData(at, help, Qt.ItemDataRole.ToolTipRole)
        for part in (self._runs, self._slider, self._branch, *self._buttons.values()):
            part.setEnabled(bool(names))
        if not names:
            self._runs.setPlaceholderText("No run yet")
            self.set_track(0, np.zeros(1, np.int64), {}, 0)
            self.set_number(None, False)

    def set_run(self, at: int) -> None:
        """Show which run is gone through."""
        self._runs.setCurrentIndex(at)

    def set_track(self, newest: int, kept: np.ndarray, marks: Mapping[int, str], used: int) -> None:
        """Take a run's length, which iterations can be shown, where it paused and why, and the bytes kept of all."""
        self._slider.set_track(newest, kept, marks)
        some = "" if len(kept) == newest + 1 else f" Positions are kept of {len(kept)} of them, marked below."
        pauses = "".join(f"<br>{number}: {sentence}" for number, sentence in marks.items())
        tip = f"<qt>{counted(newest, 'iteration')}.{some}{pauses}</qt>"
        if tip != self._slider.toolTip():
            self._slider.setToolTip(tip)
        self._used.setText(f"Now {size(used)}")

    def set_number(self, number: int | None, live: bool) -> None:
        """Show where one is: at an iteration, at what comes, or at nothing that this run knows."""
        newest = self._slider.maximum()
        if number is not None and not self._slider.isSliderDown():
            with QSignalBlocker(self._slider):
                self._slider.setValue(number)
        words = f"{'–' if number is None else number:>} of {newest}" if self._runs.count() else ""
        self._at.setText(words)
        longest = max(newest, 999)  # so that the slider keeps its place under the pointer
        self._at.setMinimumWidth(self._at.fontMetrics().horizontalAdvance(f"{longest} of {longest}"))
        back = number is None or number > 0
        for name, on in (("first", back), ("back", back), ("on", number != newest), ("newest", number != newest)):
            self._buttons[name].setEnabled(on and self._runs.count() > 0 and not (live and name in ("on", "newest")))

    def set_playing(self, playing: bool) -> None:
        """Show whether the iterations are being played."""
        if playing != self._playing:
            self._playing = playing
            self._buttons["play"].setIcon(icon("pause" if playing else "play"))
            self._explain()

    def set_settings(self, limit: int, speed: int) -> None:
        """Show the memory that may be taken, in MB, and the iterations a second."""
        for group, value in ((self._limits, limit), (self._speeds, speed)):
            for action in group.actions():
                action.setChecked(action.data() == value)

    def set_forgettable(self, on: bool) -> None:
        """Let the run be forgotten, or not."""
        self._forget.setEnabled(on)

    def set_shortcuts(self, shortcuts: Mapping[str, str]) -> None:
        """Name the keys of the buttons in their tooltips."""
        self._keys = dict(shortcuts)
        self._explain()

    def button(self, name: str) -> QToolButton:
        """A button by the name that `pressed` gives."""
        return self._branch if name == "branch" else self._buttons[name]

    def _tool(self, name: str, glyph: str, text: str) -> QToolButton:
        button = QToolButton()
        button.setIcon(icon(glyph))
        button.setText(text)
        button.setAutoRaise(True)
        button.clicked.connect(lambda: self.pressed.emit(name))
        return button

    def _menu(self) -> QMenu:
        menu = QMenu(self)
        menu.addSection("Memory for the positions of iterations")
        self._limits = self._choices(menu, LIMITS, lambda mb: size(mb << 20), self.limit_changed)
        self._used = menu.addAction("")
        self._used.setEnabled(False)
        menu.addSection("Played a second")
        self._speeds = self._choices(menu, SPEEDS, lambda n: counted(n, "iteration"), self.speed_changed)
        menu.addSeparator()
        self._forget = menu.addAction("Forget this run", lambda: self.pressed.emit("forget"))
        return menu

    def _choices(self, menu: QMenu, values: Iterable[int], words, chosen: Signal) -> QActionGroup:
        group = QActionGroup(menu)
        for value in values:
            action = QAction(words(value), group, checkable=True)
            action.setData(value)
            menu.addAction(action)
        group.triggered.connect(lambda action: chosen.emit(action.data()))
        return group

    def _explain(self) -> None:
        message = {name: (text, help) for name, _, text, help in _STEPS}
        if self._playing:
            message["play"] = "Pause", "Pause playing."
        message["branch"] = (
            "Run from here",
            "Run the chosen method from the iteration shown: a branch, in addition to its run.",
        )
        for name, (text, help) in message.items():
            keys = f" ({self._keys[name]})" if self._keys.get(name) else ""
            set_help(self.button(name), text, f"{help}{keys}")
