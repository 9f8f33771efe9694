"""The camera's flights in time."""

from __future__ import annotations

from PySide6.QtCore import QElapsedTimer, QObject, QTimer, Signal

from hexmend_app.scene.camera.flight import Flight

#: Milliseconds that the camera flies, and between two of its frames.
_FLIGHT, _FRAME = 350, 25


class Flying(QObject):
    """Leads the camera on its way, frame by frame.

    Signals
    -------
    moved
        The camera is a little further.
    """

    moved = Signal()

    def __init__(self, parent: QObject | None = None):
        super().__init__(parent)
        self._flight: Flight | None = None
        self._flown = QElapsedTimer()
        self._timer = QTimer(self, interval=_FRAME)
        self._timer.timeout.connect(self._go_on)

    def start(self, flight: Flight) -> None:
        """Set out; a flight that is on its way ends where it is."""
        self._flight = flight
        self._flown.start()
        self._timer.start()

    def stop(self) -> None:
        """End where the camera is."""
        self._timer.stop()

    @property
    def under_way(self) -> bool:
        """Whether the camera flies."""
        return self._timer.isActive()

    def _go_on(self) -> None:
        share = min(self._flown.elapsed() / _FLIGHT, 1.0)
        self._flight.at(share)
        if share == 1.0:
            self._timer.stop()
        self.moved.emit()
