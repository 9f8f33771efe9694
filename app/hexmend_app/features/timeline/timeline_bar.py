"""Bar below the view to show, play and branch from the iterations of a run."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence

from PySide6.QtCore import QSignalBlocker, QSize, Qt, Signal, SignalInstance
from PySide6.QtGui import QAction, QActionGroup, QMouseEvent, QResizeEvent
from PySide6.QtWidgets import QHBoxLayout, QLabel, QMenu, QSlider, QStyle, QStyleOptionSlider, QToolButton, QWidget

from hexmend.iteration import Outcome
from hexmend_app.state.run.run_controller import Phase
from hexmend_app.theme.palette import AMBER, BETTER, BLUE, MUTED, ON_ACCENT, WORSE
from hexmend_app.theme.spacing import Part, fill
from hexmend_app.theme.style import bold, set_help, set_variant, tabular, tint, tool_button
from hexmend_app.translation import tr
from hexmend_app.widgets.action_button import ActionButton
from hexmend_app.widgets.eliding_label import ElidingLabel
from hexmend_app.widgets.inputs.combo import ComboBox, let_shrink
from hexmend_app.widgets.wording import counted, size

#: Options for the memory of node positions, in MB, and for the playback speed, in iterations per second.
LIMITS, SPEEDS = (128, 256, 512, 1024, 2048, 4096), (2, 5, 10, 20, 30)
#: Smallest width of the slider, and width of a bar from which it has all buttons, in pixels.
_LEAST_TRACK, _WIDE = 90, 760
#: Actions on buttons next to the slider.
_STEPS = ("first", "back", "play", "on", "newest")
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


class TimelineBar(QWidget):
    """Bar with buttons of the active run, the runs, a slider for the iterations, and buttons.

    Attributes
    ----------
    run_bar : RunBar
        Buttons and state of the active run.

    Signals
    -------
    delete_requested
        The user wants to delete the run.
    limit_changed(int), speed_changed(int)
        In megabytes, and in iterations per second.
    """

    delete_requested = Signal()
    limit_changed = Signal(int)
    speed_changed = Signal(int)

    def __init__(self, parent: QWidget | None = None):
        super().__init__(parent)
        self.run_bar = RunBar()
        self.runs = ComboBox()
        let_shrink(self.runs, 5)
        set_help(self.runs, tr("Run"), tr("Run shown in the timeline."))
        self._buttons = {name: ActionButton(f"iteration_{name}") for name in (*_STEPS, "branch")}
        for button in self._buttons.values():
            button.setAutoRaise(True)
        self.slider = TrackSlider(Qt.Orientation.Horizontal)
        self.slider.setMinimumWidth(_LEAST_TRACK)
        set_help(self.slider, tr("Iteration"), tr("Displayed iteration."))
        self._at = QLabel()
        self._at.setFont(tabular(self._at.font()))
        self._at.setAccessibleName(tr("Iteration shown"))
        self._more = tool_button("cog-outline")
        self._more.setPopupMode(QToolButton.ToolButtonPopupMode.InstantPopup)
        self._more.setMenu(self._menu())
        set_help(self._more, tr("Timeline settings"), tr("Memory limit and playback speed."))
        parts: list[Part] = [self.run_bar, 8, self.runs, 4, *(self._buttons[name] for name in _STEPS)]
        parts += [4, (self.slider, 1), 4, self._at, self._buttons["branch"], self._more]
        fill(QHBoxLayout(self), *parts, margins=(8, 0, 8, 0), spacing=4)
        self.set_runs(())

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Leave out the buttons for the ends of the run where the bar is narrow: the slider has these ends too."""
        super().resizeEvent(event)
        for name in ("first", "newest"):
            self._buttons[name].setVisible(self.width() >= _WIDE)

    def set_runs(self, names: Sequence[tuple[str, str]]) -> None:
        """List the names and tooltips of runs without sending a signal."""
        with QSignalBlocker(self.runs):
            self.runs.clear()
            for name, help in names:
                self.runs.add(name, help)
        for widget in (self.runs, self.slider):
            widget.setEnabled(bool(names))
        if not names:
            self.runs.setPlaceholderText(tr("No runs"))
            self.set_labels("iteration", ())
            self.set_track(0, 1, {}, 0)
            self.set_number(None)

    def set_track(self, newest: int, stored: int, pauses: Mapping[int, str], used: int) -> None:
        """Show the iterations of the run.

        Parameters
        ----------
        newest : int
            Number of the latest iteration.
        stored : int
            Number of iterations whose positions are stored.
        pauses : mapping of int to str
            Reasons of pauses, by iteration.
        used : int
            Memory of all runs in bytes.
        """
        with QSignalBlocker(self.slider):
            self.slider.setRange(0, newest)
        self.slider.setPageStep(max(1, newest // 10))
        part = "" if stored == newest + 1 else tr(" {count} of them are stored.", count=stored)
        reasons = "".join(f"<br>{number}: {sentence}" for number, sentence in pauses.items())
        tip = f"<qt>{counted(newest, self._unit)}.{part}{reasons}</qt>"
        if tip != self.slider.toolTip():
            self.slider.setToolTip(tip)
        self._used.setText(tr("In use: {count}", count=size(used)))

    def set_labels(self, unit: str, labels: Sequence[str]) -> None:
        """Set the noun for iterations, and their names if these are no numbers, as of the times of a case."""
        self._unit, self._labels = unit, labels

    def set_number(self, number: int | None) -> None:
        """Show the number of the displayed iteration; None if it is not in the run."""
        newest = self.slider.maximum()
        if number is not None and not self.slider.isSliderDown():
            with QSignalBlocker(self.slider):
                self.slider.setValue(number)
        shown = "–" if number is None else number
        if self._labels:
            self._at.setText("–" if number is None else self._labels[number])
        else:
            self._at.setText(tr("{number} of {newest}", number=shown, newest=newest) if self.runs.count() else "")
        # The size of the longest text keeps the slider in place under the pointer, and needs no layout for each number.
        longest = max(self._labels, key=len) if self._labels else f"{max(newest, 999)} of {max(newest, 999)}"
        self._at.setFixedSize(self._at.fontMetrics().size(0, longest))

    def set_settings(self, limit: int, speed: float) -> None:
        """Show the memory limit in MB and the playback speed in iterations per second."""
        for group, value in ((self._limits, limit), (self._speeds, speed)):
            for action in group.actions():
                action.setChecked(action.data() == value)

    def button(self, name: str) -> ActionButton:
        """Return the button "first", "back", "play", "on", "newest" or "branch"."""
        return self._buttons[name]

    def _menu(self) -> QMenu:
        menu = QMenu(self)
        limits, speeds = menu.addMenu(tr("Memory limit")), menu.addMenu(tr("Playback speed"))
        self._limits = self._options(limits, LIMITS, lambda mb: size(mb << 20), self.limit_changed)
        self._used = limits.addAction("")
        self._used.setEnabled(False)
        self._speeds = self._options(speeds, SPEEDS, lambda n: tr("{n} iterations per second", n=n), self.speed_changed)
        self.delete = menu.addAction(tr("Delete this run"), self.delete_requested.emit)
        return menu

    def _options(
        self, menu: QMenu, values: Iterable[int], text_of: Callable[[int], str], chosen: SignalInstance
    ) -> QActionGroup:
        group = QActionGroup(menu)
        for value in values:
            action = QAction(text_of(value), group, checkable=True)
            action.setData(value)
            menu.addAction(action)
        group.triggered.connect(lambda action: chosen.emit(action.data()))
        return group


class TrackSlider(QSlider):
    """Slider that jumps to the pressed place."""

    def mousePressEvent(self, event: QMouseEvent) -> None:
        """Move the handle to the pressed place, from where it can be dragged."""
        if event.button() is Qt.MouseButton.LeftButton:
            option = QStyleOptionSlider()
            self.initStyleOption(option)
            style, part = self.style(), QStyle.SubControl.SC_SliderGroove
            groove = style.subControlRect(QStyle.ComplexControl.CC_Slider, option, part, self)
            handle = style.pixelMetric(QStyle.PixelMetric.PM_SliderLength, option, self)
            place = round(event.position().x()) - groove.x() - handle // 2
            self.setValue(QStyle.sliderValueFromPosition(0, self.maximum(), place, groove.width() - handle))
        super().mousePressEvent(event)


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
        run = ActionButton("run", role=ON_ACCENT, with_text=True)
        set_variant(run, "main")
        self._buttons = {"run": run} | {name: ActionButton(name) for name in _BUTTONS}
        self._state = _State()
        self._state.setAccessibleName(tr("State of the run"))
        self._state.setFont(bold(self._state.font()))
        for name in _BUTTONS:
            self._buttons[name].setAutoRaise(True)
        fill(QHBoxLayout(self), *self._buttons.values(), self._state, margins=(0, 0, 0, 0), spacing=4)
        run.reserve_width(map(tr, _FACES), around=20)

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
        """Return the button "run", "step", "stop" or "reset"."""
        return self._buttons[name]
