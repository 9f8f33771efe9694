"""Feature that measures distances and an angle between points picked in the view."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from hexmend_app.feature import Action, ChangeTracker, Feature, Host, Panel, PanelGroup, PanelPlace
from hexmend_app.features.measure.measure_panel import MeasurePanel
from hexmend_app.translation import tr

if TYPE_CHECKING:
    from hexmend_app.canvas.canvas import Canvas


class FeatureMeasure(Feature):
    """Connects clicks in the view with the measurement, and shows it as text."""

    order = 53

    def __init__(self, host: Host):
        super().__init__(host)
        self._view = self.session.view
        self._seen = ChangeTracker()
        self.panel = MeasurePanel()
        self.panel.switch.clicked.connect(self._switch)
        self.panel.clear_button.clicked.connect(self._view.clear_measurement)

    def actions(self) -> Sequence[Action]:
        """Return the actions that measure and copy."""
        return (
            Action(
                id="measure",
                text=tr("&Measure"),
                menu="View",
                part=1,
                keys="R",
                icon="ruler",
                help=tr("Click points in the view: two give a distance, three an angle; Esc ends."),
                handle=self._switch,
                checked=lambda: self._view.measuring,
                enabled=lambda: self.canvas is not None,
                in_view=True,
            ),
            Action(
                id="copy_measurement",
                text=tr("Copy measurement"),
                help=tr("Copy the measured points, distances and angle to the clipboard."),
                handle=self.panel.copy,
                enabled=lambda: len(self._view.look.measurement.points) > 1,
            ),
        )

    def panels(self) -> Sequence[Panel]:
        """Return the panel with the measurement."""
        return (
            Panel(
                id="measure",
                title=tr("Measure"),
                widget=self.panel,
                place=PanelPlace.DRAWER,
                group=PanelGroup.FIND,
                order=4,
                help=tr("Distances and an angle between points picked in the view."),
                scrolls=True,
            ),
        )

    def canvas_ready(self, canvas: Canvas) -> None:
        """Connect to points picked in the view."""
        canvas.measured.connect(self._view.measure)

    def refresh(self) -> None:
        """Show the measurement."""
        view = self._view
        self.panel.setEnabled(self.session.document.is_open)
        if self._seen.changed("measurement", view.measuring, view.look.measurement, self.canvas):
            self.panel.set_measurement(view.measuring, view.look.measurement)
            if self.canvas is not None:
                self.canvas.set_measuring(view.measuring)

    def _switch(self, on: bool) -> None:
        if on:
            self._view.start_measuring()
            self.host.offer_panel("measure")
        else:
            self._view.end_measuring()
