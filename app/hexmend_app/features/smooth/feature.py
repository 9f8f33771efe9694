"""Smoothing: the selected method and its run."""

from __future__ import annotations

from collections.abc import Iterable
from typing import NamedTuple

from PySide6.QtGui import QGuiApplication

from hexmend.cli.commands.smooth.suggested_command import RunOptions, smooth_command
from hexmend.run.recipe import Recipe, Stage
from hexmend.smoothers import METHODS
from hexmend_app.feature import Action, ButtonAppearance, Feature, Host, Panel, PanelPlace, StatePart
from hexmend_app.features.smooth.smoothing_panel import SmoothingPanel
from hexmend_app.state.mesh.run_record import balances
from hexmend_app.state.run.breakpoints import Breakpoints
from hexmend_app.state.run.run_controller import Phase
from hexmend_app.state.run.worker import IterationFrame
from hexmend_app.state.settings import settings
from hexmend_app.translation import tr
from hexmend_app.widgets.error_report import report_of
from hexmend_app.widgets.inputs.saved_values import saved_values
from hexmend_app.widgets.wording import figure

#: Goal of Mend and metric of the colours.
_SCALED_JACOBIAN = "scaled-jacobian"


class RunState(NamedTuple):
    """Text, icon and help of the button that runs and pauses, and the ids of the commands that are possible."""

    text: str
    icon: str
    help: str
    allows: tuple[str, ...] = ()


_RUN = "Smooth the mesh with this method until a stopping criterion is met."

STATES = {
    "idle": RunState("Run", "play", _RUN, ("run", "step", "edit")),
    "preparing": RunState("Preparing", "timer-sand", "Preparing the method.", ("stop",)),
    "stopping": RunState("Stopping", "timer-sand", "Stopping the run."),
    "running": RunState("Pause", "pause", "Pause after this iteration.", ("run", "stop")),
    "paused": RunState("Resume", "play", "Continue the run.", ("run", "step", "stop", "reset", "edit")),
    "finished": RunState("Run", "play", _RUN, ("run", "step", "reset", "edit")),
}


