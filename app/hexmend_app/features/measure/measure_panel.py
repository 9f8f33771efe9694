"""Panel with the distances and the angle between points picked in the view."""

from __future__ import annotations

from PySide6.QtCore import Qt
from PySide6.QtGui import QGuiApplication
from PySide6.QtWidgets import QHBoxLayout, QLabel, QPushButton, QVBoxLayout, QWidget

from hexmend_app.picture.appearance import Measurement
from hexmend_app.theme.spacing import fill
from hexmend_app.theme.style import icon, set_help, tabular
from hexmend_app.translation import tr

_PROMPTS = (
    "Click two points of the mesh in the view. A click close to a node takes its position.",
    "Click the second point in the view.",
)


class MeasurePanel(QWidget):
    """Panel that switches measuring on, and shows the measurement as text.

    Attributes
    ----------
    text : QLabel
        The measurement, which can be selected.
    """

    def __init__(self, parent: QWidget | None = None):
        super().__init__(parent)
        self._measurement = Measurement()
        self.switch = QPushButton(icon("ruler"), tr("Measure"))
        self.switch.setCheckable(True)
        set_help(self.switch, tr("Measure"), tr("Clicks in the view measure instead of selecting hexes; Esc ends."))
        self._copy, self.clear_button = QPushButton(icon("content-copy"), tr("Copy")), QPushButton(tr("Clear"))
        set_help(self._copy, tr("Copy measurement"), tr("Copy the points, distances and angle to the clipboard."))
        set_help(self.clear_button, tr("Clear measurement"), tr("Remove the measured points."))
        self.text = QLabel()
        self.text.setFont(tabular(self.text.font()))
        self.text.setTextFormat(Qt.TextFormat.PlainText)
        self.text.setTextInteractionFlags(
            Qt.TextInteractionFlag.TextSelectableByMouse | Qt.TextInteractionFlag.TextSelectableByKeyboard
        )
        self.text.setAlignment(Qt.AlignmentFlag.AlignTop | Qt.AlignmentFlag.AlignLeft)
        buttons = fill(QHBoxLayout(), self.switch, self._copy, self.clear_button, None)
        fill(QVBoxLayout(self), buttons, (self.text, 1), margins=(0, 0, 0, 0))
        self._copy.clicked.connect(self.copy)
        self.set_measurement(False, self._measurement)

    def set_measurement(self, measuring: bool, measurement: Measurement) -> None:
        """Show whether clicks measure, and a measurement; emits no signal."""
        self._measurement = measurement
        count = len(measurement.points)
        self.switch.setChecked(measuring)
        self.clear_button.setEnabled(count > 0)
        self._copy.setEnabled(count > 1)
        if count > 1:
            self.text.setText(measurement_text(measurement))
        else:
            self.text.setText(tr(_PROMPTS[count]) if measuring else "")

    def copy(self) -> None:
        """Copy the measurement to the clipboard."""
        QGuiApplication.clipboard().setText(measurement_text(self._measurement))


def measurement_text(measurement: Measurement) -> str:
    """Return the points, distances and angle of a measurement as lines of text.

    >>> print(measurement_text(Measurement(((0, 0, 0), (3, 0, 4)))))
    Point 1: (0, 0, 0)
    Point 2: (3, 0, 4)
    Distance 1–2: 5    Δx 3, Δy 0, Δz 4
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
        lines.append(f"{distance}    {steps}")
    if measurement.angle is not None:
        lines.append(tr("Angle at 2: {angle:.5g}°", angle=measurement.angle))
    return "\n".join(lines)


def _number(value: float) -> str:
    return f"{value:.6g}"
