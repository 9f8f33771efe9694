"""Request for a camera, which the 3D view applies as soon as it draws the open mesh."""

from __future__ import annotations

from dataclasses import dataclass

from PySide6.QtCore import QObject, Signal

from hexmend_app.picture import Camera
from hexmend_app.picture.camera_pose import CameraPose

#: Maximum number of poses in the history, including the current one.
MAX_POSES = 50


@dataclass(frozen=True)
class PoseHistoryData:
    """Earlier and later poses of the camera, for Back and Forward.

    Parameters
    ----------
    before, after : tuple of CameraPose
        Poses before and after the current one, oldest first.
    left : CameraPose or None
        The pose before hexes were isolated; None if none are.
    """

    before: tuple[CameraPose, ...] = ()
    after: tuple[CameraPose, ...] = ()
    left: CameraPose | None = None

    def __post_init__(self) -> None:
        if len(self.before) + len(self.after) >= MAX_POSES:
            raise ValueError(f"the camera has a history of more than {MAX_POSES} poses")


@dataclass(frozen=True)
class CameraData:
    """Data of the camera in a session file: its pose, if there is a view, and the history of poses."""

    pose: CameraPose | None = None
    history: PoseHistoryData = PoseHistoryData()


class CameraRequest(QObject):
    """Camera that the 3D view is to apply as soon as it draws the open mesh.

    Attributes
    ----------
    wanted : Camera or None
        The requested camera; None if there is no request.
    pose_history : PoseHistoryData
        The requested history of poses.

    Signals
    -------
    requested
    """

    requested = Signal()

    def __init__(self, parent: QObject | None = None):
        super().__init__(parent)
        self.wanted: Camera | None = None
        self.pose_history = PoseHistoryData()

    def request(self, camera: Camera | None, pose_history: PoseHistoryData | None = None) -> None:
        """Request a camera with a history of poses, by default an empty one."""
        self.wanted, self.pose_history = camera, pose_history or PoseHistoryData()
        self.requested.emit()
