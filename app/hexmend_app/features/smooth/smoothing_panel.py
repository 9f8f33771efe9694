"""Panel that sets up, runs and pauses smoothing: method, parameters, stopping criteria, buttons and status."""

from __future__ import annotations

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import QFormLayout, QHBoxLayout, QSpinBox, QVBoxLayout, QWidget

from hexmend.mesh.mesh import Mesh
from hexmend.run.recipe import Stage
from hexmend_app.features.smooth.breakpoint_form import BreakpointForm
from hexmend_app.features.smooth.rule_form import RuleForm
from hexmend_app.features.smooth.run_buttons import STATES, RunButtons
from hexmend_app.features.smooth.stage_form import StageForm
from hexmend_app.state.run.run_setup import RunSetup
from hexmend_app.theme.palette import MUTED, WORSE, Role
from hexmend_app.theme.spacing import fill
from hexmend_app.theme.style import labelled, note, set_help, tabular, tint
from hexmend_app.translation import tr
from hexmend_app.widgets.eliding_label import ElidingLabel
from hexmend_app.widgets.section import Section
from hexmend_app.widgets.wording import counted

# Lines that most status sentences need at most.
_LINES = 2


class SmoothingPanel(QWidget):
    """Panel to set up a method and to run it.

    Signals
    -------
    run_requested(Stage), step_requested(Stage, iterations)
        Not sent while a value is invalid.
    change_requested(Stage)
        Sent before a paused run is resumed with other settings.
    pause_requested, resume_requested

    Parameters
    ----------
    setup : RunSetup
        Edited by the panel; shown when it is changed elsewhere.

    Attributes
    ----------
    stage : StageForm
    """

    run_requested = Signal(object)
    step_requested = Signal(object, int)
    change_requested = Signal(object)
    pause_requested = Signal()
    resume_requested = Signal()

    def __init__(self, setup: RunSetup, parent: QWidget | None = None):
        super().__init__(parent)
        self._setup = setup
        self._refused = False
        self._state = "idle"

        stage = self.stage = StageForm(setup, self)
        method_row = QFormLayout()
        method_row.setFieldGrowthPolicy(QFormLayout.FieldGrowthPolicy.AllNonFixedFieldsGrow)
        method_row.addRow(tr("Method"), stage.method)

        self.breakpoint_form, self.rule_form = BreakpointForm(), RuleForm()
        rules = tr("Rules of motion of the nodes on interfaces and in named sets, for methods and recipes.")
        self._rules = Section(self.rule_form.title, self.rule_form, rules)
        self._rules.hide()
        self._sections = (
            Section(tr("Parameters"), stage.parameters, tr("Parameters of the method; the defaults suit most meshes.")),
            self._rules,
            Section(tr("Stop when"), stage.stop, tr("Stopping criteria of a run.")),
            Section(tr("Pause when"), self._pauses(), tr("Length of a step, and events at which a run pauses.")),
        )
        self.buttons = RunButtons()

        self._progress = ElidingLabel()  # keeps the width of the panel as the numbers grow
        self._progress.setFont(tabular(self._progress.font()))
        self._progress.setAccessibleName(tr("Progress"))
        self._sentence = note()
        self._sentence.setAccessibleName(tr("Outcome"))
        self._sentence.setAlignment(Qt.AlignmentFlag.AlignLeft | Qt.AlignmentFlag.AlignTop)
        # Reserve the height, so that nothing below moves when the sentence changes.
        self._sentence.setMinimumHeight(_LINES * self._sentence.fontMetrics().lineSpacing())

        # The height of the help depends on the method: what stands above it stays where it is.
        rows = (method_row, self.buttons, self._progress, self._sentence, stage.help, *self._sections)
        fill(QVBoxLayout(self), *rows, None, margins=(0, 0, 0, 0), spacing=4)
        self.set_state("idle")
        self.set_status()
        self.stage.edited.connect(self._on_edited)
        self.rule_form.changed.connect(setup.set_rules)
        setup.chosen.connect(self._on_setup_changed)
        setup.refused.connect(self._show_problem)

    def _pauses(self) -> QWidget:
        """Return the form with the iterations of a step and the breakpoints."""
        self._steps = QSpinBox()
        self._steps.setRange(1, 9999)
        self._steps.setFont(tabular(self._steps.font()))
        set_help(self._steps, tr("Iterations per step"), tr("Number of iterations that Step runs before it pauses."))
        label = labelled(tr("Iterations per step"), self._steps)
        row = fill(QHBoxLayout(), (label, 1), self._steps, spacing=4)
        form = QWidget()
        fill(QVBoxLayout(form), row, self.breakpoint_form, margins=(0, 0, 0, 0), spacing=4)
        return form

    def show_rules(self, mesh: Mesh) -> None:
        """Show the rules of motion of the set-up for the sets of a mesh; hide the form if there is nothing to rule."""
        self.rule_form.show_rules(mesh, self._setup.rules)
        self._rules.setText(self.rule_form.title)
        self._rules.setVisible(self.rule_form.offered)

    def _on_setup_changed(self) -> None:
        self.stage.show_setup()
        self._refused = False

    def _on_edited(self) -> None:
        self._refused = self._refused and self.stage.invalid_form is not None

    def set_state(self, state: str) -> None:
        """Enable the controls of a state: "idle", "preparing", "stopping", "running", "paused" or "finished"."""
        self._state = state
        self.stage.set_enabled(STATES[state].edit)
        self.rule_form.setEnabled(STATES[state].edit and state != "paused")  # a run keeps its rules

    def set_status(self, iteration: int | None = None, seconds: float | None = None, sentence: str = "") -> None:
        """Show the progress of a run (seconds spent in the method) and a sentence about its state or outcome."""
        parts = [] if iteration is None else [counted(iteration, "iteration")]
        if seconds is not None:
            digits = 2 - min(len(str(int(seconds))) - 1, 2)  # three digits in all
            parts.append(f"{seconds:.{digits}f} s")
        text = " · ".join(parts)
        self._progress.setText(text or tr("Not run yet"))
        self._progress.setToolTip(text)
        if not self._refused:
            self._show_sentence(sentence, MUTED)

    def _show_sentence(self, sentence: str, role: Role) -> None:
        tint(self._sentence, role)
        self._sentence.setText(sentence)

    @property
    def steps(self) -> int:
        """Number of iterations per step."""
        return self._steps.value()

    def set_steps(self, count: int) -> None:
        """Set the number of iterations per step."""
        self._steps.setValue(count)

    def run_or_pause(self) -> None:
        """Run, pause or resume, depending on the state."""
        if self._state == "running":
            self.pause_requested.emit()
        elif self._state == "paused":
            self._setup.use(self._resume)
        elif STATES[self._state].run:
            self._setup.use(self.run_requested.emit)

    def step(self) -> None:
        """Request a step if the state allows it."""
        if STATES[self._state].step:
            self._setup.use(self._step)

    def _resume(self, stage: Stage) -> None:
        self._change(stage)
        self.resume_requested.emit()

    def _step(self, stage: Stage) -> None:
        if self._state == "paused":
            self._change(stage)
        self.step_requested.emit(stage, self.steps)

    def _change(self, stage: Stage) -> None:
        """Request the rest of the run with `stage` if it differs from the active one."""
        if stage != self._setup.active_stage:
            self._setup.active_stage = stage
            self.change_requested.emit(stage)

    def _show_problem(self) -> None:
        """Show the first invalid value and a message until it is corrected."""
        form = self.stage.invalid_form
        if form is not None:
            self._sections[0 if form is self.stage.parameters else 2].expand()
            form.show_problem()
            self._refused = True
            self._show_sentence(tr("Correct the marked value first."), WORSE)
