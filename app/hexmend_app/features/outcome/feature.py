"""Outcome of a run: reason of the end, remaining bad hexes, and suggestions."""

from __future__ import annotations

from collections.abc import Iterable
from functools import partial

import numpy as np

from hexmend.advice import Advice, Suggestion
from hexmend.quality import Summary
from hexmend.quality.file_ids import hex_ids
from hexmend.run.recipe import Stage
from hexmend_app.feature import Action, Feature, Host, Panel, PanelPlace
from hexmend_app.features.outcome.outcome_panel import OutcomePanel
from hexmend_app.state.mesh.run_record import RunRecord
from hexmend_app.translation import tr
from hexmend_app.widgets.wording import counted, duration, figure

#: Rings of hexes around the inverted ones whose nodes are unpinned where the part of the mesh was too small.
_RINGS = 2

_RUNNING = "A run is in progress. When it ends, this panel shows why, and what to try next."


class FeatureOutcome(Feature):
    """Explains the end of the run in the timeline, shows its bad hexes, and applies suggestions."""

    def __init__(self, host: Host):
        super().__init__(host)
        session = self.session
        #: The last run if it made no iteration and so has no record: the record before it, its name, its explanation.
        self._empty_run: tuple[RunRecord | None, str, Advice] | None = None
        self._notice: tuple[str, str] | None = None  # title and text of the message on the last run
        panel = self.panel = OutcomePanel()
        panel.chosen.connect(session.selection.visit)
        panel.show_requested.connect(self._isolate)
        panel.suggestion_chosen.connect(lambda index: self._apply(self._shown.suggestions[index]))
        session.run.ended.connect(lambda _: self._on_ended())
        session.document.mesh_replaced.connect(self._on_mesh_replaced)
        self._shown: Advice | None = None

    def actions(self) -> Iterable[Action]:
        """Yield the action that shows the panel."""
        yield Action(
            id="why",
            text=tr("Run summar&y"),
            menu="Smooth",
            section=1,
            keys="Shift+Y",
            icon="help-circle-outline",
            help=tr("Show why the run stopped, the remaining invalid hexes and what to try next."),
            handle=lambda: self.host.show_panel("outcome"),
            enabled=lambda: self._shown is not None,
        )

    def panels(self) -> Iterable[Panel]:
        """Yield the panel that explains a run."""
        yield Panel(
            id="outcome",
            title=tr("Run summary"),
            widget=self.panel,
            place=PanelPlace.DRAWER,
            tab=tr("Convergence"),
            order=50,
            help=tr("Why the run stopped and what to try next."),
        )

    def refresh(self) -> None:
        """Explain the run of the timeline; the message on a run whose result is undone is removed."""
        if self._notice is not None and self.session.run.undone:
            self.host.messages.remove(*self._notice)
            self._notice = None
        name, advice = self._explanation()
        if advice is not None and advice is not self._shown:
            ids = hex_ids(self.session.document.now.mesh)
            self.panel.show_advice(tr("Why {name} stopped", name=name), advice, ids)
        elif advice is None and self.session.run.busy:
            self.panel.show_hint(tr(_RUNNING))
        elif advice is None:
            self.panel.show_hint()
        self._shown = advice
        self.panel.set_busy(not self.session.editable)

    def _on_ended(self) -> None:
        record, advice = self.session.run.record, self.session.run.advice
        if record not in self.session.history.records:
            self._empty_run = (self.session.timeline.record, record.name, advice)
        elif record.end is not None:
            title, text = self._notice = notice(record, record.start.summary, record.end.summary)
            better = (tr("Go to {number}", number=record.better), partial(self._go_to_better, record))
            choices = (
                *([] if record.better is None else [better]),
                (tr("Compare"), partial(self._compare, record)),
                (tr("Undo"), partial(self._do, "undo", record)),
                (tr("Save"), partial(self._do, "save", record)),
            )
            self.host.messages.show_result(title, text, choices if record.result else ())

    def _do(self, action: str, record: RunRecord) -> None:
        """Trigger an action, if the result of a run is still the last change of the mesh."""
        if self.session.document.recorded is record.end:
            self.host.action(action).trigger()
        else:
            self.host.messages.show_info(tr("The mesh has changed since {name} ended.", name=record.name))

    def _go_to_better(self, record: RunRecord) -> None:
        """Show the iteration that the method ranks higher than the one at which the user stopped the run."""
        if record in self.session.history.records:
            self.session.timeline.go(record, record.better)

    def _compare(self, record: RunRecord) -> None:
        """Show the mesh before a run next to its result."""
        self.session.side_views.show(tr("before {name}", name=record.name), record.start)

    def _on_mesh_replaced(self) -> None:
        self._empty_run = None

    def _explanation(self) -> tuple[str, Advice | None]:
        """Return name and explanation of the run of the timeline, or of a later run without iterations."""
        record = self.session.timeline.record
        if self._empty_run is not None and (self.session.run.busy or record is not self._empty_run[0]):
            self._empty_run = None
        if self._empty_run is not None:
            return self._empty_run[1:]
        return ("", None) if record is None else (record.name, record.advice)

    def _isolate(self, hexes: list[int]) -> None:
        self.session.view.isolate(hexes)
        self.session.selection.visit(*hexes)

    def _apply(self, suggestion: Suggestion) -> None:
        """Show the mesh from which a suggestion starts, and select its method without running it."""
        timeline = self.session.timeline
        record = timeline.record
        if self._empty_run is None:
            number = 0 if suggestion.undo else record.result
            shown = timeline.shown_iteration
            if shown is None or (shown.record, shown.number) != (record, number):
                timeline.go(record, number)
        if suggestion.unpin.size:
            self.session.commands.pin(suggestion.unpin, False)
        if suggestion.widen:
            self.session.commands.pin(self._nodes_around_inverted(), False)
        if suggestion.rules is not None:
            self.session.run_setup.set_rules(suggestion.rules)
        stage = Stage(suggestion.smoother, suggestion.stop)
        self.session.run_setup.choose(stage, tr("Selected: {title}. Press Run to start.", title=suggestion.title))

    def _nodes_around_inverted(self) -> np.ndarray:
        """Return the nodes of the hexes that are still inverted, and of rings of hexes around them, (k,) int64."""
        mesh, advice = self.session.document.now.mesh, self._shown
        inverted = np.concatenate([advice.locked, advice.unlocked])
        return np.unique(mesh.elements[mesh.topology.hexes_around(inverted, _RINGS)])


def notice(record: RunRecord, before: Summary, after: Summary) -> tuple[str, str]:
    """Return title and text of the notice.

    Parameters
    ----------
    record : RunRecord
        The run, which has ended with a result.
    before, after : Summary
        Of the mesh before the run and of its result.
    """
    if not record.result:
        return tr("Initial mesh kept: no iteration was better"), record.message
    inverted, invalid = (
        figure(now) if then == now else f"{figure(then)} → {figure(now)}"
        for then, now in ((before.inverted, after.inverted), (before.invalid, after.invalid))
    )
    counts = tr("{inverted} inverted · {invalid} invalid", inverted=inverted, invalid=invalid)
    minima = tr("q min {q} · scaled Jacobian min {j}", q=figure(after.q_min), j=figure(after.scaled_jacobian_min))
    effort = f"{counted(record.newest, 'iteration')} · {duration(record.rows[-1]['seconds'])}"
    reason = record.message.partition(". ")[0].rstrip(".")
    kept = "" if record.result == record.newest else tr(" · iteration {number} was kept", number=record.result)
    return f"{counts} · {minima}", f"{effort} · {reason}{kept}"
