"""Menu of saved cameras."""

from __future__ import annotations

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QMenu, QWidget

from hexmend_app.state.view.saved_cameras import SavedCameras
from hexmend_app.translation import tr


class CamerasMenu(QMenu):
    """Menu that applies a saved camera.

    Parameters
    ----------
    cameras : SavedCameras

    Signals
    -------
    chosen(name)
        The user selected a camera.
    """

    chosen = Signal(str)

    def __init__(self, cameras: SavedCameras, parent: QWidget | None = None):
        super().__init__(tr("Go to c&amera"), parent)
        self._cameras = cameras
        self.aboutToShow.connect(self._fill)
        cameras.changed.connect(self._enable)
        self._enable()

    def _enable(self) -> None:
        self.menuAction().setEnabled(bool(self._cameras.all))

    def _fill(self) -> None:
        self.clear()
        for number, name in enumerate(self._cameras.all, start=1):
            mnemonic = f"&{number % 10}  " if number <= 10 else "     "
            action = self.addAction(mnemonic + name.replace("&", "&&"))
            action.setStatusTip(tr("Apply the camera “{name}”.", name=name))
            action.triggered.connect(lambda _=False, name=name: self.chosen.emit(name))
