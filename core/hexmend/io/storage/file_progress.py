"""Progress of reading and writing files: readers and writers report, and whoever watches is told the share done."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from dataclasses import dataclass
from enum import Enum
from math import ceil
from pathlib import Path
from time import monotonic

#: Seconds between reports that are passed on.
_INTERVAL = 0.05

#: Smallest share from which the time left is estimated, and seconds from which it is given in minutes.
_LEAST_SHARE, _LONG = 0.02, 100.0


class FileAction(Enum):
    """Action on a file; the value begins a message."""

    READING = "Reading"
    WRITING = "Writing"


@dataclass(frozen=True)
class FileProgress:
    """Progress of reading or writing one file.

    Parameters
    ----------
    path : Path
    action : FileAction
    share : float
        Share of the work that is done, 0 to 1; it never falls.
    seconds : float
        Time since the beginning.
    ended : bool
        True for the last report, also after an error.
    """

    path: Path
    action: FileAction
    share: float
    seconds: float
    ended: bool = False

    @property
    def seconds_left(self) -> float | None:
        """Estimated time to the end; None as long as too little is done for an estimate."""
        return None if self.share < _LEAST_SHARE else self.seconds * (1 - self.share) / self.share

    @property
    def phrase(self) -> str:
        """The share and the time left for a message.

        >>> FileProgress(Path("big.vtu"), FileAction.READING, 0.4, 2.0).phrase
        '40%, 3 s left'
        """
        left = self.seconds_left
        if left is None:
            return f"{self.share:.0%}"
        return f"{self.share:.0%}, " + (f"{ceil(left)} s left" if left < _LONG else f"{left / 60:.0f} min left")


#: Called with the progress of each file; an exception that it raises ends the reading or writing.
FileListener = Callable[[FileProgress], object]


class _Operation:
    """Reading or writing that is watched; reports refer to the part `begin` to `end` of its work."""

    def __init__(self, path: Path, action: FileAction, listener: FileListener):
        self.path, self.action, self.listener = path, action, listener
        self.begin, self.end, self.share, self.done = 0.0, 1.0, 0.0, 0.0
        self.started = self.reported = monotonic()

    def report(self, share: float) -> None:
        """Tell the listener what is done, unless it was told a moment ago."""
        self.share = max(self.share, min(self.begin + (self.end - self.begin) * share, 1.0))
        now = monotonic()
        if now - self.reported >= _INTERVAL:
            self.reported = now
            self.tell()

    def tell(self, ended: bool = False) -> None:
        self.listener(FileProgress(self.path, self.action, self.share, monotonic() - self.started, ended))


_LISTENER: ContextVar[FileListener | None] = ContextVar("file listener", default=None)
_OPERATION: ContextVar[_Operation | None] = ContextVar("file operation", default=None)


@contextmanager
def watch_files(listener: FileListener | None) -> Iterator[None]:
    """Context manager in which a listener is told the progress of all files that this thread reads and writes.

    Parameters
    ----------
    listener : callable or None
        Called with a `FileProgress` some times a second. An exception that it raises ends the reading or writing: an
        earlier file stays unchanged. None to watch no files, within the block of another listener.
    """
    token = _LISTENER.set(listener)
    try:
        yield
    finally:
        _LISTENER.reset(token)


@contextmanager
def file_operation(path: Path, action: FileAction) -> Iterator[None]:
    """Context manager around the reading or writing of a file; what is read within another one is a part of that.

    Parameters
    ----------
    path : Path
    action : FileAction
    """
    listener = _LISTENER.get()
    if listener is None or _OPERATION.get() is not None:
        yield
        return
    operation = _Operation(path, action, listener)
    token = _OPERATION.set(operation)
    try:
        operation.tell()
        yield
        operation.share = 1.0
    finally:
        _OPERATION.reset(token)
        operation.tell(ended=True)


@contextmanager
def stage(begin: float, end: float) -> Iterator[None]:
    """Context manager in which reports from 0 to 1 are those from `begin` to `end` of the work around it."""
    operation = _OPERATION.get()
    if operation is None:
        yield
        return
    first, last, done = operation.begin, operation.end, operation.done
    width = last - first
    operation.begin, operation.end, operation.done = first + begin * width, first + end * width, 0.0
    try:
        operation.report(0.0)
        yield
        operation.report(1.0)
    finally:
        operation.begin, operation.end, operation.done = first, last, done


def report(done: float, total: float = 1.0) -> None:
    """Report how much of the present stage is done; cheap enough for every few megabytes.

    Parameters
    ----------
    done, total : float
        In any unit, such as bytes.
    """
    operation = _OPERATION.get()
    if operation is not None:
        operation.report(done / total if total else 1.0)


def advance(size: float, total: float) -> None:
    """Report that so much more of the present stage is done, in any unit; see `report`."""
    operation = _OPERATION.get()
    if operation is not None:
        operation.done += size
        operation.report(operation.done / total if total else 1.0)
