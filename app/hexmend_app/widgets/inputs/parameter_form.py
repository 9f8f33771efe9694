"""A form made from declared parameters."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from html import escape
from itertools import pairwise
from typing import Any

import shiboken6
from PySide6.QtCore import Qt, Signal
from PySide6.QtGui import QFont, QFontMetrics
from PySide6.QtWidgets import QGridLayout, QHBoxLayout, QLabel, QSizePolicy, QToolButton, QVBoxLayout, QWidget

from hexmend.errors import ParameterError
from hexmend.parameters import Parameter
from hexmend_app.theme.style import BLUE, WORSE, icon, note, set_help
from hexmend_app.widgets.inputs.editors import Editor, editor_for
from hexmend_app.widgets.inputs.number_box import LONGEST_UNIT, NumberBox
from hexmend_app.widgets.wording import name_in_words, short_number


@dataclass(frozen=True)
class _Row:
    """The widgets of a parameter: label, editor, reset button, and lines for errors and help."""

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
        self.problem.setText(self.editor.problem)
        self.problem.setVisible(bool(self.editor.problem))


class ParameterForm(QWidget):
    """Edits values of declared parameters, one row each.

    The label is the parameter's name in words; its help is the tooltip, and a switch below the rows writes it out under
    each. A value that differs from its default has a bold label and a button that resets it.

    Parameters
    ----------
    declarations : iterable of Parameter
        As `hexmend.parameters.declared` gives them.

    Attributes
    ----------
    rows : dict
        What each parameter shows, by its name: label, editor, reset, problem and help.
    none : QLabel
        Says that there is nothing to set.

    Signals
    -------
    changed
        The user changed a value, or made one wrong or right. Setters stay silent.
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
        self.none = note("There is nothing to set.")
        self._defaults = self._tool("Defaults", "restore", "Set all of these parameters to their defaults.")
        self._defaults.clicked.connect(self._reset_all)
        self._explain = self._tool("Explain", "help-circle-outline", "Write out what each parameter means.")
        self._explain.setCheckable(True)
        self._explain.toggled.connect(self._show_help)
        foot = QHBoxLayout()
        foot.addWidget(self._explain)
        foot.addStretch()
        foot.addWidget(self._defaults)
        layout = QVBoxLayout(self)
        layout.setContentsMargins(0, 0, 0, 0)
        layout.addLayout(self._grid)
        layout.addWidget(self.none)
        layout.addLayout(foot)
        self.set_declarations(declarations)

    @staticmethod
    def _tool(text: str, icon_name: str, help: str) -> QToolButton:
        button = QToolButton()
        button.setText(text)
        button.setIcon(icon(icon_name))
        button.setToolButtonStyle(Qt.ToolButtonStyle.ToolButtonTextBesideIcon)
        button.setAutoRaise(True)
        button.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        set_help(button, text, help)
        return button

    def set_declarations(self, declarations: Iterable[Parameter]) -> None:
        """Show other parameters, at their defaults; not from a signal of an editor that this replaces."""
        declarations = list(declarations)
        if declarations and declarations == [row.declaration for row in self.rows.values()]:  # to make rows takes time
            self.set_values({declaration.name: declaration.default for declaration in declarations})
            return
        while (item := self._grid.takeAt(0)) is not None:
            # At once: deleted later, rows stay for as long as the loop does not return to where they were made.
            shiboken6.delete(item.widget())
        before = self._explain.previousInFocusChain()
        self.rows = {d.name: self._make_row(3 * i, d) for i, d in enumerate(declarations)}
        # Qt puts what is made later at the end of the whole window.
        parts = [part for row in self.rows.values() for part in (row.editor, row.reset)]
        for one, following in pairwise([before, *parts, self._explain, self._defaults]):
            self.setTabOrder(one, following)
        self.none.setVisible(not self.rows)
        self._explain.setVisible(bool(self.rows))
        self._defaults.setVisible(bool(self.rows))
        self._show_help(self._explain.isChecked())
        self._refresh()

    def _make_row(self, at: int, declaration: Parameter) -> _Row:
        name = name_in_words(declaration.name)
        editor = editor_for(declaration)
        default = declaration.default
        shown = short_number(default) if isinstance(default, float) else str(default)
        # An unbounded float says nothing worth reading about its range.
        tip = f"{escape(declaration.help)}<br><i>{escape(declaration.range.capitalize())}; default {escape(shown)}.</i>"
        set_help(editor, name, tip)
        editor.setAccessibleDescription(declaration.help)
        label = QLabel(name)
        if isinstance(editor, NumberBox) and len(declaration.unit) > LONGEST_UNIT:
            label.setText(f"{escape(name)}<br><small>{escape(declaration.unit)}</small>")
        label.setWordWrap(True)
        label.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Preferred)
        label.setMinimumWidth(_longest_word(label, name))
        label.setBuddy(editor)
        label.setToolTip(editor.toolTip())
        reset = QToolButton()
        reset.setIcon(icon("restore", BLUE))
        reset.setAutoRaise(True)
        reset.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        set_help(reset, f"Reset {name}", f"Changed; set it back to its default, {escape(shown)}.")
        # The button's place is kept while it is hidden, so that editors do not change width.
        policy = reset.sizePolicy()
        policy.setRetainSizeWhenHidden(True)
        reset.setSizePolicy(policy)
        row = _Row(declaration, label, editor, reset, note("", WORSE), note(declaration.help))
        editor.changed.connect(self._on_changed)
        reset.clicked.connect(lambda: self._reset([row]))
        self._grid.addWidget(label, at, 0)
        self._grid.addWidget(editor, at, 1)
        self._grid.addWidget(reset, at, 2)
        self._grid.addWidget(row.problem, at + 1, 0, 1, 3)
        self._grid.addWidget(row.help, at + 2, 0, 1, 3)
        return row

    def values(self) -> dict[str, Any]:
        """Values by name; where a text is wrong, the value from before it was typed."""
        return {name: row.editor.value() for name, row in self.rows.items()}

    def set_values(self, values: Mapping[str, Any]) -> None:
        """Show values, without a signal; parameters that are not named keep theirs.

        Raises
        ------
        ParameterError
            For a name that the form does not have or a value that is not admitted.
        """
        for name, value in values.items():
            if name not in self.rows:
                raise ParameterError(f"there is no parameter {name!r}: known are {', '.join(self.rows) or 'none'}")
            self.rows[name].editor.set_value(value)
        self._refresh()

    def editor(self, name: str) -> Editor:
        """The editor of a parameter."""
        return self.rows[name].editor

    def problems(self) -> dict[str, str]:
        """The problems by parameter; empty if there are none."""
        return {name: row.editor.problem for name, row in self.rows.items() if row.editor.problem}

    def show_problem(self) -> None:
        """Lead the user to the first wrong value."""
        for name in self.problems():
            self.rows[name].editor.setFocus(Qt.FocusReason.OtherFocusReason)
            return

    def _reset_all(self) -> None:
        self._reset(self.rows.values())

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

    def _show_help(self, shown: bool) -> None:
        for row in self.rows.values():
            row.help.setVisible(shown)


def _longest_word(label: QLabel, text: str) -> int:
    """Pixels that a wrapped text needs at least, as it is written where a value is not its default."""
    label.ensurePolished()
    bold = QFont(label.font())
    bold.setBold(True)
    metrics = QFontMetrics(bold)
    return max(metrics.horizontalAdvance(word) for word in text.split()) + 2
