"""Progress of `hexmend.smooth`: a bar on a terminal or in a notebook, or lines elsewhere."""

from __future__ import annotations

import shutil
import sys
from collections.abc import Callable
from contextlib import suppress
from html import escape
from importlib import import_module
from time import monotonic
from typing import Any, Generic, Protocol, TypeVar

from hexmend.errors import ParameterError
from hexmend.run.run import Run
from hexmend.terminal_text import in_notebook, redraws_lines

T = TypeVar("T", contravariant=True)

#: Seconds after which a bar appears (a short run shows none), between its changes, and between lines.
BAR_DELAY, BAR_INTERVAL, LINE_INTERVAL = 0.4, 0.1, 4.0

_BAR_WIDTH = 20

#: Codes that empty the line of a terminal.
_CLEAR = "\r\x1b[2K"


class ProgressDisplay(Protocol[T]):
    """Display of the progress of one run, or of other work."""

    def show(self, state: T) -> None:
        """Show the newest state, such as a run after an iteration."""

    def close(self) -> None:
        """Remove what changes in place."""


class NoDisplay:
    """Display that shows nothing."""

    def show(self, state: Any) -> None:
        pass

    def close(self) -> None:
        pass


class TimedDisplay(Generic[T]):
    """Writes a text after some seconds and then at intervals.

    Parameters
    ----------
    write : callable
        Writes a state.
    erase : callable
        Removes what is written.
    delay, interval : float
        Seconds until the first text, and between two.
    """

    def __init__(self, write: Callable[[T], None], erase: Callable[[], None], delay: float, interval: float):
        self._write, self._erase, self._interval = write, erase, interval
        self._due, self._written = monotonic() + delay, False

    def show(self, state: T) -> None:
        if monotonic() < self._due:
            return
        self._written = True  # before it is written: a signal may come in the middle
        with suppress(OSError, ValueError):  # the terminal has gone, or its stream is closed
            self._write(state)
        self._due = monotonic() + self._interval

    def close(self) -> None:
        if self._written:
            with suppress(OSError, ValueError):
                self._erase()


def progress_display(option: bool | None) -> ProgressDisplay[Run]:
    """Make the display for a value of the argument `progress`.

    Parameters
    ----------
    option : bool or None
        None shows a bar where somebody watches, True shows progress anywhere, False nothing.

    Raises
    ------
    ParameterError
        For another value.
    """
    if option is not None and not isinstance(option, bool):
        raise ParameterError(f"progress = {option!r}: expected True, False or None")
    notebook = in_notebook()
    watched = notebook or (sys.stderr is not None and sys.stderr.isatty())
    if option is False or (option is None and not watched):
        return NoDisplay()
    if notebook:
        bar = _NotebookBar()
        return TimedDisplay(bar.write, bar.erase, BAR_DELAY, 2 * BAR_INTERVAL)
    return line_display(describe_run, _share, always=bool(option))


def line_display(
    text: Callable[[T], str], share: Callable[[T], float], *, delay: float | None = None, always: bool = False
) -> ProgressDisplay[T]:
    """Make a line on standard error that changes in place and vanishes at the end.

    Parameters
    ----------
    text, share : callable
        Text of a state, and the share of the work that is done, from 0 to 1.
    delay : float, optional
        Seconds until the line appears; `BAR_DELAY` by default.
    always : bool
        Where no line can change in place, print the text every few seconds; else nothing is shown there.
    """

    def write_bar(state: T) -> None:
        done = round(_BAR_WIDTH * share(state))
        line = f"[{'#' * done}{'.' * (_BAR_WIDTH - done)}] {text(state)}"
        _write(f"{_CLEAR}{line[: shutil.get_terminal_size().columns - 1]}")

    if redraws_lines():
        return TimedDisplay(write_bar, lambda: _write(_CLEAR), BAR_DELAY if delay is None else delay, BAR_INTERVAL)
    if always:
        return TimedDisplay(
            lambda state: _write(f"{text(state)}\n"), lambda: None, delay=LINE_INTERVAL, interval=LINE_INTERVAL
        )
    return NoDisplay()


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


def _write(text: str) -> None:
    sys.stderr.write(text)
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
