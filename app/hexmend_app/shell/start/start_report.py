"""Report of start-up times, written to the file named by an environment variable."""

from __future__ import annotations

import json
import os
import sys
import time
from pathlib import Path
from typing import TYPE_CHECKING, Any

from PySide6.QtCore import QEvent, QObject
from PySide6.QtWidgets import QApplication

if TYPE_CHECKING:
    from hexmend_app.shell.window import Window

#: Environment variable with the path of the file to append to, one line of JSON per event.
VARIABLE = "HEXMEND_REPORT_START"

_DRAWING = (QEvent.Type.Expose, QEvent.Type.UpdateRequest, QEvent.Type.Paint)


class StartReport(QObject):
    """Writer of the times at which window, mesh and panels are first shown, with the modules loaded by then.

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


def report_start(window: Window) -> None:
    """Report start-up times if the environment variable is set."""
    if path := os.environ.get(VARIABLE):
        StartReport(window, Path(path))
