"""Panel of the histogram, in which a range of values is brushed to show only its hexes."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TypeVar

from PySide6.QtCore import QPointF, Qt, Signal
from PySide6.QtGui import QFontMetrics
from PySide6.QtWidgets import QInputDialog, QLineEdit, QToolButton, QVBoxLayout, QWidget
from superqt import QFlowLayout

from hexmend_app.features.histogram.distributions import Shown, ShownHistogram, bin_colours, range_summary
from hexmend_app.features.histogram.head import HistogramHead
from hexmend_app.features.histogram.histogram_plot import HistogramPlot, RangeRow
from hexmend_app.picture.visibility import Show
from hexmend_app.report.distribution import Axis, Distribution
from hexmend_app.scene.colour.colouring import Colouring
from hexmend_app.theme.palette import BLUE, GREY, KEPT, MUTED, Role
from hexmend_app.theme.spacing import clear, fill
from hexmend_app.theme.style import on_theme_change, set_help, smaller, tabular, tint
from hexmend_app.translation import tr
from hexmend_app.widgets.eliding_label import ElidingLabel
from hexmend_app.widgets.inputs.menu_button import MenuButton
from hexmend_app.widgets.legend import swatch_icon
from hexmend_app.widgets.plots import show_tooltips

_HELP = (
    "Number of hexes by value. Inverted hexes have a separate column at the left, for every metric. Drag over the plot "
    "to show only the hexes of a range, or click a bar to show only its hexes; double-click to show all hexes."
)
_MAX_NAME_WIDTH, _HEIGHT = 150, 20
Entry = TypeVar("Entry", bound=QToolButton)


class QualityHistogram(QWidget):
    """Distribution of a metric at the start, now and of kept meshes, in which a range can be brushed.

    Attributes
    ----------
    shown : ShownHistogram
        What the panel shows.

    Signals
    -------
    range_changed(Show or None)
        The user brushed or typed a range, or cleared it.
    inverted_requested
        The user clicked the column of inverted hexes, which is not empty.
    """

    range_changed = Signal(object)
    inverted_requested = Signal()

    def __init__(self, parent: QWidget | None = None):
        super().__init__(parent)
        self._metric = "q"
        self._range: Show | None = None
        self._colouring: Colouring | None = None
        self._initial: Distribution | None = None
        self._current: Distribution | None = None
        self._inside = 0  # hexes of now that are invalid inside
        self._kept: Sequence[tuple[int, str, Distribution]] = ()
        self._make_widgets()
        parts = (self.head, (self.plot, 1), self.legend, self.range_row, self.summary)
        fill(QVBoxLayout(self), *parts, margins=(4, 4, 4, 4), spacing=4)
        on_theme_change(self, self._refresh)

    def _make_widgets(self) -> None:
        self.head, self.legend = HistogramHead(), HistogramLegend()
        self.plot, self.range_row = HistogramPlot(), RangeRow()
        self.head.scale_changed.connect(self._refresh)
        self.range_row.chosen.connect(self._choose)
        # The tooltip of the plot shows counts; the help is the tooltip of the legend.
        set_help(self.legend, tr("Legend"), tr(_HELP))
        self.plot.plot.setAccessibleName(tr("Histogram of hex quality"))
        self.plot.plot.setAccessibleDescription(tr(_HELP))
        self.plot.plot.setWhatsThis(tr(_HELP))
        self.plot.brushed.connect(lambda left, right: self._choose(self.axis.range(left, right)))
        self.plot.view.clicked.connect(self._on_clicked)
        show_tooltips(self.plot.plot, lambda place: self.shown.describe_at(place.x()))
        self.summary = ElidingLabel()  # one line: a second line would move the plot while a range is brushed
        self.summary.setFont(tabular(smaller(self.summary.font())))
        tint(self.summary, MUTED)
        self.summary.setAccessibleName(tr("Hexes shown"))

    # Distributions

    def set_metric(self, name: str, as_colours: bool = False) -> None:
        """Change the metric; if it is another one, all distributions are removed.

        Parameters
        ----------
        name : str
            A name of `hexmend.quality.METRICS`.
        as_colours : bool
            True if the histogram follows the metric of the colours.
        """
        self.head.show_metric(name, as_colours)
        if name != self._metric:
            self._metric, self._range = name, None
            self.show_distributions(None, None)

    def show_distributions(
        self,
        initial: Distribution | None,
        current: Distribution | None,
        kept: Sequence[tuple[int, str, Distribution]] = (),
        inside: int = 0,
        colouring: Colouring | None = None,
    ) -> None:
        """Show distributions of the metric.

        Parameters
        ----------
        initial, current : Distribution or None
        kept : sequence of (slot, name, Distribution)
        inside : int
            Number of hexes of the current mesh that are invalid inside.
        colouring : Colouring, optional
            Colours of the bars of the current mesh, by default blue.
        """
        self._initial, self._current, self._kept, self._inside = initial, current, kept, inside
        self._colouring = colouring
        self._refresh()

    def _as_shown(self) -> ShownHistogram:
        """Return the distributions on an axis that fits them, in the order of the legend."""
        shown = [] if self._current is None else [Shown(tr("now"), BLUE, self._current, filled=True)]
        if self._initial is not None:
            shown.append(Shown(tr("at the start"), GREY, self._initial))
        shown += [Shown(name, KEPT[slot], one) for slot, name, one in self._kept]
        axis = Axis.fitted(self._metric, [one.distribution for one in shown], self.head.bins.value())
        return ShownHistogram(axis, shown, self.head.log.isChecked(), self.head.cumulative.isChecked())

    @property
    def axis(self) -> Axis:
        """Axis of values."""
        return self.shown.axis

    # Range

    def range(self) -> Show | None:
        """Return the range of the hexes shown; None for all hexes."""
        return self._range

    def set_range(self, range: Show | None) -> None:
        """Show a range of the histogram's metric, or None for all hexes, without emitting a signal."""
        self._range = range if range is not None and range.metric == self._metric else None
        self._show_range()

    def _on_clicked(self, place: QPointF, double: bool) -> None:
        """Show only the hexes of the bar at a position of the plot; after a double click all."""
        x, column = place.x(), self.plot.histogram.column
        if double:
            self._choose(None)
        elif column is not None and column[0] <= x <= column[1]:
            if self._current is not None and self._current.inverted:
                self.inverted_requested.emit()
        elif 0 <= x < self.axis.bins and place.y() <= self.plot.height_at(x):
            self._choose(self.axis.bin_range(int(x)))

    def _choose(self, range: Show | None) -> None:
        if range != self._range:
            self._range = range
            self._show_range()
            self.range_changed.emit(range)

    def _show_range(self) -> None:
        axis, range = self.axis, self._range
        column = self.plot.histogram.column or (0.0, 0.0)
        if range is None:
            span = None
        elif range.high == -math.inf:
            span = column
        else:
            span = column[0] if range.inverted else axis.position(range.low), axis.position(range.high)
        self.plot.show_range(span)
        self.range_row.show_range(axis, range)
        self.summary.setText(range_summary(self._current, range, self._inside))
        self.summary.setToolTip(self.summary.text())

    # Drawing

    def _refresh(self) -> None:
        shown = self.shown = self._as_shown()
        self.head.set_available(self._current is not None, len(self._kept) == len(KEPT))
        fixed = [(one.name, one.colour) for one in shown.shown[: len(shown.shown) - len(self._kept)]]
        self.legend.show_entries(fixed, [(slot, name, KEPT[slot]) for slot, name, _ in self._kept])
        colours = () if self._colouring is None else bin_colours(self._colouring, shown.axis)
        inverted = 0 if self._current is None else self._current.inverted
        self.plot.draw(shown.describe(colours=colours), inverted)
        self._show_range()


