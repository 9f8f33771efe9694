"""Explaining the end of a run: the lines between its result, the panel that explains it, and what follows from it."""

from __future__ import annotations

from collections.abc import Callable
from weakref import WeakKeyDictionary

from PySide6.QtWidgets import QDockWidget

from hexmend.advice import Advice, Suggestion, advise
from hexmend.optimise import Result
from hexmend_app.features.outcome.outcome_panel import OutcomePanel
from hexmend_app.features.smooth.smoothing_panel import SmoothingPanel
from hexmend_app.state.commands import Commands
from hexmend_app.state.history import Record
from hexmend_app.state.session import Session

_RUNNING = "A run is under way. When it ends, you will see here why it stopped and what to try next."


class Advising:
    """Explains the run that is gone through, shows what it left inverted, and chooses what is suggested.

    Parameters
    ----------
    session : Session
        The window's state.
    commands : Commands
    panel : OutcomePanel
    dock : QDockWidget
        The panel's; comes to the front as a run ends.
    smoothing_panel : SmoothingPanel
        Where suggestions are chosen.
    go_to : callable
        Brings an element before the camera.
    """

    def __init__(
        self,
        session: Session,
        commands: Commands,
        panel: OutcomePanel,
        dock: QDockWidget,
        smoothing_panel: SmoothingPanel,
        go_to: Callable[[int], object],
    ):
        self._session, self._commands = session, commands
        self._panel, self._dock, self._smoothing_panel = panel, dock, smoothing_panel
        self._go_to = go_to
        self._advice: WeakKeyDictionary[Record, Advice] = WeakKeyDictionary()
        self._idle: tuple[Record | None, str, Advice] | None = (
            None  # of a run without an iteration, which has no record
        )
        self._shown: Advice | None = None
        session.smoothing.ended.connect(self._on_ended)
        session.timeline.grown.connect(self._show)
        session.smoothing.phase_changed.connect(self._show)
        session.document.mesh_replaced.connect(self._on_another)
        for told in (session.opener.began, session.opener.ended, session.opener.cancelled, session.opener.failed):
            told.connect(self._enable)
        panel.chosen.connect(go_to)
        panel.show_requested.connect(self._show_elements)
        panel.suggestion_chosen.connect(lambda at: self._choose(self._shown.suggestions[at]))
        self._show()

    def _on_ended(self, result: Result) -> None:
        record, advice = self._session.smoothing.record, advise(result)
        if record in self._session.history.records:
            self._advice[record] = advice
        else:
            self._idle = (self._session.timeline.record, record.name, advice)
        self._show()
        self._dock.raise_()

    def _on_another(self) -> None:
        self._idle = None
        self._show()

    def _explained(self) -> tuple[str, Advice | None]:
        """The run that is gone through: its name, and what there is to say of its end."""
        record = self._session.timeline.record
        if self._idle is not None and (self._session.smoothing.busy or record is not self._idle[0]):
            self._idle = None
        if self._idle is not None:
            return self._idle[1:]
        return ("", None) if record is None else (record.name, self._advice.get(record))

    def _show(self) -> None:
        name, advice = self._explained()
        if advice is not None and advice is not self._shown:
            self._panel.show_advice(f"Why {name} stopped", advice)
        elif advice is None and self._session.smoothing.busy:
            self._panel.show_none(_RUNNING)
        elif advice is None:
            self._panel.show_none()
        self._shown = advice
        self._enable()

    def _enable(self) -> None:
        self._panel.set_busy(not self._session.editable)

    def _show_elements(self, hexes: list[int]) -> None:
        self._session.view.isolate(hexes)
        if len(hexes) == 1:
            self._go_to(hexes[0])

    def _choose(self, suggestion: Suggestion) -> None:
        """Go to where the suggestion begins, and choose its method; whatever it costs to run it is left to the user."""
        timeline = self._session.timeline
        record = timeline.record
        if self._idle is None:
            number = 0 if suggestion.undo else record.result
            if timeline.moment is None or (timeline.moment.record, timeline.moment.number) != (record, number):
                timeline.go(record, number)
        if suggestion.unpin.size:
            self._commands.pin(suggestion.unpin, False)
        smoother = suggestion.smoother
        self._smoothing_panel.choose(smoother.name, smoother.values(), suggestion.stop.values())
        self._smoothing_panel.tell(f"Chosen: {suggestion.title}. Run starts it.")
