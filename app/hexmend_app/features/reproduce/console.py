"""Python console with the open mesh: a mesh assigned to `mesh` becomes an undoable change."""

from __future__ import annotations

import io
import sys
import traceback
from code import InteractiveConsole
from contextlib import redirect_stderr, redirect_stdout
from typing import Any

from PySide6.QtCore import QEvent, QObject, Qt
from PySide6.QtGui import QFontDatabase, QKeyEvent
from PySide6.QtWidgets import QHBoxLayout, QLabel, QLineEdit, QPlainTextEdit, QVBoxLayout, QWidget

import hexmend
from hexmend.mesh.mesh import Mesh
from hexmend_app.state.mesh.document import MeasuredMesh
from hexmend_app.state.session.session import Session
from hexmend_app.state.tasks.task import Task
from hexmend_app.theme.spacing import fill
from hexmend_app.theme.style import set_help
from hexmend_app.translation import tr

_WELCOME = "Python with mesh, quality, result and hx. Assign to mesh to change the open mesh; this can be undone."
#: Largest number of lines of output.
_MAX_LINES = 5000


class ConsolePanel(QWidget):
    """Output of commands, and a line that enters them; each runs in a thread.

    Parameters
    ----------
    session : Session

    Attributes
    ----------
    output : QPlainTextEdit
    line : QLineEdit
    """

    def __init__(self, session: Session, parent: QWidget | None = None):
        super().__init__(parent)
        self._session = session
        self._python = _Python({"__name__": "__console__", "hx": hexmend, "result": None}, "<console>")
        self._task: Task | None = None
        self._history: list[str] = []
        self._at = 0
        self.output = QPlainTextEdit(readOnly=True, maximumBlockCount=_MAX_LINES)
        self.output.setFont(QFontDatabase.systemFont(QFontDatabase.SystemFont.FixedFont))
        self.output.setPlainText(tr(_WELCOME))
        set_help(self.output, tr("Console output"), tr("Commands with their output and values."))
        self.line = QLineEdit()
        self.line.installEventFilter(self)
        self.line.returnPressed.connect(lambda: self.enter(self.line.text()))
        help = tr("Press Enter to run; the arrow keys recall earlier commands. An empty line ends a block.")
        set_help(self.line, tr("Python command"), help)
        self._prompt = QLabel(">>>")
        fill(
            QVBoxLayout(self), (self.output, 1), fill(QHBoxLayout(), self._prompt, (self.line, 1)), margins=(0, 0, 0, 0)
        )
        session.run.ended.connect(lambda result: self._python.locals.update(result=result))
        session.document.mesh_replaced.connect(lambda: self._python.locals.update(result=None))

    @property
    def running(self) -> bool:
        """True while a command runs."""
        return self._task is not None

    def enter(self, source: str) -> None:
        """Run a line, or add it to the block that has been begun."""
        if self.running:
            return
        self.output.appendPlainText(f"{self._prompt.text()} {source}")
        if source.strip():
            self._history.append(source)
        self._at = len(self._history)
        self.line.clear()
        now = self._session.document.now
        mesh = None if now is None else now.mesh
        self._python.locals.update(mesh=mesh, quality=None if now is None else now.quality)
        self._task = Task("console", lambda _: _run(self._python, source, mesh), yields=True)
        self._task.ended.connect(self._finish)
        self.line.setEnabled(False)
        self._task.start()

    def close_task(self) -> None:
        """Drop the command that runs: the window closes."""
        if self._task is not None:
            self._task.drop()
            self._task = None

    def _finish(self) -> None:
        task, self._task = self._task, None
        if task.error is not None:
            raise task.error
        more, text, state = task.result
        if state is not None and not self._session.commands.replace_mesh("console", state):
            text += tr("Mesh not changed: a run, a repair or a file operation is in progress.\n")
        if text:
            self.output.appendPlainText(text.rstrip("\n"))
        self._prompt.setText("..." if more else ">>>")
        self.line.setEnabled(True)
        self.line.setFocus()

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Recall commands with the arrow keys."""
        steps: dict[int, int] = {Qt.Key.Key_Up: -1, Qt.Key.Key_Down: 1}
        if isinstance(event, QKeyEvent) and event.type() == QEvent.Type.KeyPress and event.key() in steps:
            self._at = min(max(0, self._at + steps[event.key()]), len(self._history))
            self.line.setText("".join(self._history[self._at : self._at + 1]))
            return True
        return super().eventFilter(watched, event)


class _Python(InteractiveConsole):
    """Interpreter that writes all errors; Python's own leaves them to `sys.excepthook`, which is the window's."""

    def showtraceback(self) -> None:
        """Write the traceback of the present error, without the frame of the interpreter."""
        kind, error, trace = sys.exc_info()
        self.write("".join(traceback.format_exception(kind, error, trace and trace.tb_next)))

    def showsyntaxerror(self, filename: str | None = None, **_: object) -> None:
        """Write the present error of syntax."""
        self.write("".join(traceback.format_exception_only(*sys.exc_info()[:2])))


def _run(python: _Python, source: str, mesh: Mesh | None) -> tuple[bool, str, MeasuredMesh | None]:
    """Run a line; return True if the block continues, its output, and the state of another mesh assigned to `mesh`."""
    output, state, more = io.StringIO(), None, False
    with redirect_stdout(output), redirect_stderr(output):
        try:
            more = python.push(source)
        except SystemExit:
            python.resetbuffer()
            python.write("SystemExit\n")
    new: Any = python.locals.get("mesh")
    if new is not mesh and not isinstance(new, Mesh):
        output.write(f"mesh not changed: expected mesh to be a hexmend Mesh, not {type(new).__name__}\n")
    elif new is not mesh:
        state = MeasuredMesh.of(new if mesh is not None and new.elements is mesh.elements else new.keeping_surface())
        _ = new.topology.face_neighbours, new.topology.layers  # for drawing, which the window shall not wait for
    return more, output.getvalue(), state
