"""Panel that sets up smoothing and shows its status: method, parameters, stopping criteria."""

from __future__ import annotations

from collections.abc import Mapping
from html import escape
from typing import Any

from PySide6.QtCore import QObject, QSignalBlocker, Qt, Signal
from PySide6.QtWidgets import QFormLayout, QHBoxLayout, QSpinBox, QVBoxLayout, QWidget

from hexmend.errors import ParameterError
from hexmend.mesh.mesh import Mesh
from hexmend.parameters import declared
from hexmend.run import StoppingCriteria
from hexmend.run.recipe import Stage
from hexmend.smoothers import METHODS
from hexmend_app.features.smooth.rule_form import RuleForm
from hexmend_app.state.run.breakpoints import Breakpoints
from hexmend_app.state.run.run_setup import RunSetup
from hexmend_app.theme.palette import MUTED, WORSE, Role
from hexmend_app.theme.spacing import fill
from hexmend_app.theme.style import labelled, set_help, small_label, tabular, tint
from hexmend_app.translation import tr
from hexmend_app.widgets.eliding_label import ElidingLabel
from hexmend_app.widgets.inputs.combo import ComboBox, let_shrink
from hexmend_app.widgets.inputs.parameter_form import ParameterForm
from hexmend_app.widgets.section import Section
from hexmend_app.widgets.wording import counted, duration

# Lines that most status sentences need at most.
_LINES = 2


class SmoothingPanel(QWidget):
    """Panel to set up a run.

    Parameters
    ----------
    setup : RunSetup
        Edited by the panel; shown when it is changed elsewhere.

    Attributes
    ----------
    stage : StageForm
    """

    def __init__(self, setup: RunSetup, parent: QWidget | None = None):
        super().__init__(parent)
        self._setup = setup
        self._refused = False

        stage = self.stage = StageForm(setup, self)
        method_row = QFormLayout()
        method_row.setFieldGrowthPolicy(QFormLayout.FieldGrowthPolicy.AllNonFixedFieldsGrow)
        method_row.addRow(tr("Method"), stage.method)
        breakpoints = ParameterForm(declared(Breakpoints), has_buttons=False)
        self.breakpoint_form, self.rule_form = breakpoints, RuleForm()
        rules = tr("Rules of motion of the nodes on interfaces and in named sets, for methods and recipes.")
        self._rules = Section(self.rule_form.title, self.rule_form, rules)
        self._rules.hide()
        self._sections = (
            Section(tr("Parameters"), stage.parameters, tr("Parameters of the method; the defaults suit most meshes.")),
            self._rules,
            Section(tr("Stop when"), stage.stop, tr("Stopping criteria of a run.")),
            Section(tr("Pause when"), self._pauses(), tr("Length of a step, and events at which a run pauses.")),
        )

        self._progress = ElidingLabel()  # keeps the width of the panel as the numbers grow
        self._progress.setFont(tabular(self._progress.font()))
        self._progress.setAccessibleName(tr("Progress"))
        self._sentence = small_label()
        self._sentence.setAccessibleName(tr("Outcome"))
        self._sentence.setAlignment(Qt.AlignmentFlag.AlignLeft | Qt.AlignmentFlag.AlignTop)
        # Reserve the height, so that nothing below moves when the sentence changes.
        self._sentence.setMinimumHeight(_LINES * self._sentence.fontMetrics().lineSpacing())

        # The height of the help depends on the method: what stands above it stays where it is.
        rows = (method_row, self._progress, self._sentence, stage.help, *self._sections)
        fill(QVBoxLayout(self), *rows, None, margins=(0, 0, 0, 0), spacing=4)
        self.set_status()
        self.stage.edited.connect(self._on_edited)
        self.rule_form.changed.connect(setup.set_rules)
        setup.chosen.connect(self._on_setup_changed)
        setup.refused.connect(self._show_problem)

    def _pauses(self) -> QWidget:
        """Return the form with the iterations of a step and the breakpoints."""
        self.steps = QSpinBox()
        self.steps.setRange(1, 9999)
        self.steps.setFont(tabular(self.steps.font()))
        set_help(self.steps, tr("Iterations per step"), tr("Number of iterations that Step runs before it pauses."))
        label = labelled(tr("Iterations per step"), self.steps)
        row = fill(QHBoxLayout(), (label, 1), self.steps, spacing=4)
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

    def set_editable(self, stage: bool, rules: bool) -> None:
        """Enable or disable editing of the stage and of the rules of motion."""
        self.stage.set_enabled(stage)
        self.rule_form.setEnabled(rules)

    def set_status(self, iteration: int | None = None, seconds: float | None = None, sentence: str = "") -> None:
        """Show the progress of a run (seconds spent in the method) and a sentence about its state or outcome."""
        parts = [] if iteration is None else [counted(iteration, "iteration")]
        if seconds is not None:
            parts.append(duration(seconds))
        text = " · ".join(parts)
        self._progress.setText(text or tr("Not run yet"))
        self._progress.setToolTip(text)
        if not self._refused:
            self._show_sentence(sentence, MUTED)

    def _show_sentence(self, sentence: str, role: Role) -> None:
        tint(self._sentence, role)
        self._sentence.setText(sentence)

    def _show_problem(self) -> None:
        """Show the first invalid value and a message until it is corrected."""
        form = self.stage.invalid_form
        if form is not None:
            self._sections[0 if form is self.stage.parameters else 2].expand()
            form.focus_problem()
            self._refused = True
            self._show_sentence(tr("Correct the marked value first."), WORSE)


