"""Circular garbage is collected in the thread of the window alone.

Python collects wherever the limit happens to be passed. In a thread of work that would take down widgets, timers and
what VTK draws with, all of which belong to the window's thread: a crash that hits once in a thousand runs.
"""

from __future__ import annotations

import atexit
import gc

from PySide6.QtCore import QObject, QTimer

#: Milliseconds between two looks at how much there is.
_INTERVAL = 100


class UiThreadGC(QObject):
    """Collects circular garbage in the thread that made it, by Python's own thresholds; elsewhere there is none.

    Parameters
    ----------
    parent : QObject
        With it the looking ends. Python's own collecting stays off: threads may still be running.
    """

    def __init__(self, parent: QObject):
        super().__init__(parent)
        gc.disable()
        atexit.register(gc.freeze)  # at the end all goes with the process: widgets outlive the application there
        self._timer = QTimer(self, interval=_INTERVAL)
        self._timer.timeout.connect(self.look)
        self._timer.start()

    def spare(self) -> None:
        """Look no more at what there is by now, garbage or not: modules and a window stay as long as the program.

        A tenth of a second is what a look at all of them takes, and the window stands still meanwhile.
        """
        gc.freeze()

    def look(self) -> None:
        """Collect the oldest generation that has passed its threshold, and the younger ones with it."""
        for generation in (2, 1, 0):
            if gc.get_count()[generation] > gc.get_threshold()[generation] > 0:
                gc.collect(generation)
                return
