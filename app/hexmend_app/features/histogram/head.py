"""The row above the histogram: what it shows and how; what does not fit stands in a menu."""

from __future__ import annotations

from dataclasses import dataclass

from PySide6.QtCore import QSignalBlocker, QSize, Qt, Signal
from PySide6.QtGui import QAction, QActionGroup, QResizeEvent
from PySide6.QtWidgets import QComboBox, QHBoxLayout, QSizePolicy, QSpinBox, QToolButton, QWidget

from hexmend.quality import METRICS
from hexmend_app.codec.checks import check_count
from hexmend_app.features.histogram.bins import BINS, FEWEST, MOST
from hexmend_app.theme.style import icon, set_help, smaller, tabular
from hexmend_app.widgets.inputs.combo import let_shrink
from hexmend_app.widgets.inputs.menu_button import MenuButton
from hexmend_app.widgets.inputs.segmented import Segmented
from hexmend_app.widgets.metric_texts import described, metrics_offered

_CUMULATIVE = "Heights are the share of hexes with a value up to x, inverted ones first."
_KEEP = "Keep the present distribution for comparison with later ones, to compare methods."
_SAVE = "Save the histogram as it is drawn, as SVG, PDF or PNG, or its counts as CSV."
_FULL = "At most six are kept: remove one first."
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
    """Chooses metric, scale and bins; asks to keep and to save.

    Signals
    -------
    metric_chosen(str)
        The user chose a metric, or "", that of the colours.
    scale_changed
        Linear or logarithmic, counts or shares.
    bins_changed
    keep_requested, save_requested
    """

    metric_chosen = Signal(str)
    scale_changed = Signal()
    bins_changed = Signal()
    keep_requested = Signal()
    save_requested = Signal()

    def __init__(self, parent: QWidget | None = None):
        super().__init__(parent)
        self.metric_box = QComboBox()
        let_shrink(self.metric_box, 9)
        self.metric_box.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Fixed)
        self.metric_box.setMaximumWidth(240)
        self.metric_box.addItem("", "")
        for metric in metrics_offered():
            self.metric_box.addItem(metric.title, metric.name)
            self.metric_box.setItemData(self.metric_box.count() - 1, described(metric), Qt.ItemDataRole.ToolTipRole)
        self.metric_box.view().setMinimumWidth(220)
        self.metric_box.activated.connect(lambda: self.metric_chosen.emit(self.metric_box.currentData()))
        self.scale = Segmented(
            "Scale of the counts",
            [
                ("linear", "Linear", "Heights in proportion to the number of hexes."),
                ("log", "Log", "Logarithmic heights, so that a few bad hexes are visible among many good ones."),
            ],
        )
        self.scale.setFont(smaller(self.font()))
        self.scale.chosen.connect(self.scale_changed)
        self.cumulative = self._action("Cumulative", _CUMULATIVE)
        self.cumulative.setCheckable(True)
        self.cumulative.toggled.connect(self.scale_changed)
        self.keep = self._action("Keep", _KEEP)
        self.keep.triggered.connect(self.keep_requested)
        self.save = self._action("Save…", _SAVE)
        self.save.triggered.connect(self.save_requested)
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
        self.bins.setRange(FEWEST, MOST)
        self.bins.setSingleStep(10)
        self.bins.setValue(BINS)
        self.bins.setSuffix(" bins")
        self.bins.setFont(tabular(smaller(self.font())))
        self.bins.setKeyboardTracking(False)
        self.bins.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        set_help(self.bins, "Bins", _BINS)
        self.bins.valueChanged.connect(self._on_bins)
        self._numbers = QActionGroup(self)
        for number in (FEWEST, 20, BINS, 100, MOST):
            action = QAction(str(number), self._numbers)
            action.setCheckable(True)
            action.setChecked(number == BINS)
            action.triggered.connect(lambda _=False, number=number: self.bins.setValue(number))

    def _lay_out(self) -> None:
        self.more = MenuButton("More", "Cumulative shares, the number of bins, keeping and saving.")
        self.more.setIcon(icon("dots-vertical"))
        menu = self.more.menu()
        menu.addAction(self.cumulative)
        menu.addMenu("Bins").addActions(self._numbers.actions())
        menu.addSeparator()
        menu.addActions([self.keep, self.save])
        buttons = {action: QToolButton() for action in (self.keep, self.cumulative)}
        for action, button in buttons.items():
            button.setDefaultAction(action)
            button.setFont(smaller(self.font()))
        for button in (*buttons.values(), self.more):
            button.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
            button.setSizePolicy(QSizePolicy.Policy.Fixed, QSizePolicy.Policy.Expanding)
        # In the order in which they are given up where room is short.
        self._spare = (self.bins, buttons[self.cumulative], buttons[self.keep])
        layout = QHBoxLayout(self)
        layout.setContentsMargins(0, 0, 0, 0)
        layout.setSpacing(6)
        layout.addWidget(self.metric_box, 1)
        layout.addStretch()
        for part in (self.scale, buttons[self.cumulative], self.bins, buttons[self.keep], self.more):
            layout.addWidget(part)

    @property
    def log(self) -> bool:
        """Return True if heights are logarithmic."""
        return self.scale.value() == "log"

    def settings(self) -> HistogramSettings:
        """Return the settings except the metric."""
        return HistogramSettings(self.log, self.cumulative.isChecked(), self.bins.value())

    def restore(self, settings: HistogramSettings) -> None:
        """Set all of it, and say so."""
        self.scale.set_value("log" if settings.log else "linear")
        self.cumulative.setChecked(settings.cumulative)
        self.bins.setValue(settings.bins)
        self.scale_changed.emit()

    def show_metric(self, name: str, as_colours: bool) -> None:
        """Show which metric is drawn, and whether it is that of the colours by itself; without a signal."""
        metric = METRICS[name]
        if as_colours:
            self.metric_box.setItemText(0, f"{metric.title} (as colours)")
        else:
            self.metric_box.setItemText(0, "As colours")
        self.metric_box.setItemData(0, "Show whatever metric the colours show.", Qt.ItemDataRole.ToolTipRole)
        self.metric_box.setCurrentIndex(0 if as_colours else self.metric_box.findData(name))
        set_help(self.metric_box, "Metric of the histogram", described(metric))
        self.metric_box.setToolTip(described(metric))

    def set_offered(self, known: bool, full: bool) -> None:
        """Say whether there is something to keep or save, and whether as much is kept as can be."""
        self.save.setEnabled(known)
        self.keep.setEnabled(known and not full)
        self.keep.setToolTip(f"<qt>{_FULL if full else _KEEP}</qt>")

    def minimumSizeHint(self) -> QSize:
        """Without what can stand in the menu."""
        parts = (self.metric_box, self.scale, self.more)
        width = sum(part.minimumSizeHint().width() for part in parts) + 3 * self.layout().spacing()
        return QSize(width, max(part.minimumSizeHint().height() for part in parts))

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Show what there is room for."""
        super().resizeEvent(event)
        gap = self.layout().spacing()
        space = self.width() - self.minimumSizeHint().width() - 50  # so that the metric's name is whole
        for part in reversed(self._spare):
            space -= part.sizeHint().width() + gap
            part.setVisible(space >= 0)

    def _on_bins(self) -> None:
        with QSignalBlocker(self._numbers):
            for action in self._numbers.actions():
                action.setChecked(action.text() == str(self.bins.value()))
        self.bins_changed.emit()
