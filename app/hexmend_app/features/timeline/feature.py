"""Timeline: navigation in the iterations of runs, in the bar below the view."""

from __future__ import annotations

from collections.abc import Callable, Iterable

from hexmend_app.feature import Action, ButtonAppearance, Feature, Host, Panel, PanelPlace
from hexmend_app.features.timeline.timeline_bar import TimelineBar
from hexmend_app.state.mesh.run_record import RunRecord
from hexmend_app.state.run.run_controller import Phase
from hexmend_app.state.settings import settings
from hexmend_app.translation import tr
from hexmend_app.widgets.wording import counted

_STEPS = (
    ("first", "&Start of the run", "Alt+Home", "skip-backward", "Show the mesh before the run."),
    ("back", "Pre&vious iteration", ",", "step-backward", "Show the previous iteration."),
    ("play", "&Play/Pause", "K", "play", "Play or pause the iterations."),
    ("on", "&Next iteration", ".", "step-forward", "Show the next iteration."),
    ("newest", "&Latest iteration", "Alt+End", "skip-forward", "Show the latest iteration and follow the run."),
    ("branch", "&Branch from here", "Ctrl+F5", "source-branch", "Start a new run from the displayed iteration."),
)

#: Number of times left out that a message explains.
_NAMED = 3


class FeatureTimeline(Feature):
    """Navigates in the iterations of runs, and starts branches."""

    def __init__(self, host: Host):
        super().__init__(host)
        session = self.session
        self._smoothing = session.run
        timeline = self._timeline = session.timeline
        bar = self.panel = TimelineBar()
        bar.runs.activated.connect(lambda at: timeline.choose(session.history.records[at]))
        bar.slider.valueChanged.connect(lambda number: timeline.go_soon(timeline.record, number))
        bar.delete_requested.connect(lambda: timeline.delete(timeline.record))
        bar.limit_changed.connect(self._set_limit)
        bar.speed_changed.connect(self._set_speed)
        self._reader = session.time_reader
        session.history.set_limit(settings.HISTORY_MEGABYTES.get() << 20)
        timeline.speed = settings.ITERATIONS_PLAYED.get()
        self._show_settings()

    def actions(self) -> Iterable[Action]:
        """Yield the actions that show iterations, play them, and start a branch."""
        for (name, text, keys, icon, help), handle in zip(_STEPS, self._handles(), strict=True):
            yield Action(
                id=f"iteration_{name}",
                text=tr(text),
                menu="Timeline",
                section=int(name == "branch"),
                keys=keys,
                icon=icon,
                help=tr(help),
                handle=handle,
                enabled=lambda name=name: self._timeline.record is not None and self._can()[name],
                appearance=self._play_appearance if name == "play" else None,
            )

    def panels(self) -> Iterable[Panel]:
        """Yield the bar below the view."""
        yield Panel(
            id="timeline",
            title=tr("Timeline"),
            widget=self.panel,
            place=PanelPlace.BAR,
            help=tr("Navigate through the iterations of a run."),
        )

    def refresh(self) -> None:
        """Show the runs, and the run and iteration displayed."""
        timeline, history = self._timeline, self.session.history
        self.panel.setVisible(self.session.document.is_open)
        smoothing = self._smoothing
        failed = smoothing.phase is Phase.IDLE and smoothing.record is not None  # a run that ends otherwise is finished
        inverted = self.session.document.now.summary.inverted if self.session.document.is_open else 0
        self.panel.run_bar.set_state(smoothing.phase, smoothing.outcome, failed, smoothing.undone, inverted)
        if self._seen.changed("runs", tuple(history.records)):
            self.panel.set_runs([_text(record) for record in history.records])
        record = timeline.record
        if record is not None:
            self.panel.runs.setCurrentIndex(history.records.index(record))
            active = self._smoothing.busy and record is self._smoothing.record
            if self._seen.changed("track", record, record.newest, history.bytes, active, len(record.pauses)):
                self.panel.set_labels(record.unit, record.labels())
                stored = len(history.recorded_numbers(record))
                self.panel.set_track(record.newest, stored, record.pauses, history.bytes)
                self.panel.delete.setEnabled(not active)
        self.panel.set_number(self._number)
        self._show_reading()

    @property
    def _number(self) -> int | None:
        """The displayed iteration of the run; None if the displayed mesh is not one of its iterations."""
        iteration = self._timeline.shown_iteration
        return iteration.number if iteration is not None and iteration.record is self._timeline.record else None

    def _can(self) -> dict[str, bool]:
        """Return which actions are possible; there is a run."""
        timeline, number = self._timeline, self._number
        newest, going = timeline.record.newest, self._smoothing.busy and timeline.record is self._smoothing.record
        return {
            "first": number != 0,
            "back": number != 0,
            "play": True,
            "on": number != newest and not timeline.live,
            "newest": not timeline.live and (number != newest or going),
            "branch": not self.session.opener.busy,
        }

    def _play_appearance(self) -> ButtonAppearance:
        if self._timeline.playing:
            return ButtonAppearance(tr("Pause"), "pause", tr("Pause the playback."))
        return ButtonAppearance(tr("Play"), "play", tr("Play the iterations."))

    def _handles(self) -> tuple[Callable[[], object], ...]:
        """Return the functions of the actions, in their order."""
        timeline = self._timeline
        return (
            lambda: timeline.step(-timeline.record.newest),
            lambda: timeline.step(-1),
            lambda: timeline.pause() if timeline.playing else timeline.play(),
            lambda: timeline.step(1),
            timeline.go_to_newest,
            self._branch,
        )

    def _branch(self) -> None:
        stage = self.session.run_setup.checked_stage()
        if stage is not None and self.memory_suffices(stage.smoother):
            self.session.commands.branch(stage)

    def _set_limit(self, megabytes: int) -> None:
        self.session.history.set_limit(megabytes << 20)
        settings.HISTORY_MEGABYTES.set(megabytes)
        self._show_settings()
        self._seen.forget()
        self.host.refresh_soon()

    def _set_speed(self, speed: int) -> None:
        self._timeline.set_speed(speed)
        settings.ITERATIONS_PLAYED.set(speed)
        self._show_settings()

    def _show_reading(self) -> None:
        """Show the progress of reading the times of a case, and then which of them are left out."""
        reader, busy = self._reader, self.host.busy
        if not self._seen.changed("times", reader.last_time, reader.errors):
            return
        if reader.last_time:
            text = tr("Reading time steps of the case, {time}…", time=reader.last_time)
            busy.show_work("times", text, tr("Stop"), tr("Keep the time steps read so far."), reader.cancel)
        else:
            busy.done("times")
        if errors := reader.errors:
            first = " ".join(f"{error.problem}. {error.remedy}".strip() for error in errors[:_NAMED])
            more = tr(" And {count} more.", count=len(errors) - _NAMED) if len(errors) > _NAMED else ""
            title = tr("{count} of the case skipped", count=counted(len(errors), "time"))
            self.host.messages.show_warning(title, f"{first}{more}")

    def _show_settings(self) -> None:
        self.panel.set_settings(self.session.history.limit >> 20, self._timeline.speed)


def _text(record: RunRecord) -> tuple[str, str]:
    """Return the name of a run and its tooltip."""
    parent = record.parent
    origin = (
        tr(", started at iteration {number} of {name}", number=parent.number, name=parent.record.name)
        if parent and parent.number
        else ""
    )
    return record.name, f"{tr(record.title)}{origin}"
