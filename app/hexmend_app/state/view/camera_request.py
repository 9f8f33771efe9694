"""Camera pose as a value that outlives the 3D view."""

from __future__ import annotations

from dataclasses import dataclass

from PySide6.QtCore import QObject, Signal

from hexmend_app.picture import Camera
from hexmend_app.picture.camera_pose import CameraPose

#: Poses in the history at most, the present one included.
MOST = 50


@dataclass(frozen=True)
class PoseHistoryData:
    """Earlier and later poses of the camera, for Back and Forward.

    Parameters
    ----------
    before, after : tuple of CameraPose
        The poses to go back to and forward to, the oldest first.
    left : CameraPose or None
        The pose before hexes were isolated; None while none are.
    """

    before: tuple[CameraPose, ...] = ()
    after: tuple[CameraPose, ...] = ()
    left: CameraPose | None = None

    def __post_init__(self) -> None:
        if len(self.before) + len(self.after) >= MOST:
            raise ValueError(f"the camera has stood in more than {MOST} places")


@dataclass(frozen=True)
class CameraData:
    """Data of the camera in a session file: its pose, if there is a view, and its earlier and later poses."""

    pose: CameraPose | None = None
    history: PoseHistoryData = PoseHistoryData()


class CameraRequest(QObject):
    """The camera through which the 3D view is to show the mesh, as soon as it can.

    Attributes
    ----------
    wanted : Camera or None
        The camera that the view is to take once it draws the open mesh.
    journey : PoseHistoryData
        The history of poses that the view is to take with it.

    Signals
    -------
    called
        Another camera is wanted.
    """

    called = Signal()

    def __init__(self, parent: QObject | None = None):
        super().__init__(parent)
        self.wanted: Camera | None = None
        self.journey = PoseHistoryData()

    def look_through(self, camera: Camera | None, journey: PoseHistoryData | None = None) -> None:
        """Request a camera, with a history of poses; by default an empty one."""
        self.wanted, self.journey = camera, journey or PoseHistoryData()
        self.called.emit()
