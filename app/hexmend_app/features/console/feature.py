"""Feature with a Python console whose commands use and change the open mesh."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from PySide6.QtCore import QTimer

import hexmend
from hexmend.mesh.mesh import Mesh
from hexmend_app.feature import Action, Feature, Host, Panel, PanelGroup, PanelPlace
from hexmend_app.features.console.interpreter import Interpreter, error_text, is_complete
from hexmend_app.features.console.panel import ConsolePanel
from hexmend_app.state.mesh.document import State
from hexmend_app.state.tasks.task import Task
from hexmend_app.translation import tr

#: Milliseconds between two updates of the output.
_PERIOD = 50


class FeatureConsole(Feature):
    """Runs commands in a thread, shows their output, and makes a mesh assigned to `mesh` an undoable edit."""

    order = 59

    def __init__(self, host: Host):
        super().__init__(host)
        self._interpreter = Interpreter()
        self._interpreter.namespace.update(hx=hexmend, mesh=None, quality=None, result=None)
        self._task: Task | None = None
        self._result: Any = None
        self.panel = ConsolePanel()
        self.panel.entered.connect(self.enter)
        self.panel.interrupt_requested.connect(self.interrupt)
        self.panel.completions = self._interpreter.completions
        self._timer = QTimer(self, interval=_PERIOD)
        self._timer.timeout.connect(self._show_output)
        self.session.run.ended.connect(self._on_ended)
        self.session.document.mesh_replaced.connect(lambda: self._on_ended(None))

    def actions(self) -> Sequence[Action]:
        """Return the action that opens the console."""
        return (
            Action(
                id="console",
                text=tr("Python conso&le"),
                menu="Edit",
                keys="Ctrl+`",
                icon="console",
                help=tr("Open a Python console that uses and changes the open mesh."),
                handle=self.show,
                needs_mesh=False,
            ),
        )

    def panels(self) -> Sequence[Panel]:
        """Return the console."""
        return (
            Panel(
                id="console",
                title=tr("Console"),
                widget=self.panel,
                place=PanelPlace.DRAWER,
                group=PanelGroup.REPORT,
                order=80,
                help=tr("Python console that uses and changes the open mesh."),
            ),
        )

    def show(self) -> None:
        """Open the console and focus its input."""
        self.host.show_panel("console")
        self.panel.input.setFocus()

    @property
    def running(self) -> bool:
        """True while a command runs."""
        return self._task is not None

    def enter(self, source: str) -> None:
        """Run source code if it is complete, otherwise begin a new line."""
        if self.running:
            return
        if not is_complete(source):
            self.panel.new_line()
            return
        self.panel.echo(source)
        if source.strip():
            self.run(source)

    def run(self, source: str) -> None:
        """Run source code in a thread, unless another command runs."""
        if self.running:
            return
        interpreter, now = self._interpreter, self.session.document.now
        mesh, quality = (None, None) if now is None else (now.mesh, now.figures)
        interpreter.namespace.update(mesh=mesh, quality=quality, result=self._result)

        def execute(_: Task) -> State | None:
            interpreter.execute(source)
            return _new_state(interpreter.namespace.get("mesh"), mesh)

        self._task = Task("console", execute, yields=True)
        self._task.ended.connect(self._finish)
        self.panel.set_running(True)
        self._timer.start()
        self._task.start()

    def interrupt(self) -> None:
        """Raise KeyboardInterrupt in the running command."""
        if self.running:
            self._interpreter.interrupt()

    def close(self) -> None:
        """End the running command."""
        self._timer.stop()
        if self._task is not None:
            self._interpreter.interrupt()
            self._task.drop()
        self._task = None
        self.panel.set_running(False)

    def _on_ended(self, result: Any) -> None:
        self._result = result

    def _show_output(self) -> None:
        for text, error in self._interpreter.output():
            (self.panel.print_error if error else self.panel.print_text)(text)

    def _finish(self) -> None:
        task, self._task = self._task, None
        self._timer.stop()
        self._show_output()
        if task.error is not None:
            self.panel.print_error(error_text(task.error))
        elif task.result is not None and not self.session.commands.replace_mesh("console", task.result):
            self.panel.print_error(tr("Mesh not changed: a run, a repair or a file operation is in progress.\n"))
        self.panel.set_running(False)


def _new_state(new: object, mesh: Mesh | None) -> State | None:
    """Return the state of a mesh assigned by a command, with data for drawing; None if there is no new mesh."""
    if new is mesh:
        return None
    if not isinstance(new, Mesh):
        raise TypeError(f"mesh not changed: expected mesh to be a hexmend Mesh, not {type(new).__name__}")
    if mesh is None or new.hexes is not mesh.hexes:
        new = new.keeping_surface()
    state = State.of(new)
    _ = new.topology.face_neighbours, new.topology.layers  # computed here rather than in the GUI thread
    return state
