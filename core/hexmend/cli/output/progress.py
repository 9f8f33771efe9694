"""Progress of a run on standard error: a live line on a terminal, else a plain line every few seconds."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterable, Iterator
from contextlib import suppress
from time import monotonic
from types import TracebackType
from typing import TYPE_CHECKING, Self, TypeVar

from hexmend.cli.output.progress_line import progress_line
from hexmend.cli.process.interrupts import ExitAfterIteration
from hexmend.cli.process.terminal import redraws_lines
from hexmend.io.storage.file_progress import watch_files
from hexmend.run.progress import BAR_DELAY, LINE_INTERVAL, current_method, describe_iteration, describe_run
from hexmend.signal_guard import uninterrupted

if TYPE_CHECKING:
    from hexmend.iteration import Iteration
    from hexmend.run import Run

_Item = TypeVar("_Item")


class Progress:
    """Shows runs, one after another, while the block lasts; the first signal within it only asks them to end.

    `show` is a `Watch`: call it with the run after each of its iterations.

    Attributes
    ----------
    signals : ExitAfterIteration
        The signal that came, if any, and its exit status.
    """

    def __enter__(self) -> Self:
        self._display: _Live | _Lines | None = _Live() if redraws_lines() else _Lines()
        self._unwatched = watch_files(None)  # a file that is written meanwhile, such as a checkpoint, has no line
        self._unwatched.__enter__()
        self.signals = ExitAfterIteration()
        self.signals.__enter__()
        return self

    def __exit__(self, kind: type | None, error: BaseException | None, trace: TracebackType | None) -> None:
        self.signals.__exit__(kind, error, trace)
        self._unwatched.__exit__(None, None, None)
        if self._display is not None:
            with suppress(OSError):
                self._display.close()

    def show(self, run: Run) -> bool:
        """Show the run's newest iteration; return False once a signal has asked it to end."""
        if self._display is not None:
            try:
                self._display.show(run)
            except OSError:  # the terminal has gone, and the run has not
                self._display = None
        return not self.signals.asked


def follow(run: Run, watch: Callable[[Iteration], object] = lambda iteration: None) -> None:
    """Iterate a run to its end and show its progress; a signal ends it with what was reached so far.

    Parameters
    ----------
    run : Run
    watch : callable
        Called with every iteration.

    Raises
    ------
    KeyboardInterrupt
        If it is interrupted before its first iteration.
    """
    interrupted = False
    with Progress() as progress:
        try:
            for iteration in run:
                watch(iteration)
                if not progress.show(run):
                    break
        except KeyboardInterrupt:
            if not run.last.number:
                raise
            interrupted = True
    if (interrupted or progress.signals.asked) and run.outcome is None:
        run.close()
        with suppress(OSError):
            print("Interrupted: the result so far is kept.", file=sys.stderr)


class _Live:
    """A line that changes in place and is removed at the end."""

    def __init__(self):
        self._due = monotonic() + BAR_DELAY
        self._line = self._run = self._task = None

    @uninterrupted  # a line that is drawn in part could not be removed
    def show(self, run: Run) -> None:
        if self._line is None:
            if monotonic() < self._due:
                return
            self._line = progress_line("{task.fields[method]} {task.completed:,} of {task.total:,}: {task.description}")
            self._line.start()
        if run is not self._run:
            if self._task is not None:
                self._line.remove_task(self._task)
            self._run = run
            self._task = self._line.add_task("", total=run.max_iterations, method="")
        words = {"method": current_method(run), "description": describe_iteration(run)}
        self._line.update(self._task, total=run.max_iterations, completed=run.last.number, **words)

    def close(self) -> None:
        if self._line is not None:
            self._line.stop()


def show_count(items: Iterable[_Item], total: int, text: str) -> Iterator[_Item]:
    """Yield items, and show on a terminal how many of them are done, from `BAR_DELAY` on.

    Parameters
    ----------
    items : iterable
    total : int
        Number of items.
    text : str
        Description, such as "drawing frames".
    """
    if not redraws_lines():
        yield from items
        return
    due, line = monotonic() + BAR_DELAY, None
    try:
        for number, item in enumerate(items, 1):
            if line is None and monotonic() >= due:
                line = progress_line("{task.description}: {task.completed:,} of {task.total:,}", bar=True)
                task = line.add_task(text, total=total)
                line.start()
            if line is not None:
                line.update(task, completed=number)
            yield item
    finally:
        if line is not None:
            line.stop()


class _Lines:
    """Plain lines for a log."""

    def __init__(self):
        self._due: float | None = None

    def show(self, run: Run) -> None:
        if self._due is None:  # the interval begins after the preparations for the first iteration
            self._due = monotonic() + LINE_INTERVAL
        if monotonic() >= self._due:
            print(describe_run(run), file=sys.stderr, flush=True)
            self._due = monotonic() + LINE_INTERVAL

    def close(self) -> None:
        pass
