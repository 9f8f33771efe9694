"""Where a run is, on standard error: a live line on a terminal, else a plain line every few seconds."""

from __future__ import annotations

import sys
from collections.abc import Callable
from contextlib import suppress
from time import monotonic
from types import TracebackType
from typing import TYPE_CHECKING, Self

from hexmend.cli.process.interrupts import EndsAfterIteration
from hexmend.cli.process.terminal import redraws_lines
from hexmend.signal_guard import uninterrupted

if TYPE_CHECKING:
    import rich.progress

    from hexmend.iteration import Iteration
    from hexmend.run import Run

#: Seconds between plain lines, and of iterations before the first of them: a short run says nothing.
EVERY = 4.0

#: Seconds after which a line is drawn on a terminal: what draws it takes time to load.
AFTER = 0.4


class Progress:
    """Shows runs, one after another, while the block lasts; the first signal within it only asks them to end.

    `show` is a `Watch`: call it with the run after each of its iterations.

    Attributes
    ----------
    signals : EndsAfterIteration
        Has a signal come, and which exit status does it stand for?
    """

    def __enter__(self) -> Self:
        self._display: _Live | _Lines | None = _Live() if redraws_lines() else _Lines()
        self.signals = EndsAfterIteration()
        self.signals.__enter__()
        return self

    def __exit__(self, kind: type | None, error: BaseException | None, trace: TracebackType | None) -> None:
        self.signals.__exit__(kind, error, trace)
        if self._display is not None:
            with suppress(OSError):
                self._display.close()

    def show(self, run: Run) -> bool:
        """Show where the run is; return False once a signal has asked it to end."""
        if self._display is not None:
            try:
                self._display.show(run)
            except OSError:  # the terminal has gone, and the run has not
                self._display = None
        return not self.signals.asked


def follow(run: Run, watch: Callable[[Iteration], object] = lambda iteration: None) -> None:
    """Go through a run to its end and show where it is; a signal ends it with what was reached so far.

    Parameters
    ----------
    run : Run
    watch : callable
        Called with every iteration.

    Raises
    ------
    KeyboardInterrupt
        Where it is interrupted before its first iteration.
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
            print("Interrupted: what was reached so far is kept.", file=sys.stderr)


def at_work(run: Run) -> str:
    """The name of the method at work, with its place where there are several."""
    place = f" ({run.stage_number} of {run.stage_count})" if run.stage_count > 1 else ""
    return f"{run.stage.smoother.name}{place}"


def described(run: Run) -> str:
    """The newest iteration in words."""
    at = run.last
    return (
        f"{at.figures.n_inverted:,} inverted, q min {at.figures.q.min():.4f}, q mean {at.figures.q.mean():.4f}, "
        f"move {at.largest_move:.2g}"
    )


class _Live:
    """A line that changes in place, and vanishes at the end."""

    def __init__(self):
        self._due = monotonic() + AFTER
        self._line = None
        self._run: Run | None = None
        self._task = None

    @uninterrupted  # a line that is drawn by halves could not be removed
    def show(self, run: Run) -> None:
        if self._line is None:
            if monotonic() < self._due:
                return
            self._line = drawn_line("{task.fields[method]} {task.completed:,} of {task.total:,}: {task.description}")
            self._line.start()
        if run is not self._run:
            if self._task is not None:
                self._line.remove_task(self._task)
            self._run = run
            self._task = self._line.add_task("", total=run.limit, method="")
        self._line.update(
            self._task, total=run.limit, completed=run.last.number, method=at_work(run), description=described(run)
        )

    def close(self) -> None:
        if self._line is not None:
            self._line.stop()


def drawn_line(words: str) -> rich.progress.Progress:
    """A line that turns and tells the time, with these words of a task of rich's; it vanishes when it is stopped."""
    from rich.console import Console
    from rich.progress import Progress, SpinnerColumn, TextColumn, TimeElapsedColumn
    from rich.table import Column

    return Progress(
        SpinnerColumn(table_column=Column(no_wrap=True)),
        TimeElapsedColumn(table_column=Column(no_wrap=True)),
        TextColumn(
            words,
            markup=False,
            table_column=Column(no_wrap=True, ratio=1),  # what gives way where the terminal is narrow
        ),
        console=Console(stderr=True, highlight=False),
        expand=True,
        transient=True,
        redirect_stdout=sys.stdout.isatty(),  # else what is printed meanwhile would go the line's way
    )


class _Lines:
    """For a log: few lines, each complete in itself."""

    def __init__(self):
        self._due: float | None = None

    def show(self, run: Run) -> None:
        if self._due is None:  # preparing, before the first iteration, does not count
            self._due = monotonic() + EVERY
        if monotonic() >= self._due:
            at = f"iteration {run.last.number:,} of at most {run.limit:,}, {run.last.seconds:.0f} s"
            print(f"{at_work(run)}: {at}: {described(run)}", file=sys.stderr, flush=True)
            self._due = monotonic() + EVERY

    def close(self) -> None:
        pass
