"""The panel from which smoothing is started and held: method, parameters, stop conditions, buttons, status."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from html import escape
from typing import Any

from PySide6.QtCore import Qt, Signal
from PySide6.QtGui import QShowEvent
from PySide6.QtWidgets import (
    QComboBox,
    QFormLayout,
    QHBoxLayout,
    QLabel,
    QScrollArea,
    QSpinBox,
    QVBoxLayout,
    QWidget,
)

from hexmend.parameters import Parameter
from hexmend_app.features.recipe.recipe_panel import RecipePanel
from hexmend_app.features.smooth.breakpoint_form import BreakpointForm
from hexmend_app.features.smooth.run_buttons import STATES, RunButtons
from hexmend_app.widgets.parameter_form import ParameterForm
from hexmend_app.widgets.section import Section
from hexmend_app.widgets.style import MUTED, WORSE, explain, note, tabular, tint
from hexmend_app.widgets.wording import counted

# Height of a section's margins, and of names that take two lines in a narrow panel.
_AROUND_FORM = 24


class SmoothingPanel(QWidget):
    """Chooses a method and its values, and asks for it to be run.

    Signals
    -------
    run_requested(name, values, stop_values), step_requested(name, values, stop_values, iterations)
        str, dict, dict, int; not sent while a value is wrong.
    change_requested(name, values, stop_values)
        Before a paused run goes on: the rest of it is to be done with what was set meanwhile.
    pause_requested, resume_requested, stop_requested, reset_requested
    method_changed(name)
        The user chose another method.
    """

    run_requested = Signal(str, dict, dict)
    step_requested = Signal(str, dict, dict, int)
    change_requested = Signal(str, dict, dict)
    pause_requested = Signal()
    resume_requested = Signal()
    stop_requested = Signal()
    reset_requested = Signal()
    method_changed = Signal(str)

    def __init__(self, stop_conditions: Iterable[Parameter] = (), parent: QWidget | None = None):
        super().__init__(parent)
        self._methods: dict[str, tuple] = {}
        self._edited: dict[str, dict[str, Any]] = {}  # what was set for each method, to find it again on return
        self._name = ""
        self._state = "idle"
        self._begun: tuple | None = None  # what the run has been begun with
        self._placed = False

        self._method = QComboBox()
        self._method.setSizeAdjustPolicy(QComboBox.SizeAdjustPolicy.AdjustToMinimumContentsLengthWithIcon)
        self._method.setMinimumContentsLength(14)
        self._method.activated.connect(self._on_method)
        explain(self._method, "Method", "How nodes are moved; the line below says what the chosen method does.")
        choice = QFormLayout()
        choice.setFieldGrowthPolicy(QFormLayout.FieldGrowthPolicy.AllNonFixedFieldsGrow)
        choice.addRow("Method", self._method)
        self._help = note()

        self.form = ParameterForm()
        self.stop_form = ParameterForm(stop_conditions)
        self.breakpoint_form = BreakpointForm()
        self.recipe_panel = RecipePanel()
        self._sections = (
            Section("Parameters", self.form, "How the method goes about it; the defaults suit most meshes."),
            Section("Stop when", self.stop_form, "When a run ends by itself."),
            Section("Recipe", self.recipe_panel, "Methods that are run one after another, as one run."),
            Section("Pause when", self.breakpoint_form, "Break-points: what a run pauses at, to be looked at."),
        )
        self.buttons = RunButtons()
        self.buttons.pressed.connect(self._on_button)

        self._steps = QSpinBox()
        self._steps.setRange(1, 9999)
        self._steps.setFont(tabular(self._steps.font()))
        explain(self._steps, "Iterations of a step", "How many iterations Step makes before it holds.")
        steps = QLabel("Step by")
        steps.setBuddy(self._steps)
        self._progress = QLabel()
        self._progress.setFont(tabular(self._progress.font()))
        self._progress.setAccessibleName("Progress")
        self._sentence = note()
        self._sentence.setAccessibleName("Outcome")

        layout = QVBoxLayout(self)
        layout.addLayout(choice)
        layout.addWidget(self._help)
        layout.addWidget(self.buttons)
        foot = QHBoxLayout()
        foot.addWidget(self._progress, 1)
        foot.addWidget(steps)
        foot.addWidget(self._steps)
        layout.addLayout(foot)
        layout.addWidget(self._sentence)
        for section in self._sections:
            layout.addWidget(section)
        layout.addStretch()
        self.set_state("idle")
        self.set_status()

    def set_methods(self, methods: Iterable[tuple[str, str, str, str, Iterable[Parameter]]]) -> None:
        """Offer methods, each (name, title, help, source, declared parameters), and choose the first."""
        self._methods = {method[0]: method for method in methods}
        self._method.clear()
        for at, (name, title, help, source, _) in enumerate(self._methods.values()):
            self._method.addItem(title, name)
            tip = f"<qt><b>{escape(title)}</b> ({escape(name)})<br>{escape(help)}<br><i>{escape(source)}</i></qt>"
            self._method.setItemData(at, tip, Qt.ItemDataRole.ToolTipRole)
        self._edited.clear()
        self._name = ""
        if self._methods:
            self.set_method(next(iter(self._methods)))
        self.set_state(self._state)

    def set_method(self, name: str, values: Mapping[str, Any] | None = None) -> None:
        """Show a method, with what was last set for it or with `values`; without a signal.

        Raises
        ------
        KeyError
            Where the method is not offered.
        """
        _, _, help, source, declarations = self._methods[name]
        if self._name:
            self._edited[self._name] = self.form.values()
        self._name = name
        self._method.setCurrentIndex(self._method.findData(name))
        self._help.setText(f"{help}\nSource: {source}" if source else help)
        self.form.set_declarations(declarations)
        self.form.set_values(self._edited.get(name, {}) | dict(values or {}))

    def choose(self, name: str, values: Mapping[str, Any], stop_values: Mapping[str, Any]) -> None:
        """Show a method, its values and the stop conditions; without a signal."""
        self.set_method(name, values)
        self.stop_form.set_values(stop_values)

    def show_at_work(self, name: str, values: Mapping[str, Any], stop_values: Mapping[str, Any]) -> None:
        """Show what the run is at: only what is set otherwise from now on is a change of it."""
        self.choose(name, values, stop_values)
        self._begun = self._order()

    def tell(self, sentence: str) -> None:
        """Say something below the buttons, beside how far the run is."""
        tint(self._sentence, MUTED)
        self._sentence.setText(sentence)
        self._sentence.setVisible(bool(sentence))

    def method(self) -> str:
        """Name of the method shown, "" where none is."""
        return self._name

    def values_of(self, method: str) -> dict[str, Any]:
        """What was last set for a method; empty where nothing was."""
        return self.form.values() if method == self._name else dict(self._edited.get(method, {}))

    def set_state(self, state: str) -> None:
        """Enable what makes sense in a state: "idle", "preparing", "stopping", "running", "paused" or "finished"."""
        if state == "preparing" and state != self._state:
            self._begun = self._order()
        self._state = state
        some = bool(self._methods)
        self.buttons.set_state(state, some)
        for part in (self._method, self.form, self.stop_form):
            part.setEnabled(some and STATES[state].edit)

    def set_shortcuts(self, shortcuts: Mapping[str, str]) -> None:
        """Name the keys of "run", "step", "stop" and "reset" in the tooltips; whoever owns the actions binds them."""
        self.buttons.set_shortcuts(shortcuts)

    def set_status(self, iteration: int | None = None, seconds: float | None = None, sentence: str = "") -> None:
        """Show how far a run is (seconds in the method) and, at its end, the outcome."""
        parts = [] if iteration is None else [counted(iteration, "iteration")]
        if seconds is not None:
            parts.append(f"{seconds:.2f} s")
        self._progress.setText("  ·  ".join(parts) or "Not run yet")
        self.tell(sentence)

    def show_break_points(self) -> None:
        """Unfold what a run pauses at."""
        self._sections[-1].expand()

    def run_or_pause(self) -> None:
        """What the main button does: run, pause or resume, as the state has it."""
        if self._state == "running":
            self.pause_requested.emit()
        elif self._state == "paused":
            self.request(self._resume)
        elif STATES[self._state].run:
            self.request(self.run_requested.emit)

    def step(self) -> None:
        """Ask for one iteration, where the state allows it."""
        if STATES[self._state].step:
            self.request(self._step)

    def _resume(self, *order: object) -> None:
        self._change(order)
        self.resume_requested.emit()

    def _step(self, *order: object) -> None:
        if self._state == "paused":
            self._change(order)
        self.step_requested.emit(*order, self._steps.value())

    def _change(self, order: tuple) -> None:
        """Tell what the rest of the run is to be done with, if that is something else."""
        if order != self._begun:
            self._begun = order
            self.change_requested.emit(*order)

    def _order(self) -> tuple:
        return self._name, self.form.values(), self.stop_form.values()

    def _on_button(self, name: str) -> None:
        {
            "run": self.run_or_pause,
            "step": self.step,
            "stop": self.stop_requested.emit,
            "reset": self.reset_requested.emit,
        }[name]()

    def request(self, ask: Callable[[str, dict, dict], object]) -> None:
        """Call `ask` with the method, its values and the stop conditions, unless a value is wrong: then say which."""
        if not self._methods:
            return
        for form, section in zip((self.form, self.stop_form), self._sections, strict=False):
            if form.problems():
                section.expand()
                form.show_problem()
                tint(self._sentence, WORSE)
                self._sentence.setText("Correct the marked value first.")
                self._sentence.setVisible(True)
                return
        ask(*self._order())

    def _on_method(self) -> None:
        name = self._method.currentData()
        if name != self._name:
            self.set_method(name)
            self.method_changed.emit(name)

    def showEvent(self, event: QShowEvent) -> None:
        """Unfold the parameters at first sight where there is room for them."""
        super().showEvent(event)
        if self._placed:
            return
        self._placed = True
        around = self.parentWidget()
        while around is not None and not isinstance(around, QScrollArea):
            around = around.parentWidget()
        room, whole = (self.height(), self) if around is None else (around.viewport().height(), around.widget())
        room -= whole.minimumSizeHint().height()  # what stands beside this panel counts too
        for section, form in zip(self._sections, (self.form, self.stop_form), strict=False):
            need = form.sizeHint().height() + _AROUND_FORM
            if need <= room:
                section.expand()
                room -= need