class FeatureSmooth(Feature):
    """Starts, pauses and stops runs, and shows their progress."""

    def __init__(self, host: Host):
        super().__init__(host)
        session = self.session
        smoothing = self._smoothing = session.run
        self._hit: IterationFrame | None = None  # with the breakpoint at which the run is paused
        panel = self.panel = SmoothingPanel(session.run_setup)
        form = panel.breakpoint_form
        form.changed.connect(lambda: smoothing.set_breakpoints(Breakpoints(**form.values())))
        smoothing.show_every(settings.EVERY_ITERATION.get())
        smoothing.failed.connect(self._on_failed)
        smoothing.hit.connect(self._on_hit)

    def actions(self) -> Iterable[Action]:
        """Yield the actions that control a run."""
        yield Action(
            id="run",
            text=tr("&Run or pause"),
            menu="Smooth",
            keys="F5",
            icon="play",
            help=tr("Run the selected method; pause or resume a run."),
            handle=self.run_or_pause,
            enabled=lambda: self._ready() and self._allows("run"),
            appearance=self._run_face,
        )
        yield Action(
            id="step",
            text=tr("&Step"),
            menu="Smooth",
            keys="F10",
            icon="skip-next",
            help=tr("Run the number of iterations set in the panel Smooth, then pause."),
            handle=self.step,
            enabled=lambda: self._ready() and self._allows("step"),
        )
        yield Action(
            id="stop",
            text=tr("S&top"),
            menu="Smooth",
            keys="Shift+F5",
            icon="stop",
            help=tr("Stop the run after this iteration and keep its result."),
            handle=self._smoothing.stop,
            enabled=lambda: self._allows("stop"),
        )
        yield Action(
            id="reset",
            text=tr("R&eset"),
            menu="Smooth",
            keys="Ctrl+R",
            icon="restore",
            help=tr("Restore all node positions of the mesh as it was opened."),
            handle=self.session.commands.reset,
            enabled=lambda: self._ready() and self._allows("reset"),
        )
        yield from self._option_actions()

    def _option_actions(self) -> Iterable[Action]:
        """Yield the actions for options of runs, and for their command."""
        yield Action(
            id="every_iteration",
            text=tr("Show e&very iteration"),
            menu="Smooth",
            section=3,
            help=tr("Show every iteration; the run waits until it is drawn."),
            handle=self._show_every,
            checked=lambda: self._smoothing.shows_every,
            needs_mesh=False,
        )
        yield Action(
            id="copy_command",
            text=tr("&Copy as command"),
            menu="Smooth",
            section=3,
            help=tr("Copy the hexmend smooth command with this method, its parameters, limits and rules of motion."),
            handle=self._copy_command,
            enabled=lambda: self._ready() and self.session.document.path is not None,
        )

    def states(self) -> Iterable[StatePart]:
        """Yield the number of iterations of a step."""
        yield saved_values("steps", iterations=self.panel.steps)

    def panels(self) -> Iterable[Panel]:
        """Yield the panel with the method and its parameters."""
        yield Panel(
            id="run",
            title=tr("Smooth"),
            widget=self.panel,
            place=PanelPlace.TOOLS,
            tab=tr("Smooth"),
            order=10,
            help=tr("The smoothing method, its parameters and its stopping criteria."),
        )

    def refresh(self) -> None:
        """Show the progress of the run, or the run that produced the displayed mesh."""
        session, phase = self.session, self._smoothing.phase
        self.panel.setEnabled(self._ready())
        if session.document.is_open:
            mesh, form = session.document.now.mesh, self.panel.breakpoint_form
            self.panel.show_rules(mesh)
            if self._seen.changed("mesh", session.document.start):
                form.set_declarations(Breakpoints.numbered(mesh.n_elements, mesh.n_nodes))
            if form.values() != self._smoothing.breakpoints.values():
                form.set_values(self._smoothing.breakpoints.values())
        if phase is not Phase.PAUSED:
            self._hit = None
        editable = self._allows("edit")
        self.panel.set_editable(editable, editable and phase is not Phase.PAUSED)  # a run keeps its rules
        self._show_busy()
        self.panel.set_status(*self._status())

    def run_or_pause(self) -> None:
        """Run, pause or resume, depending on the state of the run; with invalid values, show the first of them."""
        phase, setup = self._smoothing.phase, self.session.run_setup
        if phase is Phase.RUNNING:
            self._smoothing.pause()
        elif self._allows("run") and (stage := setup.checked_stage()) is not None:
            if phase is Phase.PAUSED:
                self._change(stage)
                self._smoothing.resume()
            elif self.memory_suffices(stage.smoother):
                self.session.commands.run(stage)

    def step(self) -> None:
        """Run the number of iterations of a step, if the state of the run allows it."""
        if self._allows("step") and (stage := self.session.run_setup.checked_stage()) is not None:
            if self._smoothing.phase is Phase.PAUSED:
                self._change(stage)
            elif not self.memory_suffices(stage.smoother):
                return
            self.session.commands.step(stage, self.panel.steps.value())

    def _change(self, stage: Stage) -> None:
        """Continue the paused run with a stage, if it differs from the active one."""
        setup = self.session.run_setup
        if stage != setup.active_stage:
            setup.active_stage = stage
            self._smoothing.change(stage)

    def _state(self) -> RunState:
        document, phase = self.session.document, self._smoothing.phase
        moved = document.is_open and document.now is not document.start
        return STATES["finished" if phase is Phase.IDLE and moved else phase.value]

    def _allows(self, command: str) -> bool:
        return command in self._state().allows

    def _run_face(self) -> ButtonAppearance:
        state = self._state()
        return ButtonAppearance(tr(state.text), state.icon, tr(state.help))

    def _ready(self) -> bool:
        return self.session.document.is_open and not self.session.opener.busy

    def _status(self) -> tuple[int | None, float | None, str]:
        """Return iterations, seconds and a sentence about the active run, or the run that led to the displayed mesh."""
        phase, record = self._smoothing.phase, self._smoothing.record
        if phase is Phase.STOPPING:
            started = self._smoothing.record.newest > 0
            when = tr("after this iteration") if started else tr("when the method is ready, before its first iteration")
            return None, None, tr("Stopping: the run ends {when}.", when=when)
        if phase is Phase.PREPARING:
            return None, None, tr("Preparing the method.")
        if phase in (Phase.RUNNING, Phase.PAUSED):
            row = record.rows[-1]
            return row["iteration"], row["seconds"], " ".join(filter(None, (self._stage(row), _balance_text(row))))
        iteration, reason = self.session.timeline.shown_iteration, self.session.run_setup.reason
        if iteration is None or (not iteration.number and iteration.record.result != 0):
            return None, None, reason or self._text_without_step()
        if iteration.record.holds_times:
            return None, None, reason or f"{iteration.name}."
        row = iteration.record.rows[iteration.number]
        ended = iteration.record.message if iteration.number == iteration.record.result else ""
        return row["iteration"], row["seconds"], reason or ended

    def _text_without_step(self) -> str:
        """Return the message of a run that was stopped before its first iteration, while the mesh is unchanged."""
        record = self._smoothing.record
        without_step = self._smoothing.phase is Phase.FINISHED and record.newest < 1
        return record.message if without_step and self.session.document.now is record.start else ""

    def _stage(self, row: dict) -> str:
        if self._hit is not None:
            return tr("Paused at a breakpoint: {sentence}.", sentence=self._hit.hit.sentence)
        work = self._smoothing.work
        if isinstance(work, Recipe) and "stage" in row:
            return tr(
                "Stage {row} of {count}: {title}.",
                row=row["stage"],
                count=len(work.stages),
                title=METHODS[row["method"]].title,
            )
        return ""

    def _show_busy(self) -> None:
        phase = self._smoothing.phase
        if not self._seen.changed("phase", phase):
            return
        if phase is Phase.STOPPING:
            self.host.busy.show_work("run", tr("Stopping…"))
        elif phase is Phase.PREPARING:
            self._colour_by_goal()
            help = tr("Stop the run before its first iteration (Shift+F5).")
            self.host.busy.show_work("run", tr("Preparing the method…"), tr("Stop"), help, self._smoothing.stop)
        else:
            self.host.busy.done("run")  # a busy animation would slow down a run that is visible anyway

    def _colour_by_goal(self) -> None:
        """Let the colours show what a run raises, if that is the scaled Jacobian and they show q."""
        goal, view = getattr(self._smoothing.work, "goal", ""), self.session.view
        if goal == _SCALED_JACOBIAN and view.look.colours.metric == "q":
            view.change(colours={"metric": _SCALED_JACOBIAN})

    def _show_every(self, on: bool) -> None:
        """Show every iteration or the newest, and store the choice."""
        self._smoothing.show_every(on)
        settings.EVERY_ITERATION.set(on)

    def _copy_command(self) -> None:
        """Copy the command that runs the stage on the file of the mesh."""
        if (stage := self.session.run_setup.checked_stage()) is None:
            return
        path = self.session.document.path
        output = path.with_name(f"{self.host.default_file_stem}-smoothed{path.suffix or '.vtu'}")
        command = smooth_command(stage, str(path), str(output), RunOptions(self.session.run_setup.rules))
        QGuiApplication.clipboard().setText(command)
        self.host.messages.show_info(tr("Copied: {command}", command=command))

    def _on_failed(self, error: Exception) -> None:
        record = self.session.run.record
        kept = record is not None and record.result
        text = str(error).rstrip(".")
        if kept:
            text = tr(
                "{error}. The mesh was set to iteration {iteration}, the last valid one.", error=text, iteration=kept
            )
        else:
            text = tr("{error}. The mesh is unchanged.", error=text)
        begun = record is not None and bool(record.rows)  # rules of motion are applied before that
        title = tr("The method failed") if begun else tr("Run not started")
        self.host.messages.show_error(title, text, report_of(error))

    def _on_hit(self, frame: IterationFrame) -> None:
        self._hit, hit = frame, frame.hit
        if hit.hexes:
            self.session.selection.choose(hit.hexes[0])
        elif hit.nodes:
            around = (self.session.document.now.mesh.elements == hit.nodes[0]).any(axis=1)
            self.session.selection.choose(int(around.argmax()), hit.nodes[0])


def _balance_text(row: dict) -> str:
    """Describe an iteration that raises the minima, while the objective may rise; "" for others."""
    if not balances(row):
        return ""
    return tr(
        "Raising the minima: scaled Jacobian {jacobian}, q(H) {quality}. The objective may rise.",
        jacobian=figure(row["least"]),
        quality=figure(row["least_q"]),
    )
