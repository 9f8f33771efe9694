"""Progress of `hexmend.smooth`: a bar on a terminal or in a notebook, or lines elsewhere."""

from __future__ import annotations

import shutil
import sys
from collections.abc import Callable
from contextlib import suppress
from html import escape
from importlib import import_module
from time import monotonic
from typing import Any, Protocol, TypeAlias

from hexmend.errors import ParameterError
from hexmend.iteration import Iteration
from hexmend.run.run import Run
from hexmend.terminal_text import in_notebook, is_dumb

#: Values of the argument `progress`: None shows a bar where somebody watches, True shows progress anywhere, False
#: nothing; a function is called with each iteration in place of a bar.
ProgressOption: TypeAlias = bool | Callable[[Iteration], Any] | None

#: Seconds after which a bar appears (a short run shows none), between its changes, and between lines.
BAR_DELAY, BAR_INTERVAL, LINE_INTERVAL = 0.4, 0.1, 4.0

_BAR_WIDTH = 20


class ProgressDisplay(Protocol):
    """Display of the progress of one run."""

    def show(self, run: Run) -> None:
        """Show the newest iteration of a run."""

    def close(self) -> None:
        """Remove what changes in place."""


class CallingDisplay:
    """Calls a function with each iteration; None for no display."""

    def __init__(self, function: Callable[[Iteration], Any] | None = None):
        self._function = function

    def show(self, run: Run) -> None:
        if self._function is not None:
            self._function(run.last)

    def close(self) -> None:
        pass


class TimedDisplay:
    """Writes a text after some seconds and then at intervals.

    Parameters
    ----------
    write : callable
        Writes the state of a run.
    erase : callable
        Removes what is written.
    delay, interval : float
        Seconds until the first text, and between two.
    """

    def __init__(self, write: Callable[[Run], None], erase: Callable[[], None], delay: float, interval: float):
        self._write, self._erase, self._interval = write, erase, interval
        self._due, self._written = monotonic() + delay, False

    def show(self, run: Run) -> None:
        if monotonic() < self._due:
            return
        with suppress(OSError, ValueError):  # the terminal has gone, or its stream is closed
            self._write(run)
            self._written = True
        self._due = monotonic() + self._interval

    def close(self) -> None:
        if self._written:
            with suppress(OSError, ValueError):
                self._erase()


def progress_display(option: ProgressOption) -> ProgressDisplay:
    """Make the display for a value of the argument `progress`; see `ProgressOption`.

    Raises
    ------
    ParameterError
        For another value.
    """
    if callable(option):
        return CallingDisplay(option)
    if option is not None and not isinstance(option, bool):
        raise ParameterError(f"progress = {option!r}: expected True, False, None, or a function of an iteration")
    if option is False:
        return CallingDisplay()
    if in_notebook():
        bar = _NotebookBar()
        return TimedDisplay(bar.write, bar.erase, BAR_DELAY, 2 * BAR_INTERVAL)
    if _is_terminal():
        return TimedDisplay(_write_bar, _erase_bar, BAR_DELAY, BAR_INTERVAL)
    if option:
        return TimedDisplay(_write_line, lambda: None, LINE_INTERVAL, LINE_INTERVAL)
    return CallingDisplay()


def current_method(run: Run) -> str:
    """Return the name of the method that is running, with its position if there are several."""
    place = f" ({run.stage_number} of {run.stage_count})" if run.stage_count > 1 else ""
    return f"{run.stage.smoother.name}{place}"


def describe_iteration(run: Run) -> str:
    """Return the quality and the largest move of the newest iteration as text."""
    at = run.last
    return f"{at.invalid:,} invalid, q min {at.q_min:.4f}, q mean {at.q_mean:.4f}, move {at.largest_move:.2g}"


def describe_run(run: Run) -> str:
    """Return the method, the number of the iteration and its quality as text."""
    count = f"iteration {run.last.number:,} of at most {run.max_iterations:,}"
    return f"{current_method(run)}: {count}, {run.last.seconds:.0f} s: {describe_iteration(run)}"


def _share(run: Run) -> float:
    """Return the share of the iteration limit that is used, from 0 to 1."""
    return min(1.0, run.last.number / max(run.max_iterations, 1))


def _is_terminal() -> bool:
    """Return True if standard error is a terminal on which a line can change in place."""
    isatty = getattr(sys.stderr, "isatty", None)  # a program without a console has no standard error
    return isatty is not None and bool(isatty()) and not is_dumb()


def _write_bar(run: Run) -> None:
    done = round(_BAR_WIDTH * _share(run))
    text = f"[{'#' * done}{'.' * (_BAR_WIDTH - done)}] {describe_run(run)}"
    width = shutil.get_terminal_size().columns - 1
    sys.stderr.write(f"\r{text[:width]:{width}}")
    sys.stderr.flush()


def _erase_bar() -> None:
    sys.stderr.write(f"\r{' ' * (shutil.get_terminal_size().columns - 1)}\r")
    sys.stderr.flush()


def _write_line(run: Run) -> None:
    sys.stderr.write(f"{describe_run(run)}\n")
    sys.stderr.flush()


class _NotebookBar:
    """Output of a cell that changes in place; no widgets are needed."""

    def __init__(self) -> None:
        self._handle: Any = None

    def write(self, run: Run) -> None:
        text = describe_run(run)
        bar = f'<progress max="1" value="{_share(run):.3f}" style="width: 12em"></progress>'
        self._update({"text/html": f"<div>{bar} {escape(text)}</div>", "text/plain": text})

    def erase(self) -> None:
        self._update({"text/html": "", "text/plain": ""})

    def _update(self, data: dict[str, str]) -> None:
        if self._handle is None:
            self._handle = import_module("IPython.display").display(data, raw=True, display_id=True)
        else:
            self._handle.update(data, raw=True)
