"""The menu of the cameras that are kept."""

from __future__ import annotations

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QMenu, QWidget

from hexmend_app.state.cameras import Cameras


class CamerasMenu(QMenu):
    """Offers the cameras that are kept by name.

    Parameters
    ----------
    cameras : Cameras

    Signals
    -------
    chosen(name)
    """

    chosen = Signal(str)

    def __init__(self, cameras: Cameras, parent: QWidget | None = None):
        super().__init__("Go to c&amera", parent)
        self._cameras = cameras
        self.aboutToShow.connect(self._fill)
        cameras.changed.connect(self._offer)
        self._offer()

    def _offer(self) -> None:
        self.menuAction().setEnabled(bool(self._cameras.all))

    def _fill(self) -> None:
        self.clear()
        for number, name in enumerate(self._cameras.all, start=1):
            letter = f"&{number % 10}  " if number <= 10 else "     "
            action = self.addAction(letter + name.replace("&", "&&"))
            action.setStatusTip(f"Look through the camera “{name}”.")
            action.triggered.connect(lambda _=False, name=name: self.chosen.emit(name))
