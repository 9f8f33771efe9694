"""The program with a report of its start. Use: python -m benchmarks.window.start_report REPORT [MESH]."""

from __future__ import annotations

import json
import sys
import time
from pathlib import Path
from typing import Any

from PySide6.QtCore import QEvent, QObject
from PySide6.QtWidgets import QApplication

from hexmend_app.shell import window
from hexmend_app.shell.start import program
from hexmend_app.shell.window import Window

_DRAWING = (QEvent.Type.Expose, QEvent.Type.UpdateRequest, QEvent.Type.Paint)


class StartReport(QObject):
    """Writer of the times at which window, mesh and panels are first shown, with the modules loaded by then, to a file.

    Each line contains `moment` ("window", "picture" or "panels"), `at` (seconds of `time.monotonic`, which is the same
    in all processes) and `modules` (sorted names).

    Parameters
    ----------
    window : Window
        Its attribute `canvas`, None at first, has an `interactor`, and a `colouring` once it draws a mesh.
    path : Path
    """

    def __init__(self, window: Window, path: Path):
        super().__init__(window)
        self._window, self._path = window, path
        self._painted = self._delivering = False
        self._canvas: Any = None
        window.ready.connect(lambda: self._write("panels"))
        QApplication.instance().installEventFilter(self)

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Report the first painted frame of the window and of the 3D view."""
        kind = event.type()
        if self._painted:
            if kind == QEvent.Type.Paint and self._canvas is None and self._window.canvas is not None:
                self._canvas = self._window.canvas
                self._canvas.interactor.frameSwapped.connect(self._on_frame)
        elif kind == QEvent.Type.Paint and watched is self._window:
            self._painted = True
        elif kind in _DRAWING and watched is self._window.windowHandle() and not self._delivering:
            # The widgets are painted and shown on the screen before this returns.
            self._delivering = True
            watched.event(event)
            self._delivering = False
            if self._painted:
                self._write("window")
            return True
        return False

    def _on_frame(self) -> None:
        if self._canvas.colouring is not None:
            self._canvas.interactor.frameSwapped.disconnect(self._on_frame)
            QApplication.instance().removeEventFilter(self)
            self._write("picture")

    def _write(self, moment: str) -> None:
        event = {"moment": moment, "at": time.monotonic(), "modules": sorted(sys.modules)}
        with self._path.open("a", encoding="utf-8") as file:
            file.write(json.dumps(event) + "\n")


class ReportedWindow(Window):
    """Window of the program whose start is reported to the first argument of this process."""

    def __init__(self) -> None:
        super().__init__()
        StartReport(self, Path(sys.argv[1]))


if __name__ == "__main__":
    window.Window = ReportedWindow  # type: ignore[misc]  # which the program imports when it opens a window
    sys.exit(program.open_window(*sys.argv[2:]))
