"""Timer that combines all changes in a turn of the event loop into one refresh."""

from __future__ import annotations

from PySide6.QtCore import QObject, QTimer, Signal


class RefreshTimer(QObject):
    """Timer of the window's refreshes.

    Signals
    -------
    all_changed
        Emitted once after the changes in a turn of the event loop.
    iteration_changed
        Emitted instead if only the iteration of a run has changed.
    """

    all_changed = Signal()
    iteration_changed = Signal()

    def __init__(self, parent: QObject):
        super().__init__(parent)
        self._timer = QTimer(self, singleShot=True, interval=0)
        self._timer.timeout.connect(self._on_timeout)
        self._all = False

    def refresh(self, iteration_only: bool) -> None:
        """Request a refresh in the next turn of the event loop."""
        self._all = self._all or not iteration_only
        if not self._timer.isActive():
            self._timer.start()

    def stop(self) -> None:
        """Cancel a pending refresh."""
        self._timer.stop()
        self._all = False

    def _on_timeout(self) -> None:
        signal = self.all_changed if self._all else self.iteration_changed
        self._all = False
        signal.emit()
