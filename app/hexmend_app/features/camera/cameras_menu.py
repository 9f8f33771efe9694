"""Menu of saved cameras."""

from __future__ import annotations

from PySide6.QtCore import Signal, SignalInstance
from PySide6.QtWidgets import QMenu, QWidget

from hexmend_app.state.view.saved_cameras import SavedCameras
from hexmend_app.translation import tr


class CamerasMenu(QMenu):
    """Menu that applies and deletes saved cameras.

    Parameters
    ----------
    cameras : SavedCameras

    Signals
    -------
    chosen(name), delete_requested(name)
        The user selected a camera to apply or delete.
    """

    chosen = Signal(str)
    delete_requested = Signal(str)

    def __init__(self, cameras: SavedCameras, parent: QWidget | None = None):
        super().__init__(tr("Saved c&ameras"), parent)
        self._cameras = cameras
        self.aboutToShow.connect(self._fill)
        cameras.changed.connect(self._enable)
        self._enable()

    def _enable(self) -> None:
        self.menuAction().setEnabled(bool(self._cameras.all))

    def _fill(self) -> None:
        self.clear()
        self._add_names(self, self.chosen, tr("Apply the camera “{name}”."))
        self.addSeparator()
        self._add_names(self.addMenu(tr("&Delete")), self.delete_requested, tr("Delete the camera “{name}”."))

    def _add_names(self, menu: QMenu, chosen: SignalInstance, help: str) -> None:
        for number, name in enumerate(self._cameras.all, start=1):
            mnemonic = f"&{number % 10}  " if number <= 10 else "     "
            action = menu.addAction(mnemonic + name.replace("&", "&&"))
            action.setStatusTip(help.replace("{name}", name))
            action.triggered.connect(lambda _=False, name=name: chosen.emit(name))
