"""Histogram feature: connects the mesh and its snapshots to the histogram."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np

from hexmend.boundary.displacement import DISPLACEMENT_QUANTITIES
from hexmend.quality import measure
from hexmend.report.charts import ChartStyle
from hexmend_app.feature import ChangeTracker, Feature, Host, Panel, PanelPlace, StatePart
from hexmend_app.features.histogram.head import HistogramSettings
from hexmend_app.features.histogram.histogram_file import figure, write_histogram
from hexmend_app.features.histogram.panel import QualityHistogram
from hexmend_app.state.mesh.document import State
from hexmend_app.state.mesh.hex_groups import hexes_of_group
from hexmend_app.state.mesh.metric_cache import metric_values
from hexmend_app.state.mesh.snapshots import Snapshot
from hexmend_app.state.session.user_events import FileExported
from hexmend_app.theme.palette import BLUE, GREY, KEPT
from hexmend_app.widgets.dialogs.export_dialog import ChartDialog, answer

_KINDS = "SVG figure (*.svg);;PDF figure (*.pdf);;PNG picture (*.png);;Counts (*.csv)"


class FeatureHistogram(Feature):
    """Brings the values of one metric to the histogram, and the range brushed there to the view.

    The histogram counts what the colours show, so that the picture and the plot tell of the same thing, until the user
    chooses a metric there. A brushed range holds its metric: then other colours can be laid over what it leaves.
    """

    order = 40

    def __init__(self, host: Host):
        super().__init__(host)
        view = self._view = self.session.view
        self._document, self._kept = self.session.document, self.session.snapshots
        self._seen = ChangeTracker()
        self._style = ChartStyle()  # what the last figure was like
        self._kept_values: dict[int, tuple[str, np.ndarray, np.ndarray]] = {}
        panel = self.panel = QualityHistogram()
        panel.metric_chosen.connect(self._on_metric)
        panel.range_changed.connect(lambda chosen: view.change(quality_range=chosen))
        panel.keep_requested.connect(self._keep)
        panel.renamed.connect(self._kept.rename)
        panel.removed.connect(self._kept.remove)
        panel.save_requested.connect(self.ask)
        panel.inverted_requested.connect(self._isolate_inverted)

    def states(self) -> Sequence[StatePart]:
        """The settings of the histogram."""
        return (
            StatePart(
                name="histogram",
                data=HistogramSettings,
                to_data=self.panel.head.settings,
                restore=self.panel.head.restore,
            ),
        )

    def panels(self) -> Sequence[Panel]:
        """The histogram."""
        return (
            Panel(
                id="histogram",
                title="Histogram",
                widget=self.panel,
                place=PanelPlace.FACTS,
                order=10,
                help="How many hexes have which quality; drag over it to show those alone.",
            ),
        )

    @property
    def metric(self) -> str:
        """Return the metric counted; q if the colours show a displacement, which needs two meshes."""
        shown = self._view.look.scale.metric
        return self._view.counted or ("q" if shown in DISPLACEMENT_QUANTITIES else shown)

    def refresh(self) -> None:
        """Count the hexes as they are now."""
        self.panel.setEnabled(self._document.is_open)
        look = self._view.look
        if (
            self._view.counted is None
            and look.quality_range is not None
            and look.quality_range.metric != look.scale.metric
        ):
            self._view.counted = look.quality_range.metric
        self.session.run.want({look.scale.metric, self.metric} - DISPLACEMENT_QUANTITIES.keys())
        self.panel.set_metric(self.metric, self._view.counted is None and self.metric == look.scale.metric)
        if self._document.is_open and self.panel.isVisible():
            self._count()
        self.panel.set_range(look.quality_range)

    def refresh_iteration(self) -> None:
        """Show the newest iteration of a run."""
        self.refresh()

    def _count(self) -> None:
        start, now = self._document.start, self._document.now
        if self._seen.changed("start", self.metric, start):
            self.panel.set_initial(self._values(start), start.figures.inverted)
            self._seen.changed("now")
        if self._seen.changed("kept", self.metric, self._kept.all, start):
            self._show_kept()
        if self._seen.changed("now", self.metric, now):
            self.panel.set_current(self._values(now), now.figures.inverted)

    def _values(self, state: State) -> np.ndarray:
        return metric_values(self.metric, state.mesh.points, state.mesh.hexes, state.figures)

    def _on_metric(self, name: str) -> None:
        self._view.counted = name or None
        chosen = self._view.look.quality_range
        if chosen is not None and chosen.metric != self.metric:
            self._view.change(quality_range=None)  # what it hides could no longer be told from the plot
        self.host.refresh_soon()

    def _isolate_inverted(self) -> None:
        now = self._document.now
        self._view.isolate(hexes_of_group("inverted", now.mesh, now.figures))

    # What is kept

    def _keep(self) -> None:
        now = self._document.now
        moment = self.session.history.moment_of(now)
        self._kept.keep("kept" if moment is None else moment.name, now)

    def _show_kept(self) -> None:
        kept = self._kept.all
        self._kept_values = {one.slot: self._values_of(one) for one in kept}
        self.panel.set_kept([(one.slot, one.name, self._kept_values[one.slot][2], one.inverted) for one in kept])

    def _values_of(self, one: Snapshot) -> tuple[str, np.ndarray, np.ndarray]:
        """The metric, the points and the values of what is kept: worked out when one of the first two is another."""
        known = self._kept_values.get(one.slot)
        if known is not None and known[0] == self.metric and known[1] is one.points:
            return known
        hexes = self._document.now.mesh.hexes
        found = metric_values(self.metric, one.points, hexes, measure(one.points, hexes))
        return self.metric, one.points, found

    # Files

    def ask(self) -> None:
        """Ask what the histogram is to be like and where it goes, and write it."""
        if given := answer(self.dialog()):
            path, self._style = given
            self.save(path, self._style)

    def dialog(self) -> ChartDialog:
        """The dialog that asks: sizes and names are as they were last."""
        event = self._report(Path())
        chart, proposed = figure(*event.given[1:], **event.options), f"{self.host.stem}-histogram.svg"
        return ChartDialog(chart, "the histogram", proposed, _KINDS, self._style, self.host.dialog_parent)

    def save(self, path: str | Path, style: ChartStyle | None = None) -> bool:
        """Write the histogram as figure, or its counts as CSV, by the suffix; whether it was."""
        return self.host.try_and_report(
            "The histogram was not saved",
            lambda: self.session.commands.export(self._report(Path(path), style)),
            f"Histogram saved to {path}",
        )

    def _report(self, path: Path, style: ChartStyle | None = None) -> FileExported:
        """The call that writes it."""
        panel, document = self.panel, self._document
        drawn = [("at the start", GREY.light, True, document.start), ("now", BLUE.light, True, document.now)]
        for one in self._kept.all:
            state = self.session.state_at(one.points)
            mesh = document.now.mesh.with_points(one.points) if state is None else state
            drawn.append((one.name, KEPT[one.slot].light, False, mesh))
        options = {"bins": panel.head.bins.value(), "log": panel.log, "cumulative": panel.cumulative}
        if style is not None:
            options["style"] = style
        return FileExported("histogram", write_histogram, (path, document.name, self.metric, drawn), options)