class StageForm(QObject):
    """Widgets that edit a `RunSetup`; the panel lays them out.

    Parameters
    ----------
    setup : RunSetup
        Edited by the form.

    Attributes
    ----------
    method : QComboBox
    help : QLabel
        Description of the method.
    parameters, stop : ParameterForm

    Signals
    -------
    edited
        The user has changed a value, valid or not.
    """

    edited = Signal()

    def __init__(self, setup: RunSetup, parent: QObject | None = None):
        super().__init__(parent)
        self._setup = setup
        self._name = ""
        self.method = ComboBox()
        let_shrink(self.method, 14)
        set_help(self.method, tr("Method"), tr("Smoothing method, described below."))
        for method in METHODS.values():
            title, help = tr(method.title), tr(method.help)
            about = f"<b>{escape(title)}</b> ({escape(method.name)})<br>{escape(help)}"
            self.method.add(title, f"<qt>{about}<br><i>{escape(method.source)}</i></qt>", method.name)
        self.help = small_label()
        self.parameters, self.stop = ParameterForm(), ParameterForm(declared(StoppingCriteria))
        self.show_setup()
        self.method.activated.connect(self._on_method)
        for form in (self.parameters, self.stop):
            form.changed.connect(self._on_edited)

    def show_setup(self) -> None:
        """Show the stage of the setup without sending a signal."""
        stage = self._setup.stage
        self._show_method(stage.smoother.name, stage.smoother.values())
        with QSignalBlocker(self.stop):
            self.stop.set_values(stage.stop.values())

    def set_enabled(self, on: bool) -> None:
        """Enable or disable editing."""
        for widget in (self.method, self.parameters, self.stop):
            widget.setEnabled(on)

    @property
    def invalid_form(self) -> ParameterForm | None:
        """First form with an invalid value; None if all values are valid."""
        return next((form for form in (self.parameters, self.stop) if form.problems()), None)

    def _show_method(self, name: str, values: Mapping[str, Any] | None = None) -> None:
        """Show a method with its last values, updated by `values`; choices, such as the goal, are above numbers."""
        method = METHODS[name]
        self._name = name
        self.method.setCurrentIndex(self.method.findData(name))
        self.help.setText(tr(method.help))
        self.help.setToolTip(tr("Source: {source}", source=method.source) if method.source else "")
        with QSignalBlocker(self.parameters):
            self.parameters.set_declarations(sorted(declared(method), key=lambda one: one.choices is None))
            self.parameters.set_values(self._setup.values_of(name) | dict(values or {}))

    def _on_method(self) -> None:
        if self.method.currentData() != self._name:
            self._show_method(self.method.currentData())
            self._on_edited()

    def _on_edited(self, *_: object) -> None:
        self.edited.emit()
        self._setup.set(self._name, self.parameters.values(), self._stage())

    def _stage(self) -> Stage | None:
        """Return the stage set in the forms; None while a value is invalid."""
        if self.invalid_form is not None:
            return None
        try:
            return Stage(METHODS[self._name](**self.parameters.values()), StoppingCriteria(**self.stop.values()))
        except ParameterError:
            return None
