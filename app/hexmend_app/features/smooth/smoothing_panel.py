"""The panel from which smoothing is started and held: method, parameters, stop conditions, buttons, status."""

from __future__ import annotations

from collections.abc import Mapping

from PySide6.QtCore import Qt, Signal
from PySide6.QtGui import QShowEvent
from PySide6.QtWidgets import QFormLayout, QHBoxLayout, QLabel, QScrollArea, QSpinBox, QVBoxLayout, QWidget

from hexmend.run.recipe import Stage
from hexmend_app.features.smooth.breakpoint_form import BreakpointForm
from hexmend_app.features.smooth.run_buttons import STATES, RunButtons
from hexmend_app.features.smooth.stage_form import StageForm
from hexmend_app.state.run.run_setup import RunSetup
from hexmend_app.theme.palette import Role
from hexmend_app.theme.style import MUTED, WORSE, note, set_help, tabular, tint
from hexmend_app.widgets.eliding_label import ElidingLabel
from hexmend_app.widgets.section import Section
from hexmend_app.widgets.wording import counted

# Height of a section's margins, and of names that take two lines in a narrow panel.
_AROUND_FORM = 24

# Lines that most sentences on a run fill at most.
_LINES = 4


class SmoothingPanel(QWidget):
    """Chooses a method and its values, and asks for it to be run.

    Signals
    -------
    run_requested(Stage), step_requested(Stage, iterations)
        Not sent while a value is wrong.
    change_requested(Stage)
        Before a paused run goes on: the rest of it is to be done with what was set meanwhile.
    pause_requested, resume_requested, stop_requested, reset_requested

    Parameters
    ----------
    order : Order
        What is set here, and by others.

    Attributes
    ----------
    stage : StageForm
    """

    run_requested = Signal(object)
    step_requested = Signal(object, int)
    change_requested = Signal(object)
    pause_requested = Signal()
    resume_requested = Signal()
    stop_requested = Signal()
    reset_requested = Signal()

    def __init__(self, order: RunSetup, parent: QWidget | None = None):
        super().__init__(parent)
        self._order = order
        self._refused = False
        self._state = "idle"
        self._placed = False

        stage = self.stage = StageForm(order, self)
        choice = QFormLayout()
        choice.setFieldGrowthPolicy(QFormLayout.FieldGrowthPolicy.AllNonFixedFieldsGrow)
        choice.addRow("Method", stage.method)

        self.breakpoint_form = BreakpointForm()
        self._sections = (
            Section(
                "Parameters", self.stage.parameters, "How the method goes about it; the defaults suit most meshes."
            ),
            Section("Stop when", stage.stop, "When a run ends by itself."),
            Section("Pause when", self.breakpoint_form, "Break-points: what a run pauses at, to be looked at."),
        )
        self.buttons = RunButtons()
        self.buttons.pressed.connect(self._on_button)

        self._steps = QSpinBox()
        self._steps.setRange(1, 9999)
        self._steps.setFont(tabular(self._steps.font()))
        set_help(self._steps, "Iterations of a step", "How many iterations Step makes before it holds.")
        steps = QLabel("Step by")
        steps.setBuddy(self._steps)
        self._progress = ElidingLabel()  # the more iterations, the longer: the column keeps its width
        self._progress.setFont(tabular(self._progress.font()))
        self._progress.setAccessibleName("Progress")
        self._sentence = note()
        self._sentence.setAccessibleName("Outcome")
        self._sentence.setAlignment(Qt.AlignmentFlag.AlignLeft | Qt.AlignmentFlag.AlignTop)
        # Room for it from the start: what is below does not move as a sentence comes and goes.
        self._sentence.setMinimumHeight(_LINES * self._sentence.fontMetrics().lineSpacing())

        layout = QVBoxLayout(self)
        layout.setContentsMargins(0, 0, 0, 0)
        layout.setSpacing(4)
        layout.addLayout(choice)
        layout.addWidget(self.buttons)
        foot = QHBoxLayout()
        foot.addWidget(self._progress, 1)
        foot.addWidget(steps)
        foot.addWidget(self._steps)
        layout.addLayout(foot)
        layout.addWidget(stage.help)  # below what is clicked: texts of methods differ in length
        layout.addWidget(self._sentence)
        for section in self._sections:
            layout.addWidget(section)
        layout.addStretch()
        self.set_state("idle")
        self.set_status()
        self.stage.edited.connect(self._on_edited)
        order.chosen.connect(self._on_chosen)
        order.refused.connect(self._show_problem)

    def _on_chosen(self) -> None:
        self.stage.show_order()
        self._refused = False

    def _on_edited(self) -> None:
        self._refused = self._refused and self.stage.wrong is not None

    def set_state(self, state: str) -> None:
        """Enable what makes sense in a state: "idle", "preparing", "stopping", "running", "paused" or "finished"."""
        self._state = state
        self.buttons.set_state(state, True)
        self.stage.set_enabled(STATES[state].edit)

    def set_shortcuts(self, shortcuts: Mapping[str, str]) -> None:
        """Name the keys of "run", "step", "stop" and "reset" in the tooltips; whoever owns the actions binds them."""
        self.buttons.set_shortcuts(shortcuts)

    def set_status(self, iteration: int | None = None, seconds: float | None = None, sentence: str = "") -> None:
        """Show how far a run is (seconds in the method) and, at its end, the outcome."""
        parts = [] if iteration is None else [counted(iteration, "iteration")]
        if seconds is not None:
            digits = 2 - min(len(str(int(seconds))) - 1, 2)  # three in all: there is room for no more
            parts.append(f"{seconds:.{digits}f} s")
        text = " · ".join(parts)
        self._progress.setText(text or "Not run yet")
        self._progress.setToolTip(text)
        if not self._refused:
            self._tell(sentence, MUTED)

    def _tell(self, sentence: str, role: Role) -> None:
        tint(self._sentence, role)
        self._sentence.setText(sentence)

    @property
    def steps(self) -> int:
        """Return the number of iterations in a step."""
        return self._steps.value()

    def set_steps(self, count: int) -> None:
        """Set how many iterations a step makes."""
        self._steps.setValue(count)

    def show_break_points(self) -> None:
        """Unfold what a run pauses at."""
        self._sections[-1].expand()

    def run_or_pause(self) -> None:
        """Run, pause or resume, according to the state."""
        if self._state == "running":
            self.pause_requested.emit()
        elif self._state == "paused":
            self._order.use(self._resume)
        elif STATES[self._state].run:
            self._order.use(self.run_requested.emit)

    def step(self) -> None:
        """Ask for one iteration, where the state allows it."""
        if STATES[self._state].step:
            self._order.use(self._step)

    def _resume(self, stage: Stage) -> None:
        self._change(stage)
        self.resume_requested.emit()

    def _step(self, stage: Stage) -> None:
        if self._state == "paused":
            self._change(stage)
        self.step_requested.emit(stage, self.steps)

    def _change(self, stage: Stage) -> None:
        """Tell what the rest of the run is to be done with, if that is something else."""
        if stage != self._order.begun:
            self._order.begun = stage
            self.change_requested.emit(stage)

    def _on_button(self, name: str) -> None:
        {
            "run": self.run_or_pause,
            "step": self.step,
            "stop": self.stop_requested.emit,
            "reset": self.reset_requested.emit,
        }[name]()

    def _show_problem(self) -> None:
        """Say which value is wrong, until it is so no more."""
        form = self.stage.wrong
        if form is not None:
            self._sections[(self.stage.parameters, self.stage.stop).index(form)].expand()
            form.show_problem()
            self._refused = True
            self._tell("Correct the marked value first.", WORSE)

    def showEvent(self, event: QShowEvent) -> None:
        """Unfold the parameters at first sight where there is room for them."""
        super().showEvent(event)
        if self._placed:
            return
        self._placed = True
        around = self.parentWidget()
        while around is not None and not isinstance(around, QScrollArea):
            around = around.parentWidget()
        space, whole = (self.height(), self) if around is None else (around.viewport().height(), around.widget())
        space -= whole.minimumSizeHint().height()  # what stands beside this panel counts too
        for section, form in zip(self._sections, (self.stage.parameters, self.stage.stop), strict=False):
            need = form.sizeHint().height() + _AROUND_FORM
            if need > space:
                break
            section.expand()
            space -= need
