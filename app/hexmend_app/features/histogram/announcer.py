"""Rate-limited signal for a choice that the user makes by dragging."""

from __future__ import annotations

from PySide6.QtCore import QObject, Signal
from superqt.utils import QSignalThrottler

_PERIOD_MS = 33


class Announcer(QObject):
    """Tells the newest of many values at most thirty times a second, and knows what was told when it is heard again.

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
        self._newest: object = None
        self._known: object = None  # what everybody else knows
        self._waits = False

    def tell(self, value: object) -> None:
        """Announce a value soon."""
        self._newest, self._waits = value, True
        self._throttler.throttle()

    def tell_instead(self, value: object) -> None:
        """Announce another value than the one that waits; nothing where none does."""
        self._newest = value

    def hear(self, value: object) -> bool:
        """Take what others know now, and give up what waits; not where that is only what was announced last."""
        if self._waits and value == self._known:
            return False
        self._throttler.cancel()
        self._newest = self._known = value
        self._waits = False
        return True

    def _announce(self) -> None:
        self._known, self._waits = self._newest, False
        self.announced.emit(self._newest)
