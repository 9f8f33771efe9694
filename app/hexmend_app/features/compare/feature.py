"""Methods on the same mesh, compared: the lines between their results, the table and the views."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

from hexmend.energy.norm import ObjectiveNorm
from hexmend.quality import objective
from hexmend.report import markdown, record_table, write_comparison
from hexmend.report.charts import ChartStyle
from hexmend.report.comparison import LINES
from hexmend.run.recipe import Stage
from hexmend.smoothers import METHODS, Smoother
from hexmend.study.table_row import common_norm
from hexmend_app.feature import Action, ChangeTracker, Feature, Host, Panel, PanelPlace, StatePart
from hexmend_app.features.compare.compare_panel import ComparePanel, ComparisonSettings
from hexmend_app.features.compare.comparison_table import INITIAL, ComparisonRow, title_of
from hexmend_app.state.mesh.document import State
from hexmend_app.state.run.comparison import MethodResult
from hexmend_app.state.session.user_events import TableExported
from hexmend_app.widgets.dialogs.export_dialog import TableDialog, answer
from hexmend_app.widgets.wording import counted

#: Methods that are ticked at first: the plain one, the fast one, an optimiser of the thesis, and the default.
TICKED = ("laplacian", "getme", "local-sd", "mend")

_KINDS = "Table (*.csv);;Markdown (*.md);;LaTeX (*.tex);;Everything, for programs (*.json)"


class FeatureCompare(Feature):
    """Has methods compared, and shows what they made of the mesh beside it."""

    order = 58

    def __init__(self, host: Host):
        super().__init__(host)
        session = self.session
        self._comparison, self._views = session.comparison, session.side_views
        self._seen = ChangeTracker()
        self._style = ChartStyle()  # what was called what in the last table
        panel = self.panel = ComparePanel(TICKED)
        panel.run_requested.connect(self._run)
        panel.cancel_requested.connect(self._comparison.cancel)
        panel.view_toggled.connect(self._toggle)
        panel.take_requested.connect(self._take)
        panel.wipe_toggled.connect(self._views.set_wiping)
        panel.save_requested.connect(self.ask)
        panel.offer_changed.connect(host.refresh_soon)

    def actions(self) -> Sequence[Action]:
        """Compare, and end that."""
        return (
            Action(
                id="compare",
                text="&Run the comparison",
                menu="Compare",
                keys="F6",
                icon="play",
                help="Run the methods that are ticked in the panel one after another; the mesh stays as it is.",
                handle=self.panel.run,
                enabled=lambda: self.panel.can_run,
            ),
            Action(
                id="cancel_comparison",
                text="&Cancel the comparison",
                menu="Compare",
                keys="Shift+F6",
                icon="stop",
                help="End the comparison after the iteration at hand, and keep what has been reached.",
                handle=self._comparison.cancel,
                enabled=lambda: self._comparison.busy and not self._comparison.ending,
            ),
        )

    def states(self) -> Sequence[StatePart]:
        """The selected methods, and the order of the table."""
        return (
            StatePart(name="compare", data=ComparisonSettings, to_data=self.panel.settings, restore=self.panel.restore),
        )

    def panels(self) -> Sequence[Panel]:
        """The table of methods."""
        return (
            Panel(
                id="compare",
                title="Compare",
                widget=self.panel,
                place=PanelPlace.DRAWER,
                order=20,
                help="What each method makes of the mesh, in a table and in views.",
            ),
        )

    def refresh(self) -> None:
        """Show what the methods reached, and what can be done with it."""
        comparison, views, session = self._comparison, self._views, self.session
        if self._seen.changed("table", comparison.results, comparison.initial, views.all, comparison.busy):
            norm = common_norm(one.row for one in comparison.results)
            entries = [self._initial(norm), *(self._entry(name, comparison.of(name), norm) for name in METHODS)]
            self.panel.set_entries(entries, views.full, comparison.busy)
        runnable = session.editable and not comparison.busy  # two at once would spoil each other's times
        self.panel.set_state(runnable, session.editable, bool(views.all), views.wipe is not None)
        self._say()

    def _close_results(self) -> None:
        """Close the views of what is about to be forgotten; others, such as those of iterations, stay."""
        results = [self._comparison.initial, *(one.state for one in self._comparison.results)]
        for number, shown in reversed(list(enumerate(self._views.all, 1))):
            if any(shown.state is state for state in results):
                self._views.close_view(number)

    # The table

    def _initial(self, norm: ObjectiveNorm) -> ComparisonRow:
        state = self._comparison.initial
        if state is None:
            return ComparisonRow(INITIAL, "The mesh as it is when the methods begin.", {})
        help = "The mesh as it was when the methods began."
        return ComparisonRow(INITIAL, help, _figures(state, norm), True, self._views.shows(state))

    def _entry(self, name: str, compared: MethodResult | None, norm: ObjectiveNorm) -> ComparisonRow:
        method = METHODS[name]
        if compared is None:
            return ComparisonRow(name, f"<b>{method.title}</b><br>{method.help}", {})
        row, state = compared.row, compared.state
        figures = {one.key: getattr(row, one.key, None) for one in LINES}
        record = figures | (_figures(state, norm) if state is not None else {}) | {"worse": row.worse}
        shown = state is not None and self._views.shows(state)
        return ComparisonRow(name, f"<b>{method.title}</b><br>{row.message}", record, state is not None, shown)

    def _say(self) -> None:
        comparison, done = self._comparison, len(self._comparison.results)
        at = comparison.progress
        if at is None:
            ended = f"{counted(done, 'method')} compared" if done else ""
            self.panel.set_status(f"{ended}, interrupted" if comparison.interrupted and ended else ended)
        elif comparison.ending:
            self.panel.set_status(f"Ending {title_of(at.method)} after this iteration…")
        elif at.iteration:
            additional = f"iteration {at.iteration:,}, {at.seconds:.1f} s"
            self.panel.set_status(f"{title_of(at.method)} ({at.at + 1} of {at.of}): {additional}")
        else:
            self.panel.set_status(f"{title_of(at.method)} ({at.at + 1} of {at.of}): preparing…")

    # What the user asks for

    def _run(self, names: list[str]) -> None:
        self.session.run_setup.use(lambda stage: self._start(names, stage))

    def _start(self, names: list[str], stage: Stage) -> None:
        if self.session.editable:
            smoothers = [self.session.run_setup.smoother_of(name) for name in names]
            self.session.commands.when_memory_suffices(smoothers, lambda: self._compare(smoothers, stage))

    def _compare(self, smoothers: list[Smoother], stage: Stage) -> None:
        self._close_results()
        self._comparison.start(smoothers, stage.stop)
        self.host.show_panel("compare")  # its key starts it from anywhere

    def _state_of(self, name: str) -> State:
        return self._comparison.initial if name == INITIAL else self._comparison.of(name).state

    def _toggle(self, name: str, on: bool) -> None:
        state = self._state_of(name)
        if on:
            self._views.show(title_of(name), state)
        else:
            self._views.close_view(1 + next(k for k, one in enumerate(self._views.all) if one.state is state))

    def _take(self, name: str) -> None:
        title = "go back to the compared mesh" if name == INITIAL else METHODS[name].title
        self.session.commands.take(title, self._state_of(name))

    # Files

    def ask(self) -> None:
        """Ask what is called what in the table and where it goes, and write it."""
        if given := answer(self.dialog()):
            path, self._style = given
            self.save(path, self._style)

    def dialog(self) -> TableDialog:
        """The dialog that asks: names are as they were last."""
        record = self._comparison.to_data().record()
        names = ["initial", *(row["method"] for row in record["rows"])]
        proposed = f"{self.host.stem}-comparison.csv"

        def text(style: ChartStyle) -> str:
            return markdown(record_table(record, style.names, style.title))

        title = record_table(record).title
        return TableDialog(text, "the table", proposed, _KINDS, self._style, title, names, self.host.dialog_parent)

    def save(self, path: str | Path, style: ChartStyle | None = None) -> bool:
        """Write the table of methods as CSV, Markdown, LaTeX or JSON, by the suffix; whether it was."""
        names, title = (None, None) if style is None else (style.names, style.title)
        written = self.host.try_and_report(
            "The table was not saved",
            lambda: write_comparison(Path(path), self._comparison.to_data().record(), names, title),
            f"Table of {counted(len(self._comparison.results), 'method')} saved to {path}",
        )
        if written:
            self.session.user_event.emit(TableExported(Path(path), names, title))
        return written


def _figures(state: State, norm: ObjectiveNorm) -> dict[str, Any]:
    """The figures of a mesh, its objective by the p and offset that the table compares by."""
    own = {"objective": objective(state.figures, *norm), "objective_formula": norm.formula}
    return state.summary.to_dict() | own
