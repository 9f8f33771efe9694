"""Feature that measures distances and an angle between points picked in the view."""

from __future__ import annotations

from collections.abc import Iterable

from PySide6.QtGui import QGuiApplication
from PySide6.QtWidgets import QWidget

from hexmend_app.feature import Action, Feature, Host
from hexmend_app.picture.appearance import Measurement
from hexmend_app.theme.style import push_button, tabular
from hexmend_app.translation import tr
from hexmend_app.widgets.eliding_label import ElidingLabel
from hexmend_app.widgets.view_strip import ViewStrip

_PROMPTS = (
    "Click two points of the mesh in the view. A click close to a node takes its position.",
    "Click the second point in the view.",
)


class FeatureMeasure(Feature):
    """Connects clicks in the view with the measurement, and shows it as text below the view."""

    def __init__(self, host: Host):
        super().__init__(host)
        self._view = self.session.view
        self.strip = MeasureStrip(host.dialog_parent)
        self.strip.closed.connect(self._view.end_measuring)
        self.strip.clear_button.clicked.connect(self._view.clear_measurement)

    def actions(self) -> Iterable[Action]:
        """Yield the action that measures."""
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

    def canvas_ready(self) -> None:
        """Connect to points picked in the view, and add the strip below it."""
        self.canvas.measured.connect(self._view.measure)
        self.canvas.frame.addWidget(self.strip)

    def refresh(self) -> None:
        """Show the measurement."""
        view = self._view
        if self.canvas is not None and self._seen.changed("measurement", view.measuring, view.look.measurement):
            self.strip.set_measurement(view.look.measurement)
            self.strip.setVisible(view.measuring or bool(view.look.measurement.points))
            self.canvas.set_measuring(view.measuring)


class MeasureStrip(ViewStrip):
    """Strip that shows a measurement as text.

    Attributes
    ----------
    text : ElidingLabel
        The distances and the angle, with the points in its tooltip.
    """

    def __init__(self, parent: QWidget | None = None):
        super().__init__(tr("Measure"), parent)
        self._measurement = Measurement()
        self.text = ElidingLabel()
        self.text.setFont(tabular(self.text.font()))
        help = tr("Copy the points, distances and angle to the clipboard.")
        self._copy = push_button(tr("Copy"), help, "content-copy", name=tr("Copy measurement"))
        self.clear_button = push_button(tr("Clear"), tr("Remove the measured points."), name=tr("Clear measurement"))
        self.add((self.text, 1), self._copy, self.clear_button)
        self._copy.clicked.connect(self.copy)

    def set_measurement(self, measurement: Measurement) -> None:
        """Show a measurement, or which points to click."""
        self._measurement = measurement
        count = len(measurement.points)
        self.clear_button.setEnabled(count > 0)
        self._copy.setEnabled(count > 1)
        results = measurement_text(measurement).splitlines()[count:]
        self.text.setText(" · ".join(results) or tr(_PROMPTS[count]))
        self.text.setToolTip(measurement_text(measurement))

    def copy(self) -> None:
        """Copy the measurement to the clipboard."""
        QGuiApplication.clipboard().setText(measurement_text(self._measurement))


def measurement_text(measurement: Measurement) -> str:
    """Return the points, distances and angle of a measurement as lines of text.

    >>> print(measurement_text(Measurement(((0, 0, 0), (3, 0, 4)))))
    Point 1: (0, 0, 0)
    Point 2: (3, 0, 4)
    Distance 1–2: 5 (Δx 3, Δy 0, Δz 4)
    >>> print(measurement_text(Measurement(((1, 0, 0), (0, 0, 0), (0, 2, 0)))).splitlines()[-1])
    Angle at 2: 90°
    """
    points = measurement.points
    lines = [
        tr("Point {number}: ({place})", number=k, place=", ".join(map(_number, point)))
        for k, point in enumerate(points, 1)
    ]
    for k, (start, end, length) in enumerate(zip(points[:-1], points[1:], measurement.distances, strict=True), 1):
        steps = ", ".join(f"Δ{axis} {_number(b - a)}" for axis, a, b in zip("xyz", start, end, strict=True))
        distance = tr("Distance {start}–{end}: {length}", start=k, end=k + 1, length=_number(length))
        lines.append(f"{distance} ({steps})")
    if measurement.angle is not None:
        lines.append(tr("Angle at 2: {angle:.5g}°", angle=measurement.angle))
    return "\n".join(lines)


def _number(value: float) -> str:
    return f"{value:.5g}".replace("-", "−")
