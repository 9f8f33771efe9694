"""Request for a camera, which the 3D view applies as soon as it draws the open mesh."""

from __future__ import annotations

from dataclasses import dataclass

from PySide6.QtCore import QObject, Signal

from hexmend_app.picture import Camera
from hexmend_app.picture.camera_pose import CameraPose


@dataclass(frozen=True)
class CameraData:
    """Data of the camera in a session file: its pose, if there is a view."""

    pose: CameraPose | None = None


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
