"""Form of a stage: the method, its parameters and its stopping criteria."""

from __future__ import annotations

from collections.abc import Mapping
from html import escape
from typing import Any

from PySide6.QtCore import QObject, QSignalBlocker, Qt, Signal

from hexmend.errors import ParameterError
from hexmend.parameters import declared
from hexmend.run import StoppingCriteria
from hexmend.run.recipe import Stage
from hexmend.smoothers import METHODS
from hexmend_app.state.run.run_setup import RunSetup
from hexmend_app.theme.style import note, set_help
from hexmend_app.translation import tr
from hexmend_app.widgets.inputs.combo import ComboBox, let_shrink
from hexmend_app.widgets.inputs.parameter_form import ParameterForm


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
        for at, method in enumerate(METHODS.values()):
            self.method.addItem(tr(method.title), method.name)
            title, help = tr(method.title), tr(method.help)
            about = f"<b>{escape(title)}</b> ({escape(method.name)})<br>{escape(help)}"
            tip = f"<qt>{about}<br><i>{escape(method.source)}</i></qt>"
            self.method.setItemData(at, tip, Qt.ItemDataRole.ToolTipRole)
        self.help = note()
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
