"""Row of controls above the histogram: metric, scale, and a menu."""

from __future__ import annotations

from dataclasses import dataclass

from PySide6.QtCore import Qt, Signal
from PySide6.QtGui import QAction
from PySide6.QtWidgets import QHBoxLayout, QSizePolicy, QSpinBox, QWidget, QWidgetAction

from hexmend.quality import METRICS
from hexmend_app.codec.checks import check_count
from hexmend_app.features.histogram.bins import DEFAULT_BINS, MAX_BINS, MIN_BINS
from hexmend_app.theme.spacing import fill
from hexmend_app.theme.style import icon, set_help, smaller, tabular
from hexmend_app.translation import tr
from hexmend_app.widgets.inputs.combo import ComboBox, let_shrink
from hexmend_app.widgets.inputs.menu_button import MenuButton
from hexmend_app.widgets.inputs.segmented import Segmented
from hexmend_app.widgets.metric_texts import described, metrics_offered

_CUMULATIVE = "Show the share of hexes with a value up to x, inverted hexes first."
_KEEP = "Keep the current distribution to compare it with later ones, for example of other methods."
_SAVE = "Save the histogram as SVG, PDF or PNG, or its counts as CSV."
_FULL = "Remove a distribution first: at most six can be kept."
_BINS = "Number of bins."


@dataclass(frozen=True)
class HistogramSettings:
    """Settings of the histogram: logarithmic counts, cumulative counts, number of bins."""

    log: bool
    cumulative: bool
    bins: int

    def __post_init__(self) -> None:
        check_count("bins", self.bins)


class HistogramHead(QWidget):
    """Controls for metric, scale and bins, and to keep or save the distribution.

    Signals
    -------
    metric_chosen(str)
        The user selected a metric, or "" for that of the colours.
    scale_changed
        The heights changed between linear and logarithmic, or counts and cumulative shares.
    """

    metric_chosen = Signal(str)
    scale_changed = Signal()

    def __init__(self, parent: QWidget | None = None):
        super().__init__(parent)
        self.metric_box = ComboBox()
        let_shrink(self.metric_box, 6)
        self.metric_box.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Fixed)
        self.metric_box.setMaximumWidth(240)
        self.metric_box.addItem("", "")
        for metric in metrics_offered():
            self.metric_box.addItem(tr(metric.title), metric.name)
            self.metric_box.setItemData(self.metric_box.count() - 1, described(metric), Qt.ItemDataRole.ToolTipRole)
        self.metric_box.view().setMinimumWidth(220)
        self.metric_box.activated.connect(lambda: self.metric_chosen.emit(self.metric_box.currentData()))
        self.scale = Segmented(
            tr("Scale of the counts"),
            [
                ("linear", tr("Linear"), tr("Linear heights.")),
                ("log", tr("Log"), tr("Logarithmic heights, which show a few bad hexes among many good ones.")),
            ],
        )
        self.scale.setFont(smaller(self.font()))
        self.scale.chosen.connect(self.scale_changed)
        self.cumulative = self._action(tr("Cumulative"), tr(_CUMULATIVE))
        self.cumulative.setCheckable(True)
        self.cumulative.toggled.connect(self.scale_changed)
        self.keep = self._action(tr("Keep"), tr(_KEEP))
        self.save = self._action(tr("Save…"), tr(_SAVE))
        self._make_bins()
        self._lay_out()
        self.show_metric("q", True)

    def _action(self, text: str, help: str) -> QAction:
        action = QAction(text, self)
        action.setToolTip(f"<qt>{help}</qt>")
        action.setWhatsThis(help)
        return action

    def _make_bins(self) -> None:
        self.bins = QSpinBox()
        self.bins.setRange(MIN_BINS, MAX_BINS)
        self.bins.setSingleStep(10)
        self.bins.setValue(DEFAULT_BINS)
        self.bins.setSuffix(tr(" bins"))
        self.bins.setFont(tabular(smaller(self.font())))
        self.bins.setKeyboardTracking(False)
        self.bins.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        set_help(self.bins, tr("Bins"), tr(_BINS))

    def _lay_out(self) -> None:
        self.more = MenuButton(tr("More"), tr("Cumulative shares, number of bins, keep, save."))
        self.more.setIcon(icon("dots-vertical"))
        menu = self.more.menu()
        menu.addAction(self.cumulative)
        bins = QWidgetAction(menu)
        bins.setDefaultWidget(self.bins)
        menu.addActions([bins, self.keep, self.save])
        self.more.setSizePolicy(QSizePolicy.Policy.Fixed, QSizePolicy.Policy.Expanding)
        fill(QHBoxLayout(self), (self.metric_box, 1), None, self.scale, self.more, margins=(0, 0, 0, 0))

    @property
    def log(self) -> bool:
        """True if heights are logarithmic."""
        return self.scale.value() == "log"

    def settings(self) -> HistogramSettings:
        """Return the settings except the metric."""
        return HistogramSettings(self.log, self.cumulative.isChecked(), self.bins.value())

    def restore(self, settings: HistogramSettings) -> None:
        """Apply settings and emit the signals."""
        self.scale.set_value("log" if settings.log else "linear")
        self.cumulative.setChecked(settings.cumulative)
        self.bins.setValue(settings.bins)
        self.scale_changed.emit()

    def show_metric(self, name: str, as_colours: bool) -> None:
        """Show a metric, without emitting a signal; `as_colours` if it follows the metric of the colours."""
        metric = METRICS[name]
        self.metric_box.setItemText(
            0, tr("{title} (as colours)", title=tr(metric.title)) if as_colours else tr("As colours")
        )
        self.metric_box.setItemData(0, tr("Use the metric of the colours."), Qt.ItemDataRole.ToolTipRole)
        self.metric_box.setCurrentIndex(0 if as_colours else self.metric_box.findData(name))
        set_help(self.metric_box, tr("Metric of the histogram"), described(metric))
        self.metric_box.setToolTip(described(metric))

    def set_available(self, has_distribution: bool, full: bool) -> None:
        """Enable saving if there is a distribution, and keeping unless the legend is `full`."""
        self.save.setEnabled(has_distribution)
        self.keep.setEnabled(has_distribution and not full)
        self.keep.setToolTip(f"<qt>{tr(_FULL) if full else tr(_KEEP)}</qt>")
