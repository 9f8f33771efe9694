"""Task whose steps are executed by the event loop."""

from __future__ import annotations

from collections.abc import Callable, Generator
from typing import Any

from PySide6.QtCore import QObject, QTimer, Signal

from hexmend_app.translation import tr
from hexmend_app.widgets.busy import Busy


class IncrementalTask(QObject):
    """Task that computes one item of an iterator in each turn of the event loop, and reports progress.

    Parameters
    ----------
    busy : Busy
        Shows the progress, with a button to cancel.
    owner : str
        Owner of the task in `busy`.
    help : str
        Tooltip of the button: the effect of cancelling.

    Signals
    -------
    finished(list)
        All items are computed.
    failed(Exception)
        An item could not be computed; the task is cancelled.
    """

    finished = Signal(object)
    failed = Signal(object)

    def __init__(self, busy: Busy, owner: str, help: str, parent: QObject | None = None):
        super().__init__(parent)
        self._busy, self._owner, self._help = busy, owner, help
        self._iterator: Generator[Any] | None = None
        self._items: list[Any] = []
        self._describe: Callable[[int], str] = str
        self._timer = QTimer(self, interval=0)
        self._timer.timeout.connect(self._step)

    @property
    def going_on(self) -> bool:
        """Return True while steps are left."""
        return self._iterator is not None

    def begin(self, iterator: Generator[Any], describe: Callable[[int], str]) -> None:
        """Cancel the current task and start another.

        Parameters
        ----------
        iterator : generator
            Yields the items; None is not allowed.
        describe : callable
            Returns the text to show while the item of an index is computed.
        """
        self.cancel()
        self._iterator, self._describe, self._items = iterator, describe, []
        self._timer.start()
        self._show()

    def cancel(self) -> None:
        """Cancel the remaining steps."""
        if self.going_on:
            self._timer.stop()
            self._iterator.close()
            self._iterator, self._items = None, []
            self._busy.done(self._owner)

    def _step(self) -> None:
        try:
            item = next(self._iterator, None)
        except Exception as error:  # any error is reported
            self.cancel()
            self.failed.emit(error)
            return
        if item is not None:
            self._items.append(item)
            self._show()
            return
        items = self._items
        self.cancel()
        self.finished.emit(items)

    def _show(self) -> None:
        self._busy.show_work(self._owner, self._describe(len(self._items)), tr("Cancel"), self._help, self.cancel)
