"""Watching runs: the lines between the timeline, the bar below the view, and break-points."""

from __future__ import annotations

from collections.abc import Callable

from PySide6.QtCore import QSettings

from hexmend_app.features.smooth.smoothing_panel import SmoothingPanel
from hexmend_app.features.timeline.timeline_bar import TimelineBar
from hexmend_app.state.commands import Commands
from hexmend_app.state.history import LIMIT, Record
from hexmend_app.state.run import Frame
from hexmend_app.state.session import Session
from hexmend_app.state.timeline import SPEED


class Watching:
    """Goes through the iterations of runs, begins branches, and says where a run paused.

    Parameters
    ----------
    session : Session
        The window's state.
    commands : Commands
    bar : TimelineBar
    panel : SmoothingPanel
        Holds the method of a branch, and what a run pauses at.
    """

    def __init__(self, session: Session, commands: Commands, bar: TimelineBar, panel: SmoothingPanel):
        self._session, self._commands = session, commands
        self._document, self._smoothing = session.document, session.smoothing
        timeline = self._timeline = session.timeline
        self._bar, self._panel = bar, panel
        timeline.runs_changed.connect(self._show_runs)
        timeline.grown.connect(self._show_track)
        timeline.moved.connect(self._show_number)
        timeline.playing_changed.connect(lambda: bar.set_playing(timeline.playing))
        session.smoothing.hit.connect(self._on_hit)
        session.document.mesh_replaced.connect(self._on_another)
        session.selection.changed.connect(
            lambda: panel.breakpoint_form.set_chosen(session.selection.hex, session.selection.node)
        )
        panel.breakpoint_form.changed.connect(session.smoothing.break_at)
        bar.run_chosen.connect(lambda at: timeline.choose(session.history.records[at]))
        bar.number_chosen.connect(lambda number: timeline.go_soon(timeline.record, number))
        bar.pressed.connect(lambda name: self._on_pressed()[name]())
        bar.limit_changed.connect(self._set_limit)
        bar.speed_changed.connect(self._set_speed)
        settings = QSettings()
        session.history.limit = int(settings.value("history_megabytes", LIMIT >> 20)) << 20
        timeline.speed = int(settings.value("iterations_played", SPEED))
        self._show_settings()

    def handlers(self) -> dict[str, Callable]:
        """What its actions do, by id."""
        return {f"iteration_{name}": act for name, act in self._on_pressed().items() if name != "forget"}

    def offered(self) -> dict[str, bool]:
        """Which of its actions can be done now."""
        some = self._timeline.record is not None
        return {id: some and not (id == "iteration_branch" and self._session.opener.busy) for id in self.handlers()}

    def _on_pressed(self) -> dict[str, Callable]:
        timeline = self._timeline
        return {
            "first": lambda: timeline.step(-timeline.record.newest),
            "back": lambda: timeline.step(-1),
            "play": lambda: timeline.hold() if timeline.playing else timeline.play(),
            "on": lambda: timeline.step(1),
            "newest": timeline.go_to_newest,
            "branch": lambda: self._panel.request(self._commands.branch),
            "forget": lambda: timeline.forget(timeline.record),
        }

    def _show_runs(self) -> None:
        self._bar.set_runs([_said(record) for record in self._session.history.records])
        self._show_track()

    def _show_track(self) -> None:
        record, history = self._timeline.record, self._session.history
        if record is not None:
            self._bar.set_run(history.records.index(record))
            self._bar.set_track(record.newest, history.kept(record), record.pauses, history.bytes)
            self._bar.set_forgettable(not (self._smoothing.busy and record is self._smoothing.record))
        self._show_number()

    def _show_number(self) -> None:
        moment, record = self._timeline.moment, self._timeline.record
        here = moment is not None and moment.record is record
        self._bar.set_number(moment.number if here else None, self._timeline.live)

    def _on_hit(self, frame: Frame) -> None:
        iteration, hit = frame.iteration, frame.hit
        self._panel.set_status(iteration.number, iteration.seconds, f"Paused at a break-point: {hit.sentence}.")
        if hit.hexes:
            self._session.selection.choose(hit.hexes[0])
        elif hit.nodes:
            around = (self._document.now.mesh.hexes == hit.nodes[0]).any(axis=1)
            self._session.selection.choose(int(around.argmax()), hit.nodes[0])

    def _on_another(self) -> None:
        mesh = self._document.now.mesh
        self._panel.breakpoint_form.set_mesh(mesh.n_hexes, mesh.n_nodes)

    def _set_limit(self, megabytes: int) -> None:
        self._session.history.limit = megabytes << 20
        QSettings().setValue("history_megabytes", megabytes)
        self._show_settings()
        self._show_track()

    def _set_speed(self, speed: int) -> None:
        self._timeline.set_speed(speed)
        QSettings().setValue("iterations_played", speed)
        self._show_settings()

    def _show_settings(self) -> None:
        self._bar.set_settings(self._session.history.limit >> 20, self._timeline.speed)


def _said(record: Record) -> tuple[str, str]:
    """A run's name, and what to say of it."""
    parent = record.parent
    begun = f", begun at iteration {parent.number} of {parent.record.name}" if parent and parent.number else ""
    return record.name, f"{record.title}{begun}"
