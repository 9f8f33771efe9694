"""Explaining the end of a run: the lines between its result, the panel that explains it, and what follows from it."""

from __future__ import annotations

from collections.abc import Sequence

from hexmend.advice import Advice, Suggestion
from hexmend.run.recipe import Stage
from hexmend_app.feature import Action, Feature, Host, Panel, PanelPlace
from hexmend_app.features.outcome.outcome_panel import OutcomePanel
from hexmend_app.state.mesh.history import RunRecord

_RUNNING = "A run is under way. When it ends, you will see here why it stopped and what to try next."


class FeatureOutcome(Feature):
    """Explains the run that is gone through, shows what it left inverted, and chooses what is suggested."""

    order = 55

    def __init__(self, host: Host):
        super().__init__(host)
        session = self.session
        #: Of a run without an iteration, which has no record: the one before it, its name, and what there is to say.
        self._idle: tuple[RunRecord | None, str, Advice] | None = None
        self._shown: Advice | None = None
        panel = self.panel = OutcomePanel()
        panel.chosen.connect(session.selection.visit)
        panel.show_requested.connect(self._show_elements)
        panel.visit_requested.connect(self._visit_elements)
        panel.suggestion_chosen.connect(lambda at: self._choose(self._shown.suggestions[at]))
        session.run.ended.connect(lambda _: self._on_ended())
        session.document.mesh_replaced.connect(self._on_another)

    def actions(self) -> Sequence[Action]:
        """Ask why."""
        return (
            Action(
                id="why",
                text="Run summar&y",
                menu="Smooth",
                part=1,
                keys="Y",
                icon="help-circle-outline",
                help="Show why the run stopped, the remaining inverted hexes and what to try next.",
                handle=lambda: self.host.show_panel("outcome"),
                enabled=lambda: self._shown is not None,
            ),
        )

    def panels(self) -> Sequence[Panel]:
        """The explanation."""
        return (
            Panel(
                id="outcome",
                title="Outcome",
                widget=self.panel,
                place=PanelPlace.DRAWER,
                order=50,
                help="Why the run stopped, and what to try next.",
            ),
        )

    def refresh(self) -> None:
        """Explain the run that is gone through."""
        name, advice = self._explained()
        if advice is not None and advice is not self._shown:
            self.panel.show_advice(f"Why {name} stopped", advice)
        elif advice is None and self.session.run.busy:
            self.panel.show_none(_RUNNING)
        elif advice is None:
            self.panel.show_none()
        self._shown = advice
        self.panel.say_where(self._where())
        self.panel.set_busy(not self.session.editable)

    def _on_ended(self) -> None:
        record, advice = self.session.run.record, self.session.run.advice
        if record not in self.session.history.records:
            self._idle = (self.session.timeline.record, record.name, advice)

    def _on_another(self) -> None:
        self._idle = None

    def _explained(self) -> tuple[str, Advice | None]:
        """The run that is gone through: its name, and what there is to say of its end."""
        record = self.session.timeline.record
        if self._idle is not None and (self.session.run.busy or record is not self._idle[0]):
            self._idle = None
        if self._idle is not None:
            return self._idle[1:]
        return ("", None) if record is None else (record.name, record.advice)

    def _where(self) -> str:
        """Return the text for the mesh in the view if it is not the result of the explained run."""
        timeline = self.session.timeline
        record, moment = timeline.record, timeline.moment
        if self._idle is not None or record is None or record.result is None:
            return ""
        if moment is None:
            return "The mesh shown is none of this run's."
        if moment.record is record and moment.number == record.result:
            return ""
        if not moment.number:
            return "The mesh is shown as it was before the run."
        return f"The mesh is shown as it was at {moment.name}."

    def _show_elements(self, hexes: list[int]) -> None:
        self.session.view.isolate(hexes)
        if len(hexes) == 1:
            self.session.selection.visit(hexes[0])

    def _visit_elements(self, hexes: list[int]) -> None:
        self.session.view.isolate(hexes)
        self.session.selection.visit(*hexes)

    def _choose(self, suggestion: Suggestion) -> None:
        """Go to where the suggestion begins, and choose its method; whatever it costs to run it is left to the user."""
        timeline = self.session.timeline
        record = timeline.record
        if self._idle is None:
            number = 0 if suggestion.undo else record.result
            if timeline.moment is None or (timeline.moment.record, timeline.moment.number) != (record, number):
                timeline.go(record, number)
        if suggestion.unpin.size:
            self.session.commands.pin(suggestion.unpin, False)
        stage = Stage(suggestion.smoother, suggestion.stop)
        self.session.run_setup.choose(stage, f"Chosen: {suggestion.title}. Run starts it.")
