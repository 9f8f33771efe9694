"""Panel of the console: the output and, below it, the input."""

from __future__ import annotations

import re
from collections.abc import Callable
from typing import Any

from PySide6.QtCore import QEvent, QObject, Qt, Signal
from PySide6.QtGui import QColor, QFontDatabase, QKeyEvent, QTextCharFormat, QTextCursor
from PySide6.QtWidgets import QHBoxLayout, QLabel, QPlainTextEdit, QPushButton, QVBoxLayout, QWidget

from hexmend_app.theme.palette import BLUE, MUTED, TEXT, WORSE, Role
from hexmend_app.theme.spacing import fill
from hexmend_app.theme.style import icon, set_help
from hexmend_app.translation import tr

_WELCOME = "Python with mesh, quality, result and hx. Assign to mesh to change the open mesh; this can be undone.\n"

#: Largest number of lines of output, and of visible lines of the input.
_MAX_LINES, _MAX_ROWS = 5000, 8
_INDENT = "    "


class ConsolePanel(QWidget):
    """Panel with output, and an input with history and completion.

    Signals
    -------
    entered(str)
        The user pressed Enter; the source code may be incomplete.
    interrupt_requested
    """

    entered = Signal(str)
    interrupt_requested = Signal()

    def __init__(self, parent: QWidget | None = None):
        super().__init__(parent)
        font = QFontDatabase.systemFont(QFontDatabase.SystemFont.FixedFont)
        self.output = QPlainTextEdit(readOnly=True, maximumBlockCount=_MAX_LINES)
        self.output.setUndoRedoEnabled(False)
        set_help(self.output, tr("Console output"), tr("Output and values of commands."))
        self.input = QPlainTextEdit(tabChangesFocus=True)
        self.input.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAsNeeded)
        self.input.setLineWrapMode(QPlainTextEdit.LineWrapMode.NoWrap)
        set_help(
            self.input,
            tr("Python command"),
            tr("Press Enter to run, Shift+Enter for a new line, Tab to complete a name."),
        )
        self.input.installEventFilter(self)
        self.input.textChanged.connect(self._fit)
        self._interrupt = QPushButton(icon("stop"), tr("Interrupt"))
        set_help(self._interrupt, tr("Interrupt command"), tr("Stop the running command (Ctrl+C)."))
        self._interrupt.clicked.connect(self.interrupt_requested)
        clear = QPushButton(icon("eraser"), tr("Clear"))
        set_help(clear, tr("Clear output"), tr("Clear the output of the console."))
        clear.clicked.connect(self.output.clear)
        self._prompt = QLabel(">>>")
        self._prompt.setFont(font)
        line = fill(QHBoxLayout(), self._prompt, (self.input, 1), self._interrupt, clear)
        fill(QVBoxLayout(self), (self.output, 1), line, margins=(8, 8, 8, 8))
        self._history: list[str] = []
        self._at = 0
        self.completions: Callable[[str], list[str]] = lambda text: []
        self.set_running(False)
        self._fit()
        self.print_text(tr(_WELCOME), MUTED)

    # Output

    def print_text(self, text: str, colour: Role = TEXT) -> None:
        """Append text; scroll to the end if it was visible."""
        bar = self.output.verticalScrollBar()
        at_end = bar.value() == bar.maximum()
        cursor = QTextCursor(self.output.document())
        cursor.movePosition(QTextCursor.MoveOperation.End)
        text_format = QTextCharFormat()
        text_format.setForeground(QColor(str(colour)))
        cursor.insertText(text, text_format)
        if at_end:
            bar.setValue(bar.maximum())

    def print_error(self, text: str) -> None:
        """Append an error."""
        self.print_text(text, WORSE)

    def echo(self, source: str) -> None:
        """Append a command with its prompts to output and history, and clear the input."""
        first, *rest = source.split("\n")
        self.print_text("\n".join([f">>> {first}", *(f"... {line}" for line in rest)]) + "\n", BLUE)
        if source.strip() and self._history[-1:] != [source]:
            self._history.append(source)
        self._at = len(self._history)
        self.input.clear()

    def set_running(self, running: bool) -> None:
        """Show whether a command is running."""
        self._interrupt.setEnabled(running)
        self._prompt.setText("..." if running else ">>>")

    # Input

    def new_line(self) -> None:
        """Begin a new line, indented like the previous one, and further after a colon."""
        cursor = self.input.textCursor()
        before = cursor.block().text()[: cursor.positionInBlock()]
        indent = before[: len(before) - len(before.lstrip())] + _INDENT * before.rstrip().endswith(":")
        cursor.insertText("\n" + indent)

    def _fit(self) -> None:
        rows = min(max(1, self.input.blockCount()), _MAX_ROWS)
        margin = round(2 * self.input.document().documentMargin()) + 2 * self.input.frameWidth()
        self.input.setFixedHeight(rows * self.input.fontMetrics().lineSpacing() + margin + 2)

    def eventFilter(self, watched: QObject, event: Any) -> bool:
        """Handle the keys of the input: run, complete, history, interrupt."""
        if event.type() == QEvent.Type.KeyPress:
            return self._on_key(event)
        return super().eventFilter(watched, event)

    def _on_key(self, event: QKeyEvent) -> bool:
        key, shift = event.key(), bool(event.modifiers() & Qt.KeyboardModifier.ShiftModifier)
        cursor = self.input.textCursor()
        if key in (Qt.Key.Key_Return, Qt.Key.Key_Enter):
            if shift or not cursor.atEnd():
                self.new_line()
            else:
                self.entered.emit(self.input.toPlainText())
        elif key == Qt.Key.Key_Tab and self.input.toPlainText():  # in an empty input, Tab moves the focus
            self._complete(cursor)
        elif key == Qt.Key.Key_Up and cursor.blockNumber() == 0:
            self._recall(-1)
        elif key == Qt.Key.Key_Down and cursor.blockNumber() == self.input.blockCount() - 1:
            self._recall(1)
        elif key == Qt.Key.Key_C and event.modifiers() == Qt.KeyboardModifier.ControlModifier:
            if cursor.hasSelection() or not self._interrupt.isEnabled():
                return False
            self.interrupt_requested.emit()
        else:
            return False
        return True

    def _recall(self, step: int) -> None:
        self._at = min(max(0, self._at + step), len(self._history))
        self.input.setPlainText(self._history[self._at] if self._at < len(self._history) else "")
        self.input.moveCursor(QTextCursor.MoveOperation.End)

    def _complete(self, cursor: QTextCursor) -> None:
        """Complete the name before the cursor as far as it is unique, or list the candidates."""
        before = cursor.block().text()[: cursor.positionInBlock()]
        name = re.search(r"[\w.]*$", before).group()
        if not name:
            cursor.insertText(_INDENT)
            return
        names = self.completions(name)
        common = names[0] if names else ""
        for candidate in names:
            while not candidate.startswith(common):
                common = common[:-1]
        cursor.insertText(common[len(name) :])
        if len(names) > 1 and common == name:
            self.print_text("  ".join(candidate.rpartition(".")[2] for candidate in names) + "\n", MUTED)
