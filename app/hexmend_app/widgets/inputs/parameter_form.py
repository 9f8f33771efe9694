"""Form built from declared parameters."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from html import escape
from itertools import pairwise
from typing import Any

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import QFormLayout, QHBoxLayout, QLabel, QToolButton, QVBoxLayout, QWidget

from hexmend.errors import ParameterError
from hexmend.parameters import Parameter
from hexmend_app.theme.palette import WORSE
from hexmend_app.theme.spacing import fill
from hexmend_app.theme.style import bold, labelled, set_help, show_text, small_label, tool_button
from hexmend_app.translation import tr
from hexmend_app.widgets.inputs.editors import Editor, editor_for
from hexmend_app.widgets.wording import label_of, short_number


class ParameterForm(QWidget):
    """Form that edits the values of declared parameters, one row each.

    The help of a parameter is its tooltip. A value that differs from its default has a bold label. Advanced parameters
    are shown on request, or if they differ from their defaults. The first problem is explained below the rows.

    Parameters
    ----------
    declarations : iterable of Parameter
        Declarations from `hexmend.parameters.declared`.
    has_buttons : bool
        False for a form without the buttons that reset all parameters and show the advanced ones.

    Attributes
    ----------
    editors : dict
        Editor of each parameter by name.

    Signals
    -------
    changed
        The user changed a value, or its text became invalid or valid. Setters do not emit it.
    """

    changed = Signal()

    def __init__(self, declarations: Iterable[Parameter] = (), has_buttons: bool = True, parent: QWidget | None = None):
        super().__init__(parent)
        self._declarations: dict[str, Parameter] = {}
        self.editors: dict[str, Editor] = {}
        self._labels: dict[str, QLabel] = {}
        self._rows = QFormLayout()
        self._rows.setHorizontalSpacing(8)
        self._rows.setVerticalSpacing(4)
        self._rows.setLabelAlignment(Qt.AlignmentFlag.AlignLeft | Qt.AlignmentFlag.AlignVCenter)
        self._rows.setFieldGrowthPolicy(QFormLayout.FieldGrowthPolicy.AllNonFixedFieldsGrow)
        self._none = small_label(tr("No parameters."))
        self._problem = small_label("", WORSE)
        self._defaults = self._button(tr("Defaults"), "restore", tr("Reset all parameters to their defaults."))
        self._defaults.clicked.connect(self._reset)
        self._advanced = self._button(tr("Advanced"), "tune-variant", tr("Show the advanced parameters as well."))
        self._advanced.setToolButtonStyle(Qt.ToolButtonStyle.ToolButtonTextBesideIcon)
        self._advanced.setCheckable(True)
        self._advanced.toggled.connect(self._refresh)
        foot = QWidget()
        fill(QHBoxLayout(foot), self._advanced, None, self._defaults, margins=(0, 0, 0, 0))
        foot.setVisible(has_buttons)
        fill(QVBoxLayout(self), self._rows, self._none, self._problem, foot, margins=(0, 0, 0, 0), spacing=4)
        self.set_declarations(declarations)

    @staticmethod
    def _button(text: str, icon_name: str, help: str) -> QToolButton:
        button = tool_button(icon_name)
        button.setText(text)
        set_help(button, text, help)
        return button

    def set_declarations(self, declarations: Iterable[Parameter]) -> None:
        """Replace the rows by other parameters at their defaults, the advanced ones last.

        Not to be called from a signal of an editor.
        """
        declared = {one.name: one for one in sorted(declarations, key=lambda declaration: declaration.advanced)}
        if declared and declared == self._declarations:  # creating rows is slow
            self.set_values({name: one.default for name, one in declared.items()})
            return
        while self._rows.rowCount():
            self._rows.removeRow(0)
        self._declarations = declared
        self.editors, self._labels = {}, {}
        before = self._advanced.previousInFocusChain()
        while not before.focusPolicy() & Qt.FocusPolicy.TabFocus:  # setTabOrder ignores other widgets
            before = before.previousInFocusChain()
        for declaration in declared.values():
            self._add_row(declaration)
        # Qt appends new widgets to the tab order of the whole window.
        for previous, following in pairwise([before, *self.editors.values(), self._advanced, self._defaults]):
            self.setTabOrder(previous, following)
        self._none.setVisible(not declared)
        self._defaults.setVisible(bool(declared))
        self._advanced.setVisible(any(one.advanced for one in declared.values()))
        self._refresh()

    def _add_row(self, declaration: Parameter) -> None:
        name, help = label_of(declaration), tr(declaration.help)
        editor = editor_for(declaration)
        default = declaration.default
        expected = tr("Expected {range}; default {default}.", range=declaration.range, default=_default_text(default))
        if isinstance(default, bool):
            expected = tr("On by default.") if default else tr("Off by default.")
        set_help(editor, name, escape(help) if default == "" else f"{escape(help)}<br><i>{escape(expected)}</i>")
        editor.setAccessibleDescription(help)
        editor.changed.connect(self._on_changed)
        unit = f" <small>({escape(tr(declaration.unit))})</small>" if declaration.unit else ""
        label = labelled(escape(name) + unit, editor)
        label.setWordWrap(True)
        label.setToolTip(editor.toolTip())
        self._rows.addRow(label, editor)
        self.editors[declaration.name], self._labels[declaration.name] = editor, label

    def values(self) -> dict[str, Any]:
        """Return the values by name; of an invalid text, the value from before editing."""
        return {name: editor.value() for name, editor in self.editors.items()}

    def set_values(self, values: Mapping[str, Any]) -> None:
        """Show values, without a signal; parameters that are not named keep their values.

        Raises
        ------
        ParameterError
            If a name is unknown or a value is invalid.
        """
        for name, value in values.items():
            if name not in self.editors:
                raise ParameterError(f"there is no parameter {name!r}: known are {', '.join(self.editors) or 'none'}")
            self.editors[name].set_value(value)
        self._refresh()

    def problems(self) -> dict[str, str]:
        """Return the problems by parameter; empty if there are none."""
        return {name: editor.problem for name, editor in self.editors.items() if editor.problem}

    def problem_text(self) -> str:
        """Return the first problem as text; "" if there is none."""
        return next((f"{label_of(self._declarations[name])}: {text}" for name, text in self.problems().items()), "")

    def focus_problem(self) -> None:
        """Focus the editor of the first invalid value."""
        self._refresh()
        for name in self.problems():
            self.editors[name].setFocus(Qt.FocusReason.OtherFocusReason)
            return

    def _reset(self) -> None:
        for name, editor in self.editors.items():
            editor.set_value(self._declarations[name].default)
        self._on_changed()

    def _on_changed(self) -> None:
        self._refresh()
        self.changed.emit()

    def _refresh(self) -> None:
        """Mark the values that differ from their defaults, show the rows that are needed, and the problem."""
        modified = {name for name, editor in self.editors.items() if editor.value() != self._declarations[name].default}
        for name, label in self._labels.items():
            label.setFont(bold(label.font(), name in modified))
            is_needed = not self._declarations[name].advanced or name in modified or bool(self.editors[name].problem)
            self._rows.setRowVisible(self.editors[name], is_needed or self._advanced.isChecked())
        self._defaults.setEnabled(bool(modified or self.problems()))
        show_text(self._problem, self.problem_text())


def _default_text(default: object) -> str:
    if isinstance(default, bool):
        return tr("on") if default else tr("off")
    return short_number(default) if isinstance(default, float) else str(default)
