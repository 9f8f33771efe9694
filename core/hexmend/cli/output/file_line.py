"""Line on a terminal with the progress of a file that takes more than a moment to read or write."""

from __future__ import annotations

import argparse
from collections.abc import Callable
from operator import attrgetter

from hexmend.io.storage.file_progress import FileProgress, watch_files
from hexmend.run.progress import ProgressDisplay, line_display
from hexmend.terminal_text import printable

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

    def __init__(self) -> None:
        self._display: ProgressDisplay[FileProgress] | None = None

    def show(self, progress: FileProgress) -> None:
        """Show the progress; a terminal that has gone is no error."""
        if self._display is None:
            self._display = line_display(_describe, attrgetter("share"), delay=DELAY)
        if progress.ended:
            self._display.close()
            self._display = None
        else:
            self._display.show(progress)


def _describe(progress: FileProgress) -> str:
    return f"{progress.action.value} {printable(progress.path.name)}: {progress.phrase}"
