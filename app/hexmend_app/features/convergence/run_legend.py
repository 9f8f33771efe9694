"""List of the plotted runs, each with its colour, a check box and a delete button."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QCheckBox, QHBoxLayout, QSizePolicy, QVBoxLayout, QWidget

from hexmend_app.features.convergence.curves import Curve, colour_of
from hexmend_app.state.mesh.history import RunRecord
from hexmend_app.theme.spacing import fill
from hexmend_app.theme.style import cross_button, set_help, smaller
from hexmend_app.translation import tr
from hexmend_app.widgets.legend import Swatch
from hexmend_app.widgets.wording import counted


class RunLegend(QWidget):
    """List of runs, the oldest first; the name of the current run is bold.

    Signals
    -------
    toggled(RunRecord, bool)
        The user showed or hid a run.
    forget_requested(RunRecord)
        The user deleted a run.
    """

    toggled = Signal(object, bool)
    forget_requested = Signal(object)

    def __init__(self, parent: QWidget | None = None):
        super().__init__(parent)
        self.rows: dict[RunRecord, RunRow] = {}
        self._layout = fill(QVBoxLayout(self), None, margins=(0, 0, 0, 0), spacing=0)

    def set_curves(self, curves: Sequence[Curve]) -> None:
        """List these runs."""
        for record in self.rows.keys() - {curve.record for curve in curves}:
            row = self.rows.pop(record)
            self._layout.removeWidget(row)
            row.hide()
            row.deleteLater()  # not at once: this may be called by its button
        for curve in curves:
            if curve.record not in self.rows:
                row = self.rows[curve.record] = RunRow(curve)
                row.box.clicked.connect(lambda on, record=curve.record: self.toggled.emit(record, on))
                row.cross.clicked.connect(lambda _=False, record=curve.record: self.forget_requested.emit(record))
                self._layout.insertWidget(self._layout.count() - 1, row)
            self.rows[curve.record].show_curve(curve)


class RunRow(QWidget):
    """Row of the list for one run.

    Attributes
    ----------
    box : QCheckBox
    cross : QToolButton
        Deletes the run.
    """

    def __init__(self, curve: Curve):
        super().__init__()
        self._shown: tuple = ()
        self.box = QCheckBox(curve.record.name)
        self.box.setFont(smaller(self.font()))
        self.box.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Fixed)
        self.cross = cross_button()
        fill(QHBoxLayout(self), Swatch(colour_of(curve)), (self.box, 1), self.cross, margins=(0, 0, 0, 0), spacing=4)

    def show_curve(self, curve: Curve) -> None:
        """Show the current state of the run."""
        record = curve.record
        state = (curve.shown, curve.current, curve.running, record.newest, record.parent)
        if state == self._shown:
            return
        self._shown = state
        self.box.setChecked(curve.shown)
        font = self.box.font()
        font.setBold(curve.current)
        self.box.setFont(font)
        values = {"title": tr(record.title), "count": counted(record.newest, record.unit)}
        if record.parent is None:
            help = tr("Plot {title}: {count}.", **values)
        else:
            help = tr("Plot {title}: {count}, branched from {parent}.", parent=record.parent.name, **values)
        if curve.current:
            help += " " + tr("This is the current run.")
        set_help(self.box, record.name, help)
        self.cross.setEnabled(not curve.running)
        if curve.running:
            help = tr("Stop the run to delete it.")
        else:
            help = tr("Delete this run with its iterations and values.")
        set_help(self.cross, tr("Delete {name}", name=record.name), help)
