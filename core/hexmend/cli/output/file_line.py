"""Line on a terminal with the progress of a file that takes more than a moment to read or write."""

from __future__ import annotations

import argparse
from collections.abc import Callable
from contextlib import suppress
from typing import TYPE_CHECKING

from hexmend.cli.output.progress_line import progress_line
from hexmend.io.storage.file_progress import FileProgress, watch_files
from hexmend.signal_guard import uninterrupted
from hexmend.terminal_text import printable

if TYPE_CHECKING:
    import rich.progress

#: Seconds after which the line is drawn.
DELAY = 1.0

#: Options that ask for output that is not for a person.
_SILENT = ("json", "quiet")


def with_file_line(run: Callable[[argparse.Namespace], int]) -> Callable[[argparse.Namespace], int]:
    """Return the function of a command with a line for each file that it reads or writes; none with --json.

    Parameters
    ----------
    run : callable
        Takes the arguments of the command, and returns the exit status.
    """

    def run_watched(args: argparse.Namespace) -> int:
        if any(getattr(args, option, None) for option in _SILENT):
            return run(args)
        with watch_files(FileLine().show):
            return run(args)

    return run_watched


class FileLine:
    """Line on standard error that is drawn after a second, and removed when the file is read or written."""

    def __init__(self):
        self._line: rich.progress.Progress | None = None
        self._failed = False

    @uninterrupted  # a line that is drawn in part could not be removed
    def show(self, progress: FileProgress) -> None:
        """Show the progress; a terminal that has gone is no error."""
        try:
            self._show(progress)
        except OSError:
            self._failed = True

    def _show(self, progress: FileProgress) -> None:
        if progress.ended:
            line, self._line = self._line, None
            if line is not None:
                with suppress(OSError):
                    line.stop()
            return
        if self._line is None:
            if self._failed or progress.seconds < DELAY:
                return
            self._line = progress_line("{task.description}", bar=True)
            self._line.start()
            self._task = self._line.add_task("", total=1.0)
        text = f"{progress.action.value} {printable(progress.path.name)}: {progress.phrase}"
        self._line.update(self._task, completed=progress.share, description=text)
