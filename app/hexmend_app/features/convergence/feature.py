"""How runs converge: the lines between the history of runs and the charts that plot it."""

from __future__ import annotations

from pathlib import Path

from PySide6.QtCore import QTimer

from hexmend_app.features.convergence.file import write_convergence
from hexmend_app.features.convergence.panel import ConvergencePanel
from hexmend_app.features.save.feature import Saving
from hexmend_app.state.convergence import Columns, Curve, beginning, free_slot
from hexmend_app.state.history import Record
from hexmend_app.state.run import Phase
from hexmend_app.state.session import Session

#: Milliseconds between two drawings while a run goes on.
_PERIOD = 100


class Converging:
    """Brings the figures of all runs to the charts, and the user's clicks there to the timeline.

    Parameters
    ----------
    session : Session
        The window's state.
    panel : ConvergencePanel
    saving : Saving
        Asks where to, and says what has become of it.
    """

    def __init__(self, session: Session, panel: ConvergencePanel, saving: Saving):
        self._document, self._smoothing = session.document, session.smoothing
        timeline = self._timeline = session.timeline
        self._history = session.history
        self._panel = panel
        self._columns: dict[Record, Columns] = {}
        self._slots: dict[Record, int] = {}
        self._hidden: set[Record] = set()
        self._soon = QTimer(panel, singleShot=True, interval=_PERIOD)
        self._soon.timeout.connect(self._show)
        timeline.grown.connect(self._on_grown)
        timeline.moved.connect(self._on_moved)
        panel.came_into_view.connect(self._show)
        panel.choice_changed.connect(self._show)
        panel.toggled.connect(self._on_toggled)
        panel.forget_requested.connect(timeline.forget)
        panel.picked.connect(timeline.go_soon)
        panel.save_requested.connect(lambda: saving.ask_convergence(self.write))

    def write(self, path: Path) -> None:
        """Write the charts as a figure, or the figures of all runs as CSV, by the suffix."""
        write_convergence(path, self._panel, self._document.name)

    @property
    def _live(self) -> bool:
        return self._smoothing.phase is Phase.RUNNING

    def _on_grown(self) -> None:
        if not self._live:
            self._show()
        elif not self._soon.isActive():
            self._soon.start()

    def _on_moved(self) -> None:
        if not self._timeline.live:  # or it is drawn with the curves
            self._mark()

    def _on_toggled(self, record: Record, on: bool) -> None:
        (self._hidden.discard if on else self._hidden.add)(record)
        self._show()

    def _show(self) -> None:
        if not self._panel.isVisible():
            return  # it tells when it comes into view
        records = self._history.records
        self._columns = {record: self._columns.get(record) or Columns(record) for record in records}
        self._hidden &= set(records)
        self._slots = {record: slot for record, slot in self._slots.items() if record in self._columns}
        for record in records:
            self._slots.setdefault(record, free_slot(self._slots.values()))
            self._columns[record].grow()
        self._panel.set_curves([self._curve(record) for record in records if len(self._columns[record])])
        self._mark()

    def _curve(self, record: Record) -> Curve:
        return Curve(
            self._columns[record],
            self._slots[record],
            (0.0, 0.0) if self._panel.from_zero.isChecked() else beginning(record),
            shown=record not in self._hidden,
            current=record is self._timeline.record,
            going=self._smoothing.busy and record is self._smoothing.record,
            kept=lambda: self._history.kept(record),
        )

    def _mark(self) -> None:
        moment = self._timeline.moment
        if moment is None:
            self._panel.set_shown(None)
        else:
            self._panel.set_shown(moment.record, moment.number)
