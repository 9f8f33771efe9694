"""Garbage collection in the thread of the window only.

Python collects cyclic garbage in whichever thread passes the threshold. A worker thread would then delete widgets,
timers and VTK objects, which belong to the window's thread: a crash in one of a thousand runs.
"""

from __future__ import annotations

import atexit
import gc

from PySide6.QtCore import QObject, QTimer

#: Milliseconds between two checks of the thresholds.
_INTERVAL = 100


class UiThreadGC(QObject):
    """Collects cyclic garbage in the thread that makes this object, by Python's thresholds, instead of in any thread.

    Parameters
    ----------
    parent : QObject
        Collection ends with it. Python's automatic collection stays off, as threads may still be running.
    """

    def __init__(self, parent: QObject):
        super().__init__(parent)
        gc.disable()
        atexit.register(gc.freeze)  # collect nothing at exit, where widgets outlive the application
        self._timer = QTimer(self, interval=_INTERVAL)
        self._timer.timeout.connect(self.collect)
        self._timer.start()

    def freeze(self) -> None:
        """Exclude all present objects from collections, since modules and windows live as long as the program.

        Examining them would take 0.1 s, during which the window does not respond.
        """
        gc.freeze()

    def collect(self) -> None:
        """Collect the oldest generation that has passed its threshold, and the younger ones with it."""
        for generation in (2, 1, 0):
            if gc.get_count()[generation] > gc.get_threshold()[generation] > 0:
                gc.collect(generation)
                return
