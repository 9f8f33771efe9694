"""Feature that measures distances and an angle between points picked in the view."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING

from hexmend_app.feature import Action, ChangeTracker, Feature, Host
from hexmend_app.features.measure.measure_strip import MeasureStrip
from hexmend_app.translation import tr

if TYPE_CHECKING:
    from hexmend_app.canvas.canvas import Canvas


class FeatureMeasure(Feature):
    """Connects clicks in the view with the measurement, and shows it as text below the view."""

    def __init__(self, host: Host):
        super().__init__(host)
        self._view = self.session.view
        self._seen = ChangeTracker()
        self.strip = MeasureStrip(host.dialog_parent)
        self.strip.closed.connect(self._view.end_measuring)
        self.strip.clear_button.clicked.connect(self._view.clear_measurement)

    def actions(self) -> Iterable[Action]:
        """Yield the actions that measure and copy."""
        yield Action(
            id="measure",
            text=tr("&Measure"),
            menu="View",
            section=1,
            keys="R",
            icon="ruler",
            help=tr("Click points in the view: two give a distance, three an angle; Esc ends."),
            handle=lambda on: self._view.start_measuring() if on else self._view.end_measuring(),
            checked=lambda: self._view.measuring,
            enabled=lambda: self.canvas is not None,
            in_view=True,
        )
        yield Action(
            id="copy_measurement",
            text=tr("Copy measurement"),
            help=tr("Copy the measured points, distances and angle to the clipboard."),
            handle=self.strip.copy,
            enabled=lambda: len(self._view.look.measurement.points) > 1,
        )

    def canvas_ready(self, canvas: Canvas) -> None:
        """Connect to points picked in the view, and add the strip below it."""
        canvas.measured.connect(self._view.measure)
        canvas.frame.addWidget(self.strip)

    def refresh(self) -> None:
        """Show the measurement."""
        view = self._view
        if self.canvas is not None and self._seen.changed("measurement", view.measuring, view.look.measurement):
            self.strip.set_measurement(view.look.measurement)
            self.strip.setVisible(view.measuring or bool(view.look.measurement.points))
            self.canvas.set_measuring(view.measuring)
