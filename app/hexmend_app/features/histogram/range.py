"""The row below the histogram: the ends of the range in numbers."""

from __future__ import annotations

from PySide6.QtCore import QSignalBlocker, QSize, Qt, Signal
from PySide6.QtGui import QColor, QIcon, QPainter, QPen, QPixmap, QResizeEvent
from PySide6.QtWidgets import QHBoxLayout, QLabel, QPushButton, QToolButton, QWidget

from hexmend.quality import METRICS
from hexmend_app.features.histogram.axis import Axis
from hexmend_app.features.histogram.end_box import EndBox
from hexmend_app.picture.appearance import ValueRange
from hexmend_app.theme.style import INVERTED, set_help
from hexmend_app.widgets.metric_texts import in_sentence

_SPACING, _SWATCH = 4, 12
_INVERTED = "Show inverted hexes too, whatever their value; they have a separate bar next to the bins."


class RangeRow(QWidget):
    """Chooses the lowest and the highest value that is shown, and whether inverted elements are.

    Signals
    -------
    chosen(low, high, inverted)
        The user did, by numbers.
    cleared
        The user wants all.
    """

    chosen = Signal(float, float, bool)
    cleared = Signal()

    def __init__(self, parent: QWidget | None = None):
        super().__init__(parent)
        self._axis = Axis("q")
        self._shown: ValueRange | None = None
        # A brushed end has more digits than its box.
        self._ends: dict[EndBox, float] = {}
        self.low, self.high, self.all = EndBox(), EndBox(), QPushButton("All")
        set_help(self.all, "Show all", "Show the hexes of every value again (or double-click on the plot).")
        self.all.setFixedWidth(44)  # less than the style's 80 pixels, which the row has no room for
        self.all.clicked.connect(self.cleared)
        self.inverted = QToolButton()
        self.inverted.setCheckable(True)
        self.inverted.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.inverted.setToolButtonStyle(Qt.ToolButtonStyle.ToolButtonIconOnly)
        self.inverted.setIconSize(QSize(_SWATCH, _SWATCH))
        set_help(self.inverted, "Inverted hexes too", _INVERTED)
        self.inverted.clicked.connect(self._choose)
        self.inverted.setIcon(_swatch())
        self._label, to = QLabel("Show"), QLabel("to")
        row = QHBoxLayout(self)
        row.setContentsMargins(0, 0, 0, 0)
        row.setSpacing(_SPACING)
        self.parts = (self.low, to, self.high, self.inverted, self.all)
        for part in (self._label, *self.parts):
            row.addWidget(part)
        row.insertStretch(row.count() - 1)
        for box in (self.low, self.high):
            box.valueChanged.connect(lambda _, box=box: self._on_end(box))
        self.set_axis(self._axis)
        self.show_range(None)

    def set_axis(self, axis: Axis) -> None:
        """Take numbers of another metric."""
        self._axis = axis
        words = in_sentence(METRICS[axis.metric])
        for box, which in ((self.low, "Lowest"), (self.high, "Highest")):
            with QSignalBlocker(box):
                box.set_axis(axis)
            box.updateGeometry()
            name = f"{which} {words} shown"
            set_help(box, name, f"{name}: hexes beyond it are hidden. Dragging over the plot sets the same range.")

    def show_range(self, chosen: ValueRange | None) -> None:
        """Show a range, or that all are shown; without a signal."""
        self.all.setEnabled(chosen is not None)
        self.inverted.setChecked(chosen is None or chosen.inverted)
        # Ends that were typed in the other order stay where the user typed them.
        if chosen is None or chosen != self._shown:
            least, most = METRICS[self._axis.metric].full_range
            ends = (least, most) if chosen is None else (max(chosen.low, least), min(chosen.high, most))
            for box, end in zip((self.low, self.high), ends, strict=True):
                box.set_end(end)
                self._ends[box] = end
        self._shown = chosen

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Begin with a word where there is room."""
        super().resizeEvent(event)
        self._label.setVisible(self.width() >= self.minimumSizeHint().width() + self._label.sizeHint().width())

    def minimumSizeHint(self) -> QSize:
        """Without a word before the numbers."""
        least = (part.minimumWidth() or part.minimumSizeHint().width() for part in self.parts)
        width = sum(one + _SPACING for one in least)
        return QSize(width, super().minimumSizeHint().height())

    def _on_end(self, box: EndBox) -> None:
        self._ends[box] = box.end()
        # Inverted elements stand before the lowest value: who sets one leaves them out.
        if self._shown is None and box is self.low:
            self.inverted.setChecked(False)
        self._choose()

    def _choose(self) -> None:
        low, high = sorted(self._ends.values())
        self._shown = ValueRange(self._axis.metric, low, high, self.inverted.isChecked())
        self.chosen.emit(low, high, self._shown.inverted)


def _swatch() -> QIcon:
    """Filled while it is checked, else its border alone."""
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
