"""Feature that compares methods and runs on the same mesh."""

from __future__ import annotations

from collections.abc import Iterable
from html import escape
from pathlib import Path
from typing import Any

from hexmend.energy.norm import ObjectiveNorm
from hexmend.quality import objective, regressions
from hexmend.report.comparison import LINES, write_comparison
from hexmend.smoothers import METHODS
from hexmend.study.compare import common_norm
from hexmend_app.feature import Action, Feature, Host, Panel, PanelPlace, StatePart
from hexmend_app.features.compare.compare_panel import ComparePanel, ComparisonSettings
from hexmend_app.features.compare.comparison_table import INITIAL, ComparisonRow, title_of
from hexmend_app.state.mesh.document import MeasuredMesh
from hexmend_app.state.mesh.run_record import RunRecord
from hexmend_app.state.run.comparison import MethodResult
from hexmend_app.state.run.run_setup import rules_text, settings_text
from hexmend_app.translation import tr
from hexmend_app.widgets.dialogs.questions import ask_to_save
from hexmend_app.widgets.wording import counted, duration

#: Methods selected by default: the simplest, a fast one, an optimiser of the thesis, and the default method.
TICKED = ("laplacian", "getme", "local-sd", "mend")


class FeatureCompare(Feature):
    """Runs comparisons, and shows their results and those of all runs in a table and in views."""

    def __init__(self, host: Host):
        super().__init__(host)
        session = self.session
        self._comparison, self._views = session.comparison, session.side_views
        panel = self.panel = ComparePanel(TICKED)
        panel.model.view_toggled.connect(self._toggle)
        panel.model.ticked.connect(host.refresh_soon)
        panel.use_requested.connect(self._use)
        panel.save_button.clicked.connect(self.ask)

    def actions(self) -> Iterable[Action]:
        """Yield the actions that run and cancel a comparison."""
        yield Action(
            id="compare",
            text=tr("Co&mpare methods"),
            menu="Compare",
            keys="F6",
            icon="play",
            help=tr("Run the methods selected in the panel in turn. The mesh does not change."),
            handle=self.run,
            enabled=lambda: self._runnable and bool(self.panel.model.ticks),
        )
        yield Action(
            id="cancel_comparison",
            text=tr("&Cancel comparison"),
            menu="Compare",
            keys="Shift+F6",
            icon="stop",
            help=tr("Stop the comparison after the current iteration and keep the results."),
            handle=self._comparison.cancel,
            enabled=lambda: self._comparison.busy and not self._comparison.ending,
        )

    def states(self) -> Iterable[StatePart]:
        """Yield the selected methods, and the order of the table."""
        yield StatePart(
            name="compare", data=ComparisonSettings, to_data=self.panel.settings, restore=self.panel.restore
        )

    def panels(self) -> Iterable[Panel]:
        """Yield the panel of methods."""
        yield Panel(
            id="compare",
            title=tr("Compare"),
            widget=self.panel,
            place=PanelPlace.DRAWER,
            order=20,
            help=tr("Results of methods and of all runs in a table and in views, and which of them dominate."),
        )

    def refresh(self) -> None:
        """Show results and progress."""
        comparison, views, session = self._comparison, self._views, self.session
        shown = self.panel.isVisible() and session.document.is_open
        runs = [one for one in session.history.records if one.rows and not one.holds_times] if shown else []
        state = [(one, one.newest, one.end) for one in runs]
        if self._seen.changed("table", comparison.results, comparison.initial, views.all, comparison.busy, state):
            norm = common_norm(one.row for one in comparison.results)
            methods = [self._entry(name, comparison.of(name), norm) for name in METHODS]
            rows = [self._initial(norm), *(self._run_entry(one, norm) for one in runs), *methods]
            self.panel.set_entries(rows, views.full, comparison.busy)
        self.panel.set_editable(session.editable)
        self._show_status()

    def _close_results(self) -> None:
        """Close the views of the previous results."""
        results = [self._comparison.initial, *(one.state for one in self._comparison.results)]
        for number, shown in reversed(list(enumerate(self._views.all, 1))):
            if any(shown.state is state for state in results):
                self._views.close_view(number)

    # The table

    @property
    def _initial_state(self) -> MeasuredMesh | None:
        """Mesh from which the compared methods started, else that at the start; None without a mesh."""
        document = self.session.document
        return self._comparison.initial or (document.start if document.is_open else None)

    def _initial(self, norm: ObjectiveNorm) -> ComparisonRow:
        state = self._initial_state
        if state is None:
            return ComparisonRow(INITIAL, tr("The mesh from which the methods start."), {})
        help = tr("The mesh from which the methods started.")
        return ComparisonRow(INITIAL, help, _mesh_values(state, norm), True, self._views.shows(state))

    def _run_entry(self, record: RunRecord, norm: ObjectiveNorm) -> ComparisonRow:
        """Return the row of a run: its result, or while it is active, its newest iteration."""
        last, end = record.rows[-1], record.end
        values = {one.key: last.get(one.key) for one in LINES if one.key != "objective"}
        values |= {"iterations": record.newest, "kept": record.result}
        values["seconds_per_iteration"] = last["seconds"] / record.newest if record.newest else None
        values["outcome"] = "" if record.outcome is None else record.outcome.key
        if end is not None:
            values |= _mesh_values(end, norm) | {"worse": regressions(record.start.summary, end.summary)}
        help = f"<b>{escape(record.name)}</b><br>{escape(record.settings)}<br>{escape(record.message)}"
        return ComparisonRow(_key(record), help, values, end is not None, end is not None and self._views.shows(end))

    def _entry(self, name: str, result: MethodResult | None, norm: ObjectiveNorm) -> ComparisonRow:
        method = METHODS[name]
        if result is None:
            return ComparisonRow(name, f"<b>{tr(method.title)}</b><br>{tr(method.help)}", {})
        row, state = result.row, result.state
        values = {one.key: getattr(row, one.key, None) for one in LINES} | {"kept": row.kept}
        record = values | (_mesh_values(state, norm) if state is not None else {}) | {"worse": row.worse}
        shown = state is not None and self._views.shows(state)
        recipe = None if state is None else self._comparison.recipe_of(state)
        settings = "" if recipe is None else "; ".join(filter(None, (settings_text(recipe), rules_text(recipe.rules))))
        help = f"<b>{tr(method.title)}</b><br>{escape(settings)}<br>{row.message}"
        return ComparisonRow(name, help, record, state is not None, shown)

    def _show_status(self) -> None:
        comparison, progress = self._comparison, self._comparison.progress
        if progress is None:
            interrupted = tr(", interrupted") if comparison.interrupted else ""
            count = len(comparison.results)
            self.panel.set_status(
                tr("{count} compared{interrupted}", count=counted(count, "method"), interrupted=interrupted)
                if count
                else ""
            )
        elif comparison.ending:
            self.panel.set_status(tr("Stopping {title} after this iteration…", title=title_of(progress.method)))
        else:
            step = (
                tr("iteration {number:,}, {time}", number=progress.iteration, time=duration(progress.seconds))
                if progress.iteration
                else tr("preparing…")
            )
            self.panel.set_status(
                tr(
                    "{title} ({number} of {of}): {step}",
                    title=title_of(progress.method),
                    number=progress.at + 1,
                    of=progress.of,
                    step=step,
                )
            )

    # Requests of the user

    @property
    def _runnable(self) -> bool:
        return self.session.editable and not self._comparison.busy  # a second comparison would distort the times

    def run(self) -> None:
        """Run the selected methods; with invalid limits, show them."""
        setup, names = self.session.run_setup, [name for name in METHODS if name in self.panel.model.ticks]
        if (stage := setup.checked_stage()) is None or not self._runnable:
            return
        smoothers = [setup.smoother_of(name) for name in names]
        if self.memory_suffices(*smoothers):
            self._close_results()
            self.session.end_previews()
            self._comparison.start(smoothers, stage.stop, setup.rules)
            self.host.show_panel("compare")  # its key starts it from anywhere

    def _state_of(self, name: str) -> MeasuredMesh:
        if name == INITIAL:
            return self._initial_state
        record = self._run_of(name)
        return self._comparison.of(name).state if record is None else record.end

    def _run_of(self, name: str) -> RunRecord | None:
        """Return the run of a row; None for a method and the initial mesh."""
        return next((one for one in self.session.history.records if _key(one) == name), None)

    def _toggle(self, name: str, on: bool) -> None:
        state = self._state_of(name)
        if on:
            self._views.show(title_of(name), state)
        else:
            self._views.close_view(1 + next(k for k, one in enumerate(self._views.all) if one.state is state))

    def _use(self, name: str) -> None:
        record = self._run_of(name)
        if record is not None:
            self.session.timeline.choose(record)
            return
        title = "restore initial mesh" if name == INITIAL else METHODS[name].title
        self.session.commands.adopt_positions(title, self._state_of(name))

    # Files

    def ask(self) -> None:
        """Ask for the file of the table, and write it."""
        kinds = tr("Table (*.csv);;Markdown (*.md);;LaTeX (*.tex);;All data (*.json)")
        name = f"{self.host.default_file_stem}-comparison.csv"
        if path := ask_to_save(self.host.dialog_parent, tr("Save table as"), name, kinds):
            self.save(path)

    def save(self, path: str | Path) -> bool:
        """Write the table of methods as CSV, Markdown, LaTeX or JSON, by the suffix; return True on success."""
        subject = tr("Table of {count}", count=counted(len(self._comparison.results), "method"))
        return self.write_file(subject, path, lambda at: write_comparison(at, self._comparison.data.record()))


def _key(record: RunRecord) -> str:
    """Return the name of the row of a run, which no method has."""
    return tr("Run: {name}", name=record.name)


def _mesh_values(state: MeasuredMesh, norm: ObjectiveNorm) -> dict[str, Any]:
    """Return the values of a mesh, with the objective in the norm of the table."""
    norm_values = {"objective": objective(state.quality, *norm), "objective_formula": norm.formula}
    return state.summary.to_dict() | norm_values
