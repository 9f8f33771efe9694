"""Request for a camera, which the 3D view applies as soon as it draws the open mesh."""

from __future__ import annotations

from PySide6.QtCore import QObject, Signal

from hexmend_app.picture import Camera


class CameraRequest(QObject):
    """Camera that the 3D view is to apply as soon as it draws the open mesh.

    Attributes
    ----------
    wanted : Camera or None
        The requested camera; None if there is no request.

    Signals
    -------
    requested
    """

    requested = Signal()

    def __init__(self, parent: QObject | None = None):
        super().__init__(parent)
        self.wanted: Camera | None = None

    def request(self, camera: Camera | None) -> None:
        """Request a camera."""
        self.wanted = camera
        self.requested.emit()
