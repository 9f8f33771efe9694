"""Report on the time of a start, written if an environment variable asks for it."""

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

#: Names the file that a report is appended to, a line of JSON for each moment.
VARIABLE = "HEXMEND_REPORT_START"

_DRAWING = (QEvent.Type.Expose, QEvent.Type.UpdateRequest, QEvent.Type.Paint)


class StartReport(QObject):
    """Writes the times of the first window, mesh and panels, with the modules loaded by then.

    Each line holds `moment` ("window", "picture" or "panels"), `at`, seconds of `time.monotonic`, which other processes
    share, and `modules`, sorted names.

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
        window.ready.connect(lambda: self._tell("panels"))
        QApplication.instance().installEventFilter(self)

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Distinguish painted events from requested ones."""
        kind = event.type()
        if self._painted:
            if kind == QEvent.Type.Paint and self._canvas is None and self._window.canvas is not None:
                self._canvas = self._window.canvas
                self._canvas.interactor.frameSwapped.connect(self._on_frame)
        elif kind == QEvent.Type.Paint and watched is self._window:
            self._painted = True
        elif kind in _DRAWING and watched is self._window.windowHandle() and not self._delivering:
            # Its widgets are painted and put on the screen before this returns.
            self._delivering = True
            watched.event(event)
            self._delivering = False
            if self._painted:
                self._tell("window")
            return True
        return False

    def _on_frame(self) -> None:
        if self._canvas.colouring is not None:
            self._canvas.interactor.frameSwapped.disconnect(self._on_frame)
            QApplication.instance().removeEventFilter(self)
            self._tell("picture")

    def _tell(self, moment: str) -> None:
        text = {"moment": moment, "at": time.monotonic(), "modules": sorted(sys.modules)}
        with self._path.open("a", encoding="utf-8") as file:
            file.write(json.dumps(text) + "\n")


def report_start(window: Window) -> None:
    """Report on the start if the variable is set."""
    if path := os.environ.get(VARIABLE):
        StartReport(window, Path(path))
