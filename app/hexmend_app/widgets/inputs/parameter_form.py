"""Form built from declared parameters."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from html import escape
from itertools import pairwise
from typing import Any

import shiboken6
from PySide6.QtCore import Qt, Signal
from PySide6.QtGui import QFontMetrics
from PySide6.QtWidgets import QGridLayout, QHBoxLayout, QLabel, QSizePolicy, QToolButton, QVBoxLayout, QWidget

from hexmend.errors import ParameterError
from hexmend.parameters import Parameter
from hexmend_app.theme.palette import BLUE, WORSE
from hexmend_app.theme.spacing import fill
from hexmend_app.theme.style import bold, note, set_help, show_text, tool_button
from hexmend_app.translation import tr
from hexmend_app.widgets.inputs.editors import Editor, editor_for
from hexmend_app.widgets.inputs.number_box import LONGEST_UNIT, NumberBox
from hexmend_app.widgets.wording import label_of, range_of, short_number


@dataclass(frozen=True)
class _Row:
    """Widgets of a parameter: label, editor, reset button, and labels for errors and help."""

    declaration: Parameter
    label: QLabel
    editor: Editor
    reset: QToolButton
    problem: QLabel
    help: QLabel

    def refresh(self) -> None:
        modified = self.editor.value() != self.declaration.default
        font = self.label.font()
        font.setBold(modified)
        self.label.setFont(font)
        self.reset.setVisible(modified)
        show_text(self.problem, self.editor.problem)

    @property
    def is_needed(self) -> bool:
        """True if the row is always shown: it is basic, or its value differs from the default or is invalid."""
        modified = self.editor.value() != self.declaration.default
        return not self.declaration.advanced or modified or bool(self.editor.problem)

    def show(self, on: bool, with_help: bool) -> None:
        """Show or hide all widgets of the row."""
        for widget in (self.label, self.editor):
            widget.setVisible(on)
        # Keep the space of the hidden button, so that editors do not change width.
        policy = self.reset.sizePolicy()
        policy.setRetainSizeWhenHidden(on)
        self.reset.setSizePolicy(policy)
        self.reset.setVisible(on and self.editor.value() != self.declaration.default)
        self.problem.setVisible(on and bool(self.editor.problem))
        self.help.setVisible(on and with_help)


class ParameterForm(QWidget):
    """Form that edits the values of declared parameters, one row each.

    The help of a parameter is its tooltip; a button below the rows shows the help of all parameters. A value that
    differs from its default has a bold label and a reset button. Advanced parameters are shown on request, or if they
    differ from their defaults.

    Parameters
    ----------
    declarations : iterable of Parameter
        Declarations from `hexmend.parameters.declared`.

    Attributes
    ----------
    rows : dict
        Widgets of each parameter by name: label, editor, reset, problem and help.
    none : QLabel
        Shown if there are no parameters.

    Signals
    -------
    changed
        The user changed a value, or its text became invalid or valid. Setters do not emit it.
    """

    changed = Signal()

    def __init__(self, declarations: Iterable[Parameter] = (), parent: QWidget | None = None):
        super().__init__(parent)
        self.rows: dict[str, _Row] = {}
        self._grid = QGridLayout()
        self._grid.setHorizontalSpacing(8)
        self._grid.setVerticalSpacing(4)
        self._grid.setColumnStretch(0, 1)
        self._grid.setColumnStretch(1, 1)
        self.none = note(tr("No parameters."))
        self._defaults = self._button(tr("Defaults"), "restore", tr("Reset all parameters to their defaults."), False)
        self._defaults.clicked.connect(lambda: self._reset(self.rows.values()))
        explain = tr("Show the help of each parameter.")
        self._explain = self._button(tr("Explain"), "help-circle-outline", explain, False)
        self._explain.setCheckable(True)
        self._explain.toggled.connect(self._show_rows)
        self._advanced = self._button(tr("Advanced"), "tune-variant", tr("Show the advanced parameters as well."))
        self._advanced.setCheckable(True)
        self._advanced.toggled.connect(self._show_rows)
        foot = fill(QHBoxLayout(), self._advanced, None, self._explain, self._defaults)
        fill(QVBoxLayout(self), self._grid, self.none, foot, margins=(0, 0, 0, 0))
        self.set_declarations(declarations)

    @staticmethod
    def _button(text: str, icon_name: str, help: str, with_text: bool = True) -> QToolButton:
        button = tool_button(icon_name)
        button.setText(text)
        style = Qt.ToolButtonStyle
        button.setToolButtonStyle(style.ToolButtonTextBesideIcon if with_text else style.ToolButtonIconOnly)
        set_help(button, text, help)
        return button

    def set_declarations(self, declarations: Iterable[Parameter]) -> None:
        """Replace the rows by other parameters at their defaults, the advanced ones last.

        Not to be called from a signal of an editor.
        """
        declarations = sorted(declarations, key=lambda declaration: declaration.advanced)
        if declarations and declarations == [row.declaration for row in self.rows.values()]:  # creating rows is slow
            self.set_values({declaration.name: declaration.default for declaration in declarations})
            return
        while (item := self._grid.takeAt(0)) is not None:
            # At once: `deleteLater` takes effect only when the event loop that created the rows continues.
            shiboken6.delete(item.widget())
        before = self._advanced.previousInFocusChain()
        self.rows = {d.name: self._make_row(3 * i, d) for i, d in enumerate(declarations)}
        # Qt appends new widgets to the tab order of the whole window.
        parts = [part for row in self.rows.values() for part in (row.editor, row.reset)]
        for previous, following in pairwise([before, *parts, self._advanced, self._explain, self._defaults]):
            self.setTabOrder(previous, following)
        self.none.setVisible(not self.rows)
        self._explain.setVisible(bool(self.rows))
        self._defaults.setVisible(bool(self.rows))
        self._advanced.setVisible(any(row.declaration.advanced for row in self.rows.values()))
        self._refresh()
        self._show_rows()

    def _make_row(self, at: int, declaration: Parameter) -> _Row:
        name, help = label_of(declaration), tr(declaration.help)
        editor = editor_for(declaration)
        default = declaration.default
        shown = _default_text(default)
        expected = tr("{range}; default {default}.", range=range_of(declaration), default=shown)
        if isinstance(default, bool):
            expected = tr("On by default.") if default else tr("Off by default.")
        tip = f"{escape(help)}<br><i>{escape(expected)}</i>"
        set_help(editor, name, tip)
        editor.setAccessibleDescription(help)
        label = QLabel(name)
        if isinstance(editor, NumberBox) and len(declaration.unit) > LONGEST_UNIT:
            label.setText(f"{escape(name)}<br><small>{escape(tr(declaration.unit))}</small>")
        label.setWordWrap(True)
        label.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Preferred)
        label.setMinimumWidth(_longest_word_width(label, name))
        label.setBuddy(editor)
        label.setToolTip(editor.toolTip())
        reset = tool_button("restore", BLUE)
        set_help(reset, tr("Reset {name}", name=name), tr("Reset to the default, {default}.", default=escape(shown)))
        row = _Row(declaration, label, editor, reset, note("", WORSE), note(help))
        editor.changed.connect(self._on_changed)
        reset.clicked.connect(lambda: self._reset([row]))
        self._grid.addWidget(label, at, 0)
        self._grid.addWidget(editor, at, 1)
        self._grid.addWidget(reset, at, 2)
        self._grid.addWidget(row.problem, at + 1, 0, 1, 3)
        self._grid.addWidget(row.help, at + 2, 0, 1, 3)
        return row

    def values(self) -> dict[str, Any]:
        """Return the values by name; of an invalid text, the value from before editing."""
        return {name: row.editor.value() for name, row in self.rows.items()}

    def set_values(self, values: Mapping[str, Any]) -> None:
        """Show values, without a signal; parameters that are not named keep their values.

        Raises
        ------
        ParameterError
            If a name is unknown or a value is invalid.
        """
        for name, value in values.items():
            if name not in self.rows:
                raise ParameterError(f"there is no parameter {name!r}: known are {', '.join(self.rows) or 'none'}")
            self.rows[name].editor.set_value(value)
        self._refresh()
        self._show_rows()

    def editor(self, name: str) -> Editor:
        """Return the editor of a parameter."""
        return self.rows[name].editor

    def problems(self) -> dict[str, str]:
        """Return the problems by parameter; empty if there are none."""
        return {name: row.editor.problem for name, row in self.rows.items() if row.editor.problem}

    def show_problem(self) -> None:
        """Focus the editor of the first invalid value."""
        self._show_rows()
        for name in self.problems():
            self.rows[name].editor.setFocus(Qt.FocusReason.OtherFocusReason)
            return

    def _reset(self, rows: Iterable[_Row]) -> None:
        for row in rows:
            row.editor.set_value(row.declaration.default)
            if row.reset.hasFocus():
                row.editor.setFocus()
        self._on_changed()

    def _on_changed(self) -> None:
        self._refresh()
        self.changed.emit()

    def _refresh(self) -> None:
        for row in self.rows.values():
            row.refresh()
        modified = any(row.editor.value() != row.declaration.default for row in self.rows.values())
        self._defaults.setEnabled(modified or bool(self.problems()))

    def _show_rows(self) -> None:
        everything, with_help = self._advanced.isChecked(), self._explain.isChecked()
        for row in self.rows.values():
            row.show(everything or row.is_needed, with_help)


def _longest_word_width(label: QLabel, text: str) -> int:
    """Return the minimum width of a wrapped text in bold, in pixels."""
    label.ensurePolished()
    metrics = QFontMetrics(bold(label.font()))
    return max(metrics.horizontalAdvance(word) for word in text.split()) + 2


def _default_text(default: object) -> str:
    if isinstance(default, bool):
        return tr("on") if default else tr("off")
    return short_number(default) if isinstance(default, float) else str(default)
