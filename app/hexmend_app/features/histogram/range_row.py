"""Row of controls below the histogram, for the ends of the range."""

from __future__ import annotations

from PySide6.QtCore import QSignalBlocker, QSize, Qt, Signal
from PySide6.QtGui import QColor, QIcon, QPainter, QPen, QPixmap, QResizeEvent
from PySide6.QtWidgets import QHBoxLayout, QLabel, QPushButton, QToolButton, QWidget

from hexmend.quality import METRICS
from hexmend_app.features.histogram.axis import Axis
from hexmend_app.features.histogram.end_box import EndBox
from hexmend_app.picture.visibility import Show
from hexmend_app.theme.palette import INVERTED
from hexmend_app.theme.spacing import fill
from hexmend_app.theme.style import narrow, set_help
from hexmend_app.translation import tr
from hexmend_app.widgets.metric_texts import in_sentence

_SPACING, _SWATCH = 4, 12
_INVERTED = "Show inverted hexes as well, of any value; they have a separate bar left of the bins."


class RangeRow(QWidget):
    """Controls for the lowest and highest value that is shown, and for inverted hexes.

    Signals
    -------
    chosen(low, high, inverted)
        The user changed an end of the range, or showed or hid inverted hexes.
    """

    chosen = Signal(float, float, bool)

    def __init__(self, parent: QWidget | None = None):
        super().__init__(parent)
        self._axis = Axis("q")
        self._shown: Show | None = None
        #: Ends of the range; a brushed end has more digits than its box.
        self._ends: dict[EndBox, float] = {}
        self.low, self.high, self.all = EndBox(), EndBox(), QPushButton(tr("All"))
        set_help(self.all, tr("Show all"), tr("Show the hexes of all values (or double-click the plot)."))
        narrow(self.all)
        self.inverted = QToolButton()
        self.inverted.setCheckable(True)
        self.inverted.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.inverted.setToolButtonStyle(Qt.ToolButtonStyle.ToolButtonIconOnly)
        self.inverted.setIconSize(QSize(_SWATCH, _SWATCH))
        set_help(self.inverted, tr("Show inverted"), tr(_INVERTED))
        self.inverted.clicked.connect(self._choose)
        self.inverted.setIcon(_swatch())
        self._label, to = QLabel(tr("Show")), QLabel(tr("to"))
        self.controls = (self.low, to, self.high, self.inverted, self.all)
        parts = (self._label, *self.controls[:-1], None, self.all)
        fill(QHBoxLayout(self), *parts, margins=(0, 0, 0, 0), spacing=_SPACING)
        for box in (self.low, self.high):
            box.valueChanged.connect(lambda _, box=box: self._on_end(box))
        self.set_axis(self._axis)
        self.show_range(None)

    def set_axis(self, axis: Axis) -> None:
        """Change the metric and the range of its values."""
        self._axis = axis
        metric = in_sentence(METRICS[axis.metric])
        for box, name in ((self.low, tr("Minimum {metric} shown")), (self.high, tr("Maximum {metric} shown"))):
            with QSignalBlocker(box):
                box.set_axis(axis)
            box.updateGeometry()
            name = name.format(metric=metric)
            set_help(
                box,
                name,
                tr("{name}; hexes beyond it are hidden. Dragging over the plot sets the same range.", name=name),
            )

    def show_range(self, range: Show | None) -> None:
        """Show a range, or None for all hexes, without emitting a signal."""
        self.all.setEnabled(range is not None)
        self.inverted.setChecked(range is None or range.inverted)
        # Ends that the user typed in reverse order stay as they are.
        if range is None or range != self._shown:
            minimum, maximum = METRICS[self._axis.metric].full_range
            ends = (minimum, maximum) if range is None else (max(range.low, minimum), min(range.high, maximum))
            for box, end in zip((self.low, self.high), ends, strict=True):
                box.set_end(end)
                self._ends[box] = end
        self._shown = range

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Show the label if it fits."""
        super().resizeEvent(event)
        self._label.setVisible(self.width() >= self.minimumSizeHint().width() + self._label.sizeHint().width())

    def minimumSizeHint(self) -> QSize:
        """Return the size without the label."""
        widths = (control.minimumWidth() or control.minimumSizeHint().width() for control in self.controls)
        return QSize(sum(width + _SPACING for width in widths), super().minimumSizeHint().height())

    def _on_end(self, box: EndBox) -> None:
        self._ends[box] = box.end()
        # Inverted hexes are left of all values: a lower end excludes them.
        if self._shown is None and box is self.low:
            self.inverted.setChecked(False)
        self._choose()

    def _choose(self) -> None:
        low, high = sorted(self._ends.values())
        self._shown = Show((low, high), self._axis.metric, self.inverted.isChecked())
        self.chosen.emit(low, high, self._shown.inverted)


def _swatch() -> QIcon:
    """Return an icon that is filled while its button is checked, and else only a border."""
    icon = QIcon()
    for state in (QIcon.State.On, QIcon.State.Off):
        picture = QPixmap(_SWATCH, _SWATCH)
        picture.fill(QColor(INVERTED) if state == QIcon.State.On else Qt.GlobalColor.transparent)
        painter = QPainter(picture)
        painter.setPen(QPen(QColor(INVERTED), 2))
        painter.drawRect(1, 1, _SWATCH - 2, _SWATCH - 2)
        painter.end()
        icon.addPixmap(picture, state=state)
    return icon
