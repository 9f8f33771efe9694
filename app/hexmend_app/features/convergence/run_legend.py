"""The runs that are plotted: each with its colour and a check box, and a cross to forget it."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtCore import QSize, Qt, Signal
from PySide6.QtWidgets import QCheckBox, QHBoxLayout, QSizePolicy, QToolButton, QVBoxLayout, QWidget

from hexmend_app.features.convergence.curves import Curve, colour_of
from hexmend_app.state.mesh.history import RunRecord
from hexmend_app.theme.palette import HOVER
from hexmend_app.theme.style import BLUE, MUTED, icon, on_theme_change, set_help, smaller
from hexmend_app.widgets.legend import Swatch
from hexmend_app.widgets.wording import counted


def _sheet() -> str:
    return f"""
QToolButton {{ border: none; border-radius: 3px; padding: 0; }}
QToolButton:hover {{ background: {HOVER}; }}
QToolButton:focus {{ border: 1px solid {BLUE}; }}
"""


class RunLegend(QWidget):
    """Lists runs, the oldest first; the name of the one that is gone through is bold.

    Signals
    -------
    toggled(Record, bool)
        The user wants a run plotted, or not.
    forget_requested(Record)
    """

    toggled = Signal(object, bool)
    forget_requested = Signal(object)

    def __init__(self, parent: QWidget | None = None):
        super().__init__(parent)
        self.rows: dict[RunRecord, RunRow] = {}
        self._layout = QVBoxLayout(self)
        self._layout.setContentsMargins(0, 0, 0, 0)
        self._layout.setSpacing(1)
        self._layout.addStretch()
        on_theme_change(self, lambda: self.setStyleSheet(_sheet()))

    def set_curves(self, curves: Sequence[Curve]) -> None:
        """Show these runs."""
        for record in self.rows.keys() - {one.record for one in curves}:
            row = self.rows.pop(record)
            self._layout.removeWidget(row)
            row.hide()
            row.deleteLater()  # its button is the one that was clicked
        for curve in curves:
            if curve.record not in self.rows:
                row = self.rows[curve.record] = RunRow(curve)
                row.box.clicked.connect(lambda on, record=curve.record: self.toggled.emit(record, on))
                row.cross.clicked.connect(lambda _=False, record=curve.record: self.forget_requested.emit(record))
                self._layout.insertWidget(self._layout.count() - 1, row)
            self.rows[curve.record].show_curve(curve)


class RunRow(QWidget):
    """One run."""

    def __init__(self, curve: Curve):
        super().__init__()
        self._report: tuple = ()
        self.box = QCheckBox(curve.record.name)
        self.box.setFont(smaller(self.font()))
        self.box.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Fixed)
        self.cross = QToolButton()
        self.cross.setIcon(icon("close", MUTED))
        self.cross.setIconSize(QSize(11, 11))
        self.cross.setFixedSize(16, 16)
        self.cross.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        layout = QHBoxLayout(self)
        layout.setContentsMargins(0, 0, 0, 0)
        layout.setSpacing(4)
        layout.addWidget(Swatch(colour_of(curve)))
        layout.addWidget(self.box, 1)
        layout.addWidget(self.cross)

    def show_curve(self, curve: Curve) -> None:
        """Say what there is of the run now."""
        record = curve.record
        text = (curve.shown, curve.current, curve.going, record.newest, record.parent)
        if text == self._report:
            return
        self._report = text
        self.box.setChecked(curve.shown)
        font = self.box.font()
        font.setBold(curve.current)
        self.box.setFont(font)
        branch = f", from {record.parent.name} on" if record.parent is not None else ""
        here = " It is the run that is gone through." if curve.current else ""
        set_help(self.box, record.name, f"Plot {record.title}: {counted(record.newest, 'iteration')}{branch}.{here}")
        self.cross.setEnabled(not curve.going)
        help = "It goes on: stop it first." if curve.going else "Its figures and iterations are gone then."
        set_help(self.cross, f"Forget {record.name}", f"Keep {record.name} no longer. {help}")