class HistogramLegend(QWidget):
    """Names and colours of the distributions; that of a kept one opens a menu.

    Signals
    -------
    renamed(slot, name)
        The user renamed a kept distribution.
    removed(slot)
        The user removed a kept distribution.
    """

    renamed = Signal(int, str)
    removed = Signal(int)

    def __init__(self, parent: QWidget | None = None):
        super().__init__(parent)
        self._flow = QFlowLayout(self)
        self._flow.setContentsMargins(0, 0, 0, 0)
        self._flow.setHorizontalSpacing(4)
        self._flow.setVerticalSpacing(0)
        self._shown: tuple = ()
        self.kept: dict[int, MenuButton] = {}

    def show_entries(self, fixed: Sequence[tuple[str, Role]], kept: Sequence[tuple[int, str, Role]]) -> None:
        """Show distributions by name and colour, and kept ones by slot, name and colour."""
        if (*fixed, *kept) == self._shown:
            return
        self._shown = (*fixed, *kept)
        clear(self._flow)
        for name, colour in fixed:
            self._flow.addWidget(_dressed(QToolButton(), name, colour))
        self.kept = {slot: self._entry(slot, name, colour) for slot, name, colour in kept}
        for entry in self.kept.values():
            self._flow.addWidget(entry)

    def _entry(self, slot: int, name: str, colour: Role) -> MenuButton:
        entry = MenuButton(name, tr("Distribution of {name}: rename or remove it.", name=name))
        entry.menu().addAction(tr("Rename…"), lambda: self._rename(slot, name))
        entry.menu().addAction(tr("Remove"), lambda: self.removed.emit(slot))
        return _dressed(entry, name, colour)

    def _rename(self, slot: int, name: str) -> None:
        normal = QLineEdit.EchoMode.Normal
        text, accepted = QInputDialog.getText(self, tr("Rename"), tr("Name of the distribution:"), normal, name)
        if accepted and text.strip():
            self.renamed.emit(slot, text.strip())


def _dressed(entry: Entry, name: str, colour: Role) -> Entry:
    """Give an entry its name and colour."""
    entry.setFont(smaller(entry.font()))
    entry.setText(QFontMetrics(entry.font()).elidedText(name, Qt.TextElideMode.ElideMiddle, _MAX_NAME_WIDTH))
    on_theme_change(entry, lambda: entry.setIcon(swatch_icon(colour)))
    entry.setToolButtonStyle(Qt.ToolButtonStyle.ToolButtonTextBesideIcon)
    entry.setAutoRaise(True)
    entry.setFixedHeight(_HEIGHT)
    if entry.menu() is None:
        entry.setFocusPolicy(Qt.FocusPolicy.NoFocus)  # it does nothing
    return entry
