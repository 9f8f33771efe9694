"""Progress of a run on standard error: a live line on a terminal, else a plain line every few seconds."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterable, Iterator
from contextlib import ExitStack, suppress
from typing import Any, Self, TypeVar

from hexmend.cli.process.interrupts import ExitAfterIteration
from hexmend.io.storage.file_progress import watch_files
from hexmend.iteration import Iteration
from hexmend.run import Run
from hexmend.run.progress import line_display, progress_display

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
        self._display, self._within = progress_display(True), ExitStack()
        self._within.callback(self._display.close)
        self._within.enter_context(watch_files(None))  # a file that is written meanwhile, as a checkpoint, has no line
        self.signals = self._within.enter_context(ExitAfterIteration())
        return self

    def __exit__(self, *error: Any) -> None:
        self._within.__exit__(*error)

    def show(self, run: Run) -> bool:
        """Show the run's newest iteration; return False once a signal has asked it to end."""
        self._display.show(run)
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


def show_count(items: Iterable[_Item], total: int, text: str) -> Iterator[_Item]:
    """Yield items, and show on a terminal how many of them are done.

    Parameters
    ----------
    items : iterable
    total : int
        Number of items.
    text : str
        Description, such as "drawing frames".
    """
    display = line_display(lambda number: f"{text}: {number:,} of {total:,}", lambda number: number / total)
    try:
        for number, item in enumerate(items, 1):
            display.show(number)
            yield item
    finally:
        display.close()
