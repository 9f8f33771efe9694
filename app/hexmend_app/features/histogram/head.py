"""Row of controls above the histogram: metric, Keep, and a menu."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import QHBoxLayout, QPushButton, QSizePolicy, QSpinBox, QWidget, QWidgetAction

from hexmend.quality import METRICS
from hexmend_app.report.distribution import DEFAULT_BINS, MAX_BINS, MIN_BINS
from hexmend_app.theme.spacing import fill
from hexmend_app.theme.style import icon, narrow, set_help, smaller, tabular
from hexmend_app.translation import tr
from hexmend_app.widgets.inputs.combo import ComboBox, let_shrink
from hexmend_app.widgets.inputs.menu_button import MenuButton
from hexmend_app.widgets.metric_texts import described, metrics_offered
from hexmend_app.widgets.wording import noun_of, plural

_LOG = "Logarithmic heights, which show a few bad hexes among many good ones."
_CUMULATIVE = "Show the share of hexes with a value up to x, inverted hexes first."
_KEEP = "Keep the current distribution to compare it with later ones, for example of other methods."
_SAVE = "Save the histogram as SVG, PDF or PNG, or its counts as CSV."
_FULL = "Remove a distribution first: at most six can be kept."
_BINS = "Number of bins."


class HistogramHead(QWidget):
    """Controls for metric, scale and bins, and to keep or save the distribution.

    Signals
    -------
    metric_chosen(str)
        The user selected a metric, or "" for that of the colours.
    kind_chosen
        The user selected the cells of another `kind`.
    scale_changed
        The user changed the heights, or the number of bins.
    """

    metric_chosen = Signal(str)
    kind_chosen = Signal()
    scale_changed = Signal()

    def __init__(self, parent: QWidget | None = None):
        super().__init__(parent)
        self.metric_box = ComboBox()
        let_shrink(self.metric_box, 6)
        self.metric_box.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Fixed)
        self.metric_box.setMaximumWidth(240)
        self.metric_box.addItem("", "")
        for metric in metrics_offered():
            self.metric_box.add(tr(metric.title), described(metric), metric.name)
        self.metric_box.view().setMinimumWidth(220)
        self.metric_box.activated.connect(lambda: self.metric_chosen.emit(self.metric_box.currentData()))
        self.kind_box = ComboBox()
        let_shrink(self.kind_box, 6)
        self.kind_box.activated.connect(self.kind_chosen)
        set_help(self.kind_box, tr("Kind of cells"), tr("Count all cells, or those of one kind."))
        self.show_kinds([])
        self.keep = QPushButton(tr("Keep"))
        narrow(self.keep)
        self._make_menu()
        fill(QHBoxLayout(self), (self.metric_box, 1), self.kind_box, self.keep, self.more, margins=(0, 0, 0, 0))
        self.show_metric("q", True)

    def _make_bins(self) -> None:
        self.bins = QSpinBox()
        self.bins.setRange(MIN_BINS, MAX_BINS)
        self.bins.setSingleStep(10)
        self.bins.setValue(DEFAULT_BINS)
        self.bins.setSuffix(tr(" bins"))
        self.bins.setFont(tabular(smaller(self.font())))
        self.bins.setKeyboardTracking(False)
        self.bins.valueChanged.connect(self.scale_changed)
        self.bins.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        set_help(self.bins, tr("Bins"), tr(_BINS))

    def _make_menu(self) -> None:
        self.more = MenuButton(tr("More"), tr("Logarithmic heights, cumulative shares, number of bins, save."))
        self.more.setIcon(icon("dots-vertical"))
        self.more.setSizePolicy(QSizePolicy.Policy.Fixed, QSizePolicy.Policy.Expanding)
        self.log = self.more.add(tr("Logarithmic"), tr(_LOG), False)
        self.cumulative = self.more.add(tr("Cumulative"), tr(_CUMULATIVE), False)
        for action in (self.log, self.cumulative):
            action.toggled.connect(self.scale_changed)
        self._make_bins()
        bins = QWidgetAction(self.more)
        bins.setDefaultWidget(self.bins)
        self.more.menu().addAction(bins)
        self.save = self.more.add(tr("Save…"), tr(_SAVE))

    def show_metric(self, name: str, as_colours: bool) -> None:
        """Show a metric, without emitting a signal; `as_colours` if it follows the metric of the colours."""
        metric = METRICS[name]
        self.metric_box.setItemText(
            0, tr("{title} (as colours)", title=tr(metric.title)) if as_colours else tr("As colours")
        )
        self.metric_box.setItemData(0, tr("Use the metric of the colours."), Qt.ItemDataRole.ToolTipRole)
        self.metric_box.setCurrentIndex(0 if as_colours else self.metric_box.findData(name))
        set_help(self.metric_box, tr("Metric of the histogram"), described(metric))

    @property
    def kind(self) -> str:
        """Kind of the cells that are counted; "" for all."""
        return self.kind_box.currentData()

    def show_kinds(self, kinds: Sequence[str]) -> None:
        """Offer all cells, and those of each kind, if there are several kinds, without emitting a signal."""
        self.kind_box.clear()
        self.kind_box.addItem(tr("All cells"), "")
        for kind in kinds:
            self.kind_box.addItem(plural(noun_of(kind)).capitalize(), kind)
        self.kind_box.setVisible(len(kinds) > 1)

    def set_available(self, has_distribution: bool, full: bool) -> None:
        """Enable saving if there is a distribution, and keeping unless the legend is `full`."""
        self.save.setEnabled(has_distribution)
        self.keep.setEnabled(has_distribution and not full)
        set_help(self.keep, tr("Keep"), tr(_FULL) if full else tr(_KEEP))
