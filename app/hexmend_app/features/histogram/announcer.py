"""Rate-limited signal for a value that the user changes by dragging."""

from __future__ import annotations

from PySide6.QtCore import QObject, Signal
from superqt.utils import QSignalThrottler

_PERIOD_MS = 33


class Announcer(QObject):
    """Emits the latest of many values at most thirty times a second, and recognises its own values when they return.

    A receiver of the signal may set the value again, while the user has already dragged on: such an outdated value
    must not replace the pending one.

    Signals
    -------
    announced(value)
    """

    announced = Signal(object)

    def __init__(self, parent: QObject | None = None):
        super().__init__(parent)
        self._throttler = QSignalThrottler(parent=self)
        self._throttler.setTimeout(_PERIOD_MS)
        self._throttler.triggered.connect(self._announce)
        self._latest: object = None
        self._announced: object = None  # or received since
        self._pending = False

    def send(self, value: object) -> None:
        """Announce a value soon."""
        self._latest, self._pending = value, True
        self._throttler.throttle()

    def replace_pending(self, value: object) -> None:
        """Replace the pending value; nothing is announced if there is none."""
        self._latest = value

    def receive(self, value: object) -> bool:
        """Accept a value from outside and drop the pending one; ignore an outdated value and return False."""
        if self._pending and value == self._announced:
            return False
        self._throttler.cancel()
        self._latest = self._announced = value
        self._pending = False
        return True

    def _announce(self) -> None:
        self._announced, self._pending = self._latest, False
        self.announced.emit(self._latest)
