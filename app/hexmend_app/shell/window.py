"""The window: state below, widgets around, and the parts that draw the lines between them."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

from PySide6.QtCore import QPoint, QSettings, Qt, QTimer
from PySide6.QtGui import QCloseEvent, QDragEnterEvent, QDropEvent, QGuiApplication

from hexmend_app.features.compare.feature import Comparing
from hexmend_app.features.convergence.feature import Converging
from hexmend_app.features.film.feature import Filming
from hexmend_app.features.histogram.feature import Counting
from hexmend_app.features.inspect.feature import Inspecting
from hexmend_app.features.look.feature import Looking
from hexmend_app.features.movement.feature import Moving
from hexmend_app.features.node.feature import Debugging
from hexmend_app.features.open.feature import Opening
from hexmend_app.features.outcome.feature import Advising
from hexmend_app.features.recipe.feature import Chaining
from hexmend_app.features.save.feature import Saving
from hexmend_app.features.tags.feature import Tagging
from hexmend_app.features.timeline.feature import Watching
from hexmend_app.resources import demo_mesh
from hexmend_app.shell.actions import ACTIONS
from hexmend_app.shell.docks import LAYOUT, name_tabs
from hexmend_app.shell.frame import Shell
from hexmend_app.shell.menus import build_menus
from hexmend_app.shell.palette import CommandPalette
from hexmend_app.state.commands import Commands
from hexmend_app.state.run import Frame, Phase
from hexmend_app.state.session import Session
from hexmend_app.widgets import theming
from hexmend_app.widgets.questions import Answer, ask_mesh, ask_unsaved, show_about
from hexmend_app.widgets.theming import Choice

if TYPE_CHECKING:
    from hexmend.optimise import Result
    from hexmend_app.canvas.canvas import Canvas


class Window(Shell):
    """Hexmend's one window.

    It is shown before what is slow to load: `build_canvas` adds the 3D view afterwards.
    """

    def __init__(self) -> None:
        super().__init__()
        session = self.session = Session(self)
        self.document, self.view, self.selection = session.document, session.view, session.selection
        self.smoothing, self.opener, self.finder = session.smoothing, session.opener, session.finder
        self.commands = Commands(session)
        self.canvas: Canvas | None = None

        self.looking = Looking(session, self.colour_panel, self.clip_panel, self.inside_panel, self.structure_panel)
        self.moving = Moving(session, self.movement_panel, self.colour_panel)
        self.counting = Counting(session, self.histogram)
        self.inspecting = Inspecting(
            session, self.commands, self.worst_list, self.element_panel, self.docks["element"], self.docks["node"]
        )
        self.debugging = Debugging(session, self.node_panel, self.docks["node"], self.smoothing_panel, self.worst_list)
        self.opening = Opening(self.document, self.opener, self.recent, self.busy, self.messages)
        self.tagging = Tagging(
            session, self.commands, self.tag_panel, self.worst_list, lambda: self.canvas.viewport.left()
        )
        self.comparing = Comparing(session, self.commands, self.compare_panel, self.smoothing_panel, self.counting.kept)
        self.watching = Watching(session, self.commands, self.timeline_bar, self.smoothing_panel)
        self.chaining = Chaining(self, session, self.commands, self.smoothing_panel, self.messages)
        self.advising = Advising(
            session,
            self.commands,
            self.outcome_panel,
            self.docks["outcome"],
            self.smoothing_panel,
            self.inspecting.go_to,
        )
        self.filming = Filming(self, session, self.busy, self.messages)
        self.saving = Saving(self, self.document, self.commands, self.messages, self.histogram, self.worst_list)
        self.converging = Converging(session, self.convergence_panel, self.saving)
        self.actions_by_id = build_menus(self, self._handlers(), {"open_demo": self.recent_menu})
        self.smoothing_panel.set_shortcuts(
            {id: self.actions_by_id[id].shortcut().toString() for id in ("run", "step", "stop", "reset")}
        )
        self.timeline_bar.set_shortcuts(
            {
                id.removeprefix("iteration_"): self.actions_by_id[id].shortcut().toString()
                for id in self.watching.handlers()
            }
        )
        self._connect()
        self._restore()
        self._enable()

    def build_canvas(self) -> None:
        """Load what draws in 3D and put it where the welcome is; slow the first time."""
        from hexmend_app.canvas.canvas import Canvas

        self.canvas = Canvas()
        self._centre.insertWidget(self._centre.indexOf(self.timeline_bar), self.canvas, 1)
        name_tabs(self)
        self.setTabOrder(self.hint.close_button, self.canvas.interactor)
        self.looking.set_canvas(self.canvas)
        self.inspecting.set_canvas(self.canvas)
        self.debugging.set_canvas(self.canvas)
        self.comparing.set_canvas(self.canvas)
        self.saving.canvas = self.filming.canvas = self.moving.canvas = self.canvas
        self.canvas.setVisible(self.document.is_open)
        if self.document.is_open:
            self._on_mesh_replaced()

    def _connect(self) -> None:
        self.document.mesh_replaced.connect(self._on_mesh_replaced)
        self.document.points_moved.connect(self._on_points_moved)
        self.document.changes_changed.connect(self._enable)
        self.view.look_changed.connect(self._enable)
        self.finder.found.connect(self._enable)
        for told in (self.opener.began, self.opener.ended, self.opener.cancelled, self.opener.failed):
            told.connect(self._enable)
        self.tag_panel.offer_changed.connect(self._enable)
        self.session.stepping.changed.connect(self._enable)
        for told in (self.smoothing_panel.method_changed, self.smoothing_panel.form.changed):
            told.connect(self._enable)
        self.compare_panel.save_requested.connect(lambda: self.saving.ask_comparison(self.session.comparison))
        compared = self.session.comparison
        for told in (compared.changed, self.session.views.changed, self.compare_panel.offer_changed):
            told.connect(self._enable)
        self.session.timeline.runs_changed.connect(self._enable)
        self.chaining.chain.changed.connect(self._enable)
        self.smoothing.phase_changed.connect(self._on_phase)
        self.smoothing.iterated.connect(self._on_iterated)
        self.smoothing.ended.connect(self._on_ended)
        self.smoothing.failed.connect(self._on_failed)
        self.smoothing_panel.run_requested.connect(self.commands.run)
        self.smoothing_panel.step_requested.connect(self.commands.step)
        self.smoothing_panel.change_requested.connect(self.commands.change)
        self.smoothing_panel.pause_requested.connect(self.smoothing.pause)
        self.smoothing_panel.resume_requested.connect(self.smoothing.resume)
        self.smoothing_panel.stop_requested.connect(self.smoothing.stop)
        self.smoothing_panel.reset_requested.connect(self.commands.reset)
        self.recent_menu.chosen.connect(self.open)
        self.selection.changed.connect(self._enable)
        self.messages.filled.connect(self._enable)
        self.messages.emptied.connect(self._enable)
        QGuiApplication.styleHints().colorSchemeChanged.connect(self._on_desktop_theme)
        self.welcome.open_requested.connect(self._on_open)
        self.welcome.recent_requested.connect(self.open)
        self.welcome.demo_requested.connect(self._on_open_demo)

    def _handlers(self) -> dict[str, Callable]:
        """What every action does, by its id."""
        return {
            "open": self._on_open,
            "open_demo": self._on_open_demo,
            "quit": self.close,
            "undo": self.commands.undo,
            "redo": self.commands.redo,
            "run": self.smoothing_panel.run_or_pause,
            "step": self.smoothing_panel.step,
            "stop": self.smoothing.stop,
            "reset": self.commands.reset,
            "commands": self._on_commands,
            "keys": self.hint.show,
            "about": self._on_about,
            **{f"theme_{choice.value}": partial(self._on_theme, choice) for choice in Choice},
            **self.saving.handlers(),
            **self.looking.handlers(),
            **self.inspecting.handlers(),
            **self.debugging.handlers(),
            **self.tagging.handlers(),
            **self.comparing.handlers(),
            **self.watching.handlers(),
            **self.chaining.handlers(),
            **self.filming.handlers(),
        }

    # What the state tells

    def _on_mesh_replaced(self) -> None:
        self.welcome.setVisible(self.canvas is None)
        self.selection.choose(None)
        self.counting.show_another()
        self.looking.show_another()
        self.smoothing_panel.set_state("idle")
        self.smoothing_panel.set_status()
        self._show_figures()

    def _on_points_moved(self) -> None:
        self.looking.move(live=self.smoothing.phase is Phase.RUNNING)
        self._show_figures()

    def _show_figures(self) -> None:
        start, now = self.document.start, self.document.now
        self.counting.refresh()
        self.statistics.set_summaries(start.summary, now.summary)
        self.inspecting.refresh()
        self.debugging.refresh()
        self.tagging.refresh()
        self.comparing.move()
        self.looking.refresh()
        self.moving.refresh()
        inverted = f"{now.summary.inverted:,} inverted" if now.summary.inverted else "none inverted"
        self.counts.setText(f"{now.summary.hexes:,} hexes, {inverted}")

    def _on_phase(self) -> None:
        phase = self.smoothing.phase
        self.smoothing_panel.set_state(phase.value)
        if phase in (Phase.PREPARING, Phase.STOPPING):
            self._show_preparing(phase)
        elif not self.opener.busy:
            self.busy.done()  # its animation would slow a run that shows itself anyway
        if phase is Phase.PAUSED and self.canvas is not None:
            self.canvas.rest()
        self._enable()

    def _show_preparing(self, phase: Phase) -> None:
        if phase is Phase.STOPPING:
            self.busy.show_work("Stopping…")
            sentence = "Stopping: the run ends as soon as the method is ready, before its first iteration."
        else:
            help = "End the run before its first iteration (Shift+F5)."
            self.busy.show_work("Preparing the method…", "Stop", help, self.smoothing.stop)
            sentence = "Preparing the method."
        self.smoothing_panel.set_status(sentence=sentence)

    def _on_iterated(self, frame: Frame) -> None:
        iteration, stage = frame.iteration, self.chaining.at_work(frame)
        self.smoothing_panel.set_status(iteration.number, iteration.seconds, stage)

    def _on_ended(self, result: Result) -> None:
        self.smoothing_panel.set_status(result.iterations, result.seconds, result.message)

    def _on_failed(self, error: Exception) -> None:
        self.smoothing_panel.set_status()
        self.messages.show_error("The method failed", f"{error}. The mesh is as it was before the run.")

    def _enable(self) -> None:
        busy, editable, phase = self.smoothing.busy, self.session.editable, self.smoothing.phase
        for spec in ACTIONS:
            self.actions_by_id[spec.id].setEnabled(self.document.is_open or not spec.needs_mesh)
        undo, redo = (self.document.undo_title, self.document.redo_title) if self.document.is_open else (None, None)
        undo = self.session.stepping.title or undo
        for id, title, word in (("undo", undo, "&Undo"), ("redo", redo, "&Redo")):
            self.actions_by_id[id].setEnabled(title is not None and editable)
            self.actions_by_id[id].setText(f"{word} {title}" if title else word)
            self.actions_by_id[id].setIconText(word.replace("&", ""))
        for id in ("run", "step", "reset"):
            self.actions_by_id[id].setEnabled(self.document.is_open and not self.opener.busy)
        self.actions_by_id["stop"].setEnabled(busy and phase is not Phase.STOPPING)
        self.comparing.enable()
        parts = (
            self.inspecting,
            self.debugging,
            self.tagging,
            self.looking,
            self.watching,
            self.comparing,
            self.chaining,
            self.filming,
        )
        for id, on in {id: on for part in parts for id, on in part.offered().items()}.items():
            self.actions_by_id[id].setEnabled(on and self.document.is_open)
        # Esc is for a message first, then for what is being opened.
        self.busy.take_escape(self.opener.busy and self.messages.isHidden())
        if self.opener.busy or not self.messages.isHidden():
            self.actions_by_id["back"].setEnabled(False)
        for id, on in (
            self.looking.checked() | self.comparing.checked() | {f"theme_{theming.chosen().value}": True}
        ).items():
            self.actions_by_id[id].setChecked(on)
        self.actions_by_id["save"].setEnabled(self.document.is_open and phase is not Phase.RUNNING)
        self.timeline_bar.setVisible(self.document.is_open)
        self.smoothing_panel.setEnabled(self.document.is_open and not self.opener.busy)
        self.looking.set_enabled(self.document.is_open)
        self.tag_panel.setEnabled(self.document.is_open)
        self.histogram.setEnabled(self.document.is_open)
        self.movement_panel.setEnabled(self.document.is_open)
        self.setWindowTitle(f"{self.document.name}[*] – Hexmend" if self.document.is_open else "Hexmend")
        self.setWindowModified(self.document.modified)

    # What the user asks for

    def open(self, path: str | Path) -> None:
        """Open a mesh, after what is unsaved was kept or given up."""
        if self._may_leave():
            self.smoothing.end_now()
            self.commands.open(path)

    def _on_open(self) -> None:
        path = ask_mesh(self)
        if path:
            self.open(path)

    def _on_open_demo(self) -> None:
        self.open(demo_mesh())

    def _on_commands(self) -> None:
        others = [action for id, action in self.actions_by_id.items() if id != "commands"]
        palette = CommandPalette(others, self)
        palette.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        palette.move(self.mapToGlobal(QPoint((self.width() - palette.width()) // 2, 90)))
        palette.open()

    def _on_theme(self, choice: Choice, on: bool) -> None:
        if on and choice is not theming.chosen():
            theming.choose(choice)

    def _on_desktop_theme(self) -> None:
        theming.wear()

    def _on_about(self) -> None:
        from hexmend import __version__

        show_about(self, __version__)

    def dragEnterEvent(self, event: QDragEnterEvent) -> None:
        """Take one file that is dragged in."""
        if _dropped(event):
            event.acceptProposedAction()

    def dropEvent(self, event: QDropEvent) -> None:
        """Open the file that is dropped."""
        path = _dropped(event)
        if path:
            event.acceptProposedAction()
            QTimer.singleShot(0, lambda: self.open(path))

    # Coming and going

    def _may_leave(self) -> bool:
        """Whether what is unsaved was saved or may be lost."""
        self.session.stepping.leave()
        if not self.document.modified and not self.smoothing.busy:
            return True
        answer = ask_unsaved(self, self.document.name)
        if answer is Answer.SAVE:
            self.smoothing.end_now()
            return self.saving.ask_mesh()
        return answer is Answer.DISCARD

    def closeEvent(self, event: QCloseEvent) -> None:
        """End the threads and the 3D view before the window goes."""
        if not self._may_leave():
            event.ignore()
            return
        settings = QSettings()
        settings.setValue("geometry", self.saveGeometry())
        settings.setValue("layout", self.saveState(LAYOUT))
        self.hide()  # threads may take a while to end
        self.filming.cancel()
        self.session.shut_down()
        if self.canvas is not None:
            self.canvas.close()
        event.accept()

    def _restore(self) -> None:
        settings = QSettings()
        self.resize(1440, 900)
        if settings.contains("geometry"):
            self.restoreGeometry(settings.value("geometry"))
        if settings.contains("layout"):
            self.restoreState(settings.value("layout"), LAYOUT)


def _dropped(event: QDropEvent) -> str:
    """The one local file of a drag, or ""."""
    urls = event.mimeData().urls()
    return urls[0].toLocalFile() if len(urls) == 1 else ""
