"""What no test leaves behind: threads, temporary files, windows. Each guard is a context that fails when it ends."""

import os
import shutil
import sys
import threading
import time
from collections.abc import Collection, Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest

#: Seconds that threads have for coming to their end, on machines that do other work besides.
GRACE = 20.0


def _runs(thread: threading.Thread) -> bool:
    """Whether a thread runs. Of one that Python has not started (a QThread's, say) only the system knows."""
    if isinstance(thread, threading._DummyThread) and sys.platform == "linux":  # noqa: SLF001
        return Path(f"/proc/self/task/{thread.native_id}").exists()
    return thread.is_alive()


@contextmanager
def threads_end() -> Iterator[None]:
    """Fail when a thread that was started within is still running."""
    before = set(threading.enumerate())
    yield
    end = time.monotonic() + GRACE
    while left := [thread for thread in threading.enumerate() if thread not in before and _runs(thread)]:
        if time.monotonic() > end:
            pytest.fail(f"threads are left running: {', '.join(thread.name for thread in left)}", pytrace=False)
        time.sleep(0.005)


@contextmanager
def temporary_files_go(folder: Path) -> Iterator[None]:
    """Fail when the folder of temporary files, which is found empty, is not left empty."""
    yield
    left = sorted(path.name for path in folder.iterdir())
    for name in left:  # the tests to come are judged by what they leave themselves
        path = folder / name
        shutil.rmtree(path) if path.is_dir() else os.unlink(path)
    if left:
        pytest.fail(f"temporary files are left: {', '.join(left)}", pytrace=False)


@contextmanager
def windows_close(staying: Collection = ()) -> Iterator[None]:
    """Fail when a window that was opened within, and is none of those that stay, is still on the screen."""
    from PySide6.QtCore import Qt
    from PySide6.QtWidgets import QApplication

    def shown() -> list:
        tips = Qt.WindowType.ToolTip, Qt.WindowType.SplashScreen
        return [one for one in QApplication.topLevelWidgets() if one.isVisible() and one.windowType() not in tips]

    before = shown()
    yield
    left = [one for one in shown() if one not in before and one not in staying]
    names = [f"{type(one).__name__} {one.windowTitle()!r}" for one in left]
    for one in left:
        one.hide()
    if left:
        pytest.fail(f"windows are left open: {', '.join(names)}", pytrace=False)
