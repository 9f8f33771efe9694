"""Camera pose as a value that outlives the 3D view."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from PySide6.QtCore import QObject, Signal

from hexmend_app.picture import Camera
from hexmend_app.picture.camera_pose import CameraPose

#: Places that the camera can go back or forward to, with the one where it stands.
MOST = 50


@dataclass(frozen=True)
class PoseHistoryData:
    """Earlier and later poses of the camera, for Back and Forward.

    Parameters
    ----------
    before, after : tuple of Stand
        What there is to go back to, and forward to; the oldest first.
    left : Stand or None
        Where it stood before something was isolated that still is.
    """

    before: tuple[CameraPose, ...] = ()
    after: tuple[CameraPose, ...] = ()
    left: CameraPose | None = None

    def __post_init__(self) -> None:
        if len(self.before) + len(self.after) >= MOST:
            raise ValueError(f"the camera has stood in more than {MOST} places")


class CameraRequest(QObject):
    """Knows where the camera stands, and where it is to stand.

    Attributes
    ----------
    now : callable
        Gives where the camera stands, a Stand, or None where there is no view; who has the camera sets it.
    travelled : callable
        Gives its Journey; who has the camera sets it.
    wanted : Camera or None
        From where it is to look as soon as there is a view of the open mesh.
    journey : Journey
        What is to lie behind it then, and before it.

    Signals
    -------
    called
        It is to stand elsewhere.
    """

    called = Signal()

    def __init__(self, parent: QObject | None = None):
        super().__init__(parent)
        self.now: Callable[[], CameraPose | None] = lambda: None
        self.travelled: Callable[[], PoseHistoryData] = PoseHistoryData
        self.wanted: Camera | None = None
        self.journey = PoseHistoryData()

    def to_data(self) -> CameraPose | None:
        """Return the data for a session file."""
        return (self.wanted and self.wanted.pose) or self.now()

    def restore(self, stand: CameraPose | None, journey: PoseHistoryData) -> None:
        """Have the camera stand where a session has kept it, with the way that it has come."""
        self.look_through(None if stand is None else Camera.at(stand), journey)

    def look_through(self, camera: Camera | None, journey: PoseHistoryData | None = None) -> None:
        """Have the mesh looked at as a scene has it, with no way behind it where none is given."""
        self.wanted, self.journey = camera, journey or PoseHistoryData()
        self.called.emit()
