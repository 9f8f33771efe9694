"""Histogram of a metric of the mesh and of its snapshots."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from pathlib import Path

import numpy as np

from hexmend.mesh.mesh import Mesh
from hexmend.mesh.solid_cells import rows_by_kind
from hexmend.quality import METRICS, measure
from hexmend.report.documents import write_text
from hexmend_app.chart_feature import ChartFeature
from hexmend_app.feature import Host, Panel, PanelPlace, StatePart
from hexmend_app.features.histogram.panel import QualityHistogram
from hexmend_app.picture.visibility import Show
from hexmend_app.report.distribution import Distribution
from hexmend_app.report.histogram import Histogram
from hexmend_app.scene.colour.colouring import Colouring
from hexmend_app.state.mesh.document import MeasuredMesh
from hexmend_app.state.mesh.metric_cache import metric_values
from hexmend_app.state.view.side_views import Snapshot
from hexmend_app.translation import tr
from hexmend_app.widgets.inputs.saved_values import saved_values
from hexmend_app.widgets.wording import noun_of, noun_of_cells


class FeatureHistogram(ChartFeature):
    """Shows the values of a metric in the histogram, and hides the hexes outside of the range brushed there.

    The metric is that of the colours until the user selects another. It stays the same while a range is brushed, so
    that the remaining hexes can be coloured by other metrics.
    """

    chart_title, chart_subject, values_title = "Histogram", "the histogram", "Counts"

    def __init__(self, host: Host):
        super().__init__(host)
        self._view = self.session.view
        self._document, self._snapshots = self.session.document, self.session.snapshots
        self._initial: Distribution | None = None
        self._current: Distribution | None = None
        #: Metric with kind of cells, points and distribution of the snapshots, by slot.
        self._kept: dict[int, tuple[str, np.ndarray, Distribution]] = {}
        panel = self.panel = QualityHistogram()
        panel.head.metric_chosen.connect(self._on_metric)
        panel.head.kind_chosen.connect(host.refresh_soon)
        panel.range_changed.connect(self._filter)
        panel.head.keep.clicked.connect(self._keep)
        panel.legend.renamed.connect(self._snapshots.rename)
        panel.legend.removed.connect(self._snapshots.remove)
        panel.head.save.triggered.connect(self.ask)
        panel.inverted_requested.connect(self._isolate_inverted)

    def states(self) -> Iterable[StatePart]:
        """Yield the settings of the histogram."""
        head = self.panel.head
        yield saved_values("histogram", log=head.log, cumulative=head.cumulative, bins=head.bins)

    def panels(self) -> Iterable[Panel]:
        """Yield the histogram."""
        yield Panel(
            id="histogram",
            title=tr("Histogram"),
            widget=self.panel,
            place=PanelPlace.FACTS,
            order=10,
            help=tr("Distribution of a quality metric; drag over it to show only the hexes of a range."),
        )

    @property
    def metric(self) -> str:
        """Metric of the histogram; q if the colours show a displacement or materials, which are no metrics."""
        coloured = self._view.look.colours.metric
        return self._view.counted or (coloured if coloured in METRICS else "q")

    def refresh(self) -> None:
        """Show the present distribution, the snapshots and the range."""
        self.panel.setEnabled(self._document.is_open)
        look = self._view.look
        range = look.show.by_quality
        if self._view.counted is None and range is not None and range.metric != look.colours.metric:
            self._view.counted = range.metric
        self.session.run.request_metrics(name for name in {look.colours.metric, self.metric} if name in METRICS)
        self.panel.set_metric(self.metric, self._view.counted is None and self.metric == look.colours.metric)
        if self._document.is_open and self.panel.isVisible():
            self._count()
        self.panel.set_range(range)

    def _count(self) -> None:
        start, now, snapshots = self._document.start, self._document.now, self._snapshots.all
        if self._seen.changed("kinds", kinds := tuple(now.summary.cells)):
            self.panel.head.show_kinds(kinds)
        kind = self.panel.head.kind
        if self._seen.changed("start", self.metric, kind, start):
            self._initial = self._distribution(start)
        if self._seen.changed("now", self.metric, kind, now):
            self._current = self._distribution(now)
        colouring = self._colouring()
        if self._seen.changed("all", self.metric, kind, start, now, snapshots, colouring):
            self._kept = {one.slot: self._distribution_of(one) for one in snapshots}
            kept = [(one.slot, one.name, self._kept[one.slot][2]) for one in snapshots]
            inside = now.quality.n_invalid - now.quality.n_inverted
            self.panel.show_distributions(self._initial, self._current, kept, inside, colouring)

    def _colouring(self) -> Colouring | None:
        """Return the colouring of the view; None if it shows another metric or none."""
        colouring = None if self.canvas is None or self._view.look.colours.neutral else self.canvas.colouring
        if colouring is None or colouring.names or self.metric != self._view.look.colours.metric:
            return None
        return colouring

    def _distribution(self, state: MeasuredMesh) -> Distribution:
        values = metric_values(self.metric, state.mesh, state.quality)
        return self._of_kind(state.mesh, values, state.quality.inverted)

    def _of_kind(self, mesh: Mesh, values: np.ndarray, inverted: np.ndarray) -> Distribution:
        """Return the distribution of values (m,) of the cells of the chosen kind."""
        chosen = self.panel.head.kind
        if not chosen:
            return Distribution.of(values, inverted, noun_of_cells(mesh))
        rows = {kind.name: rows for kind, rows in rows_by_kind(mesh.elements)}.get(chosen, slice(0))
        return Distribution.of(values[rows], inverted[rows], noun_of(chosen))

    def _on_metric(self, name: str) -> None:
        self._view.counted = name or None
        range = self._view.look.show.by_quality
        if range is not None and range.metric != self.metric:
            self._filter(None)  # the plot cannot show a range of another metric
        self.host.refresh_soon()

    def _filter(self, range: Show | None) -> None:
        """Show the hexes of a range, or of all values."""
        range = Show() if range is None else range
        self._view.change(show={"quality": range.quality, "metric": range.metric, "inverted": range.inverted})

    def _isolate_inverted(self) -> None:
        self._view.isolate_group("inverted")

    # Snapshots

    def _keep(self) -> None:
        now = self._document.now
        iteration = self.session.history.iteration_of(now)
        self._snapshots.add("kept" if iteration is None else iteration.name, now)

    def _distribution_of(self, snapshot: Snapshot) -> tuple[str, np.ndarray, Distribution]:
        """Return what `_kept` holds of a snapshot, computed only if the metric, the kind or the points have changed."""
        known, of = self._kept.get(snapshot.slot), f"{self.metric} {self.panel.head.kind}"
        if known is not None and known[0] == of and known[1] is snapshot.points:
            return known
        mesh = self._document.now.mesh.with_points(snapshot.points)
        values = metric_values(self.metric, mesh, measure(mesh.points, mesh.elements, mesh.mid_nodes))
        return of, snapshot.points, self._of_kind(mesh, values, snapshot.inverted)

    # Files

    def write_values(self, path: Path, names: Mapping[str, str]) -> None:
        """Write the counts as CSV."""
        self._count()
        write_text(path, self.panel.shown.csv_text(names))

    def described(self) -> Histogram:
        """Return the histogram of the panel, for print."""
        self._count()
        return self.panel.shown.describe(self._document.name, for_print=True)
