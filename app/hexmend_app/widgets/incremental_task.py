"""Work that is done in steps of the event loop."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any

from PySide6.QtCore import QObject, QTimer, Signal

from hexmend_app.widgets.busy import Busy


class IncrementalTask(QObject):
    """Takes one item of an iterator in each turn of the event loop, and reports progress.

    Parameters
    ----------
    busy : Busy
        Where it is said, with a way out.
    who : str
        What `busy` knows it by.
    help : str
        What it means to give the rest up.

    Signals
    -------
    finished(list)
        All pieces are there.
    failed(Exception)
        One of them is not to be had; the rest is given up.
    """

    finished = Signal(object)
    failed = Signal(object)

    def __init__(self, busy: Busy, owner: str, help: str, parent: QObject | None = None):
        super().__init__(parent)
        self._busy, self._owner, self._help = busy, owner, help
        self._coming: Iterator[Any] | None = None
        self._taken: list[Any] = []
        self._say: Callable[[int], str] = str
        self._next = QTimer(self, interval=0)
        self._next.timeout.connect(self._take)

    @property
    def going_on(self) -> bool:
        """Return True while steps are left."""
        return self._coming is not None

    def begin(self, coming: Iterator[Any], say: Callable[[int], str]) -> None:
        """Start to take the items of a generator.

        Parameters
        ----------
        coming : generator
            Brings no None.
        say : callable
            What is being done once so many pieces are there.
        """
        self.cancel()
        self._coming, self._say, self._taken = coming, say, []
        self._next.start()
        self._show()

    def cancel(self) -> None:
        """Cancel the remaining steps."""
        if self.going_on:
            self._next.stop()
            self._coming.close()
            self._coming, self._taken = None, []
            self._busy.done(self._owner)

    def _take(self) -> None:
        try:
            piece = next(self._coming, None)
        except Exception as error:  # any error is reported
            self.cancel()
            self.failed.emit(error)
            return
        if piece is not None:
            self._taken.append(piece)
            self._show()
            return
        taken = self._taken
        self.cancel()
        self.finished.emit(taken)

    def _show(self) -> None:
        self._busy.show_work(self._owner, self._say(len(self._taken)), "Cancel", self._help, self.cancel)
