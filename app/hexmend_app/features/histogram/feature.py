"""How quality is distributed: the lines between the mesh, what is kept of it, and the histogram that counts."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np

from hexmend.boundary.displacement import DISPLACEMENT_QUANTITIES
from hexmend.quality import measure
from hexmend.report.charts import ChartStyle
from hexmend_app.feature import Feature, Host, Panel, Place, Seen
from hexmend_app.features.histogram.file import figure, write_histogram
from hexmend_app.features.histogram.panel import QualityHistogram
from hexmend_app.scene.palette import BLUE, GREY, KEPT
from hexmend_app.state.deeds import Wrote
from hexmend_app.state.document import State
from hexmend_app.state.kept import Kept
from hexmend_app.state.kinds import of_kind
from hexmend_app.state.measured import values
from hexmend_app.widgets.export_dialog import ChartDialog, answer

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
        self._document, self._kept = self.session.document, self.session.kept
        self._seen = Seen()
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
        self.session.choices.offer("histogram", panel.head.choices, panel.head.set_choices)

    def panels(self) -> Sequence[Panel]:
        """The histogram."""
        return (
            Panel(
                id="histogram",
                title="Histogram",
                widget=self.panel,
                place=Place.FACTS,
                order=10,
                help="How many hexes have which quality; drag over it to show those alone.",
            ),
        )

    @property
    def metric(self) -> str:
        """What is counted; q where the colours show a movement, which is none of one moment."""
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
        self.session.smoothing.want({look.scale.metric, self.metric} - DISPLACEMENT_QUANTITIES.keys())
        self.panel.set_metric(self.metric, self._view.counted is None and self.metric == look.scale.metric)
        if self._document.is_open and self.panel.isVisible():
            self._count()
        self.panel.set_range(look.quality_range)

    def _count(self) -> None:
        start, now = self._document.start, self._document.now
        if self._seen.another("start", self.metric, start):
            self.panel.set_initial(self._values(start), start.figures.inverted)
            self._seen.another("now")
        if self._seen.another("kept", self.metric, self._kept.all, start):
            self._show_kept()
        if self._seen.another("now", self.metric, now):
            self.panel.set_current(self._values(now), now.figures.inverted)

    def _values(self, state: State) -> np.ndarray:
        return values(self.metric, state.mesh.points, state.mesh.hexes, state.figures)

    def _on_metric(self, name: str) -> None:
        self._view.counted = name or None
        chosen = self._view.look.quality_range
        if chosen is not None and chosen.metric != self.metric:
            self._view.change(quality_range=None)  # what it hides could no longer be told from the plot
        self.host.refresh_soon()

    def _isolate_inverted(self) -> None:
        now = self._document.now
        self._view.isolate(of_kind("inverted", now.mesh, now.figures))

    # What is kept

    def _keep(self) -> None:
        now = self._document.now
        moment = self.session.history.moment_of(now)
        self._kept.keep("kept" if moment is None else moment.name, now)

    def _show_kept(self) -> None:
        kept = self._kept.all
        self._kept_values = {one.slot: self._values_of(one) for one in kept}
        self.panel.set_kept([(one.slot, one.name, self._kept_values[one.slot][2], one.inverted) for one in kept])

    def _values_of(self, one: Kept) -> tuple[str, np.ndarray, np.ndarray]:
        """The metric, the points and the values of what is kept: worked out when one of the first two is another."""
        known = self._kept_values.get(one.slot)
        if known is not None and known[0] == self.metric and known[1] is one.points:
            return known
        hexes = self._document.now.mesh.hexes
        found = values(self.metric, one.points, hexes, measure(one.points, hexes))
        return self.metric, one.points, found

    # Files

    def ask(self) -> None:
        """Ask what the histogram is to be like and where it goes, and write it."""
        if given := answer(self.dialog()):
            path, self._style = given
            self.save(path, self._style)

    def dialog(self) -> ChartDialog:
        """The dialog that asks: sizes and names are as they were last."""
        deed = self._told(Path())
        chart, proposed = figure(*deed.given[1:], **deed.options), f"{self.host.stem}-histogram.svg"
        return ChartDialog(chart, "the histogram", proposed, _KINDS, self._style, self.host.dialog_parent)

    def save(self, path: str | Path, style: ChartStyle | None = None) -> bool:
        """Write the histogram as figure, or its counts as CSV, by the suffix; whether it was."""
        return self.host.said(
            "The histogram was not saved",
            lambda: self.session.commands.carry_out(self._told(Path(path), style)),
            f"Histogram saved to {path}",
        )

    def _told(self, path: Path, style: ChartStyle | None = None) -> Wrote:
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
        return Wrote("histogram", write_histogram, (path, document.name, self.metric, drawn), options)
