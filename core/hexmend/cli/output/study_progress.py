"""Progress of a study on standard error: a live line on a terminal, else a plain line every few seconds."""

from __future__ import annotations

import sys
from contextlib import suppress
from time import monotonic
from types import TracebackType
from typing import TYPE_CHECKING, Self

from hexmend.cli.output.progress import LINE_INTERVAL
from hexmend.cli.output.progress_line import progress_line
from hexmend.cli.process.terminal import redraws_lines

if TYPE_CHECKING:
    from hexmend.study.batch.runner import StudyProgress


class TaskProgress:
    """Shows the count of tasks while the block lasts."""

    def __enter__(self) -> Self:
        self._line = None
        self._due = monotonic() + LINE_INTERVAL
        if redraws_lines():
            self._line = progress_line("{task.description}")
            self._line.start()
            self._task = self._line.add_task("", total=None)
        return self

    def __exit__(self, kind: type | None, error: BaseException | None, trace: TracebackType | None) -> None:
        if self._line is not None:
            with suppress(OSError):  # the terminal may have gone
                self._line.stop()

    def show(self, count: StudyProgress) -> None:
        """Show the numbers of tasks that are done and that failed, and the latest task."""
        text = f"{count.reused + count.done:,} of {count.tasks:,} tasks"
        if count.failed:
            text += f", {count.failed:,} without a result"
        if count.last:
            text += f": {count.last}"
        if self._line is not None:
            self._line.update(self._task, description=text)
        elif monotonic() >= self._due:
            with suppress(OSError):
                print(text, file=sys.stderr, flush=True)
            self._due = monotonic() + LINE_INTERVAL
