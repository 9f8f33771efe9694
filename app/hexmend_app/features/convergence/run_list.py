"""List of the plotted runs, each with its colour and a check box."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtCore import QSignalBlocker, Qt, Signal
from PySide6.QtWidgets import QListWidget, QListWidgetItem, QWidget

from hexmend_app.features.convergence.curves import Curve, colour_of
from hexmend_app.theme.style import on_theme_change, set_help, smaller
from hexmend_app.translation import tr
from hexmend_app.widgets.legend import swatch_icon
from hexmend_app.widgets.wording import counted


class RunList(QListWidget):
    """List of runs, the oldest first; the name of the current run is bold.

    Signals
    -------
    toggled(RunRecord, bool)
        The user showed or hid a run.
    """

    toggled = Signal(object, bool)

    def __init__(self, parent: QWidget | None = None):
        super().__init__(parent)
        self._curves: Sequence[Curve] = ()
        self.setFont(smaller(self.font()))
        set_help(self, tr("Runs"), tr("Check the runs to plot; the current run is bold."))
        self.itemChanged.connect(self._on_changed)
        on_theme_change(self, lambda: self.set_curves(self._curves))

    def set_curves(self, curves: Sequence[Curve]) -> None:
        """List these runs."""
        self._curves = curves
        with QSignalBlocker(self):
            while self.count() < len(curves):
                self.addItem(QListWidgetItem())
            while self.count() > len(curves):
                self.takeItem(self.count() - 1)
            for row, curve in enumerate(curves):
                self._show(self.item(row), curve)

    def _show(self, item: QListWidgetItem, curve: Curve) -> None:
        record = curve.record
        item.setText(record.name)
        item.setIcon(swatch_icon(colour_of(curve)))
        item.setCheckState(Qt.CheckState.Checked if curve.shown else Qt.CheckState.Unchecked)
        font = self.font()
        font.setBold(curve.current)
        item.setFont(font)
        values = {"title": tr(record.title), "count": counted(record.newest, record.unit)}
        if record.parent is None:
            item.setToolTip(tr("{title}: {count}.", **values))
        else:
            item.setToolTip(tr("{title}: {count}, branched from {parent}.", parent=record.parent.name, **values))

    def _on_changed(self, item: QListWidgetItem) -> None:
        self.toggled.emit(self._curves[self.row(item)].record, item.checkState() == Qt.CheckState.Checked)
