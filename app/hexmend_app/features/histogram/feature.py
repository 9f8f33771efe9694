"""How quality is distributed: the lines between the mesh, what is kept of it, and the histogram that counts."""

from __future__ import annotations

import numpy as np

from hexmend.quality import measure
from hexmend_app.features.histogram.panel import QualityHistogram
from hexmend_app.state.document import State
from hexmend_app.state.kept import Kept, KeptMoments
from hexmend_app.state.kinds import isolate, of_kind
from hexmend_app.state.measured import values
from hexmend_app.state.movement import MOVEMENTS
from hexmend_app.state.session import Session


class Counting:
    """Brings the values of one metric to the histogram, and the range brushed there to the view.

    The histogram counts what the colours show, so that the picture and the plot tell of the same thing, until the user
    chooses a metric there. A brushed range holds its metric: then other colours can be laid over what it leaves.

    Parameters
    ----------
    session : Session
        The window's state.
    histogram : QualityHistogram
    """

    def __init__(self, session: Session, histogram: QualityHistogram):
        view = self._view = session.view
        self._document, self._smoothing, self._history = session.document, session.smoothing, session.history
        self._histogram = histogram
        self._own: str | None = None  # chosen here, not by the colours
        self._counted: tuple[str, State] | None = None  # what the axis was made for
        self.kept = KeptMoments()
        self._kept_values: dict[int, tuple[str, np.ndarray, np.ndarray]] = {}
        view.look_changed.connect(self._on_look_changed)
        self.kept.changed.connect(self._show_kept)
        histogram.metric_chosen.connect(self._on_metric)
        histogram.range_changed.connect(lambda chosen: view.change(quality_range=chosen))
        histogram.keep_requested.connect(self._keep)
        histogram.renamed.connect(self.kept.rename)
        histogram.removed.connect(self.kept.remove)
        histogram.inverted_requested.connect(self._isolate_inverted)

    @property
    def metric(self) -> str:
        """What is counted; q where the colours show a movement, which is none of one moment."""
        shown = self._view.look.scale.metric
        return self._own or ("q" if shown in MOVEMENTS else shown)

    @property
    def _follows(self) -> bool:
        return self._own is None and self.metric == self._view.look.scale.metric

    def show_another(self) -> None:
        """Take another mesh, of which nothing is kept."""
        self.kept.clear()

    def refresh(self) -> None:
        """Count the elements as they are now."""
        if not self._document.is_open:
            return
        start, now = self._document.start, self._document.now
        if self._counted != (self.metric, start):
            self._counted = (self.metric, start)
            self._histogram.set_metric(self.metric, self._follows)
            self._histogram.set_initial(self._values(start), start.figures.inverted)
            self._show_kept()
        self._histogram.set_current(self._values(now), now.figures.inverted)

    def _values(self, state: State) -> np.ndarray:
        return values(self.metric, state.mesh.points, state.mesh.hexes, state.figures)

    def _on_metric(self, name: str) -> None:
        self._own = name or None
        chosen = self._view.look.quality_range
        if chosen is not None and chosen.metric != self.metric:
            self._view.change(quality_range=None)  # what it hides could no longer be told from the plot
        self._show_metric()

    def _on_look_changed(self) -> None:
        look = self._view.look
        if self._own is None and look.quality_range is not None and look.quality_range.metric != look.scale.metric:
            self._own = look.quality_range.metric
        self._show_metric()

    def _show_metric(self) -> None:
        look = self._view.look
        self._smoothing.want({look.scale.metric, self.metric} - MOVEMENTS.keys())
        if self._counted is not None and self._counted[0] != self.metric:
            self.refresh()
        self._histogram.set_metric(self.metric, self._follows)
        self._histogram.set_range(look.quality_range)

    def _isolate_inverted(self) -> None:
        now = self._document.now
        isolate(self._view, of_kind("inverted", now.mesh, now.figures))

    # What is kept

    def _keep(self) -> None:
        now = self._document.now
        moment = self._history.moment_of(now)
        self.kept.keep("kept" if moment is None else moment.name, now)

    def _show_kept(self) -> None:
        kept = self.kept.all
        self._kept_values = {one.slot: self._values_of(one) for one in kept}
        self._histogram.set_kept([(one.slot, one.name, self._kept_values[one.slot][2], one.inverted) for one in kept])

    def _values_of(self, one: Kept) -> tuple[str, np.ndarray, np.ndarray]:
        """The metric, the points and the values of what is kept: worked out when one of the first two is another."""
        known = self._kept_values.get(one.slot)
        if known is not None and known[0] == self.metric and known[1] is one.points:
            return known
        hexes = self._document.now.mesh.hexes
        found = values(self.metric, one.points, hexes, measure(one.points, hexes))
        return self.metric, one.points, found
