"""Animated camera movements and the history of views."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from PySide6.QtCore import QElapsedTimer, QObject, QTimer, Signal
from vtkmodules.vtkRenderingCore import vtkCamera

from hexmend_app.picture.camera_pose import CameraPose
from hexmend_app.scene.camera.flight import Flight
from hexmend_app.scene.camera.pose_history import PoseHistory
from hexmend_app.scene.camera.vtk_pose import pose_of

#: Milliseconds that the camera flies, and between two of its frames.
_FLIGHT, _FRAME = 350, 25

#: Milliseconds without a movement after which the camera has come to rest.
_REST = 300


class CameraAnimation(QObject):
    """Animates the camera, and records the poses in which it came to rest.

    Whatever moves the camera says so: `leave` before, `arrive` after.

    Parameters
    ----------
    camera : vtkCamera

    Signals
    -------
    moved
        The camera is a little further on a flight.
    changed
        The history has changed.
    """

    moved = Signal()
    changed = Signal()

    def __init__(self, camera: vtkCamera, parent: QObject | None = None):
        super().__init__(parent)
        self._camera = camera
        self._poses = PoseHistory()
        self._remembered: CameraPose | None = None
        self._flight: Flight | None = None
        self._flown = QElapsedTimer()
        self._timer = QTimer(self, interval=_FRAME)
        self._timer.timeout.connect(self._continue)
        self._settling = QTimer(self, interval=_REST, singleShot=True)
        self._settling.timeout.connect(self._commit)

    # Flights

    @property
    def active(self) -> bool:
        """True while the camera moves to another pose."""
        return self._timer.isActive()

    @property
    def at_rest(self) -> bool:
        """True while no camera movement is running or has just ended."""
        return not (self.active or self._settling.isActive())

    def fly(self, flight: Flight) -> None:
        """Start a camera movement; a running one ends at its present pose."""
        self.leave()
        self._set_out(flight)

    def _set_out(self, flight: Flight) -> None:
        self._settling.stop()
        self._flight = flight
        self._flown.start()
        self._timer.start()

    def _continue(self) -> None:
        share = min(self._flown.elapsed() / _FLIGHT, 1.0)
        self._flight.at(share)
        if share == 1.0:
            self._timer.stop()
            self._commit()
        self.moved.emit()

    # Comings and goings

    def leave(self) -> None:
        """Prepare for a movement by the user: record the present pose, and end a running movement."""
        if self.at_rest:
            self._commit()
        self._timer.stop()

    def arrive(self) -> None:
        """Take note of a movement by the user; the camera may come to rest."""
        if not self.active:
            self._settling.start()

    def stop(self) -> None:
        """Stop moving and recording."""
        self._timer.stop()
        self._settling.stop()

    def begin_anew(self) -> None:
        """Clear the history: its views show another mesh."""
        self.stop()
        self._poses.clear()
        self._remembered = None
        self.arrive()
        self.changed.emit()

    def journey(self) -> tuple[list[CameraPose], list[CameraPose], CameraPose | None]:
        """The poses before and after the present one, oldest first, and the bookmarked pose."""
        before, after = self._poses.around(pose_of(self._camera))
        return before, after, self._remembered

    def resume(self, before: Sequence[CameraPose], after: Sequence[CameraPose], remembered: CameraPose | None) -> None:
        """Continue at the present pose with a restored history."""
        self.stop()
        self._poses.restore(before, pose_of(self._camera), after)
        self._remembered = remembered
        self.changed.emit()

    def _commit(self) -> None:
        self._settling.stop()
        if self._poses.add(pose_of(self._camera)):
            self.changed.emit()

    # Back and forward

    @property
    def can_go_back(self) -> bool:
        """True if there is a previous view."""
        return self._poses.can_go_back

    @property
    def can_go_forward(self) -> bool:
        """True if there is a next view."""
        return self._poses.can_go_forward

    def go_back(self) -> None:
        """Move to the previous view, if there is one."""
        self._go(self._poses.back)

    def go_forward(self) -> None:
        """Move to the next view, if there is one."""
        self._go(self._poses.forward)

    def _go(self, step: Callable[[], CameraPose | None]) -> None:
        if not self.active:
            self._commit()  # where the camera has just been led, it has not rested yet
        pose = step()
        if pose is not None:
            self._set_out(Flight(self._camera, pose))
            self.changed.emit()

    # The pose before an excursion

    def remember(self) -> None:
        """Bookmark the present pose, unless another one is bookmarked."""
        if self._remembered is None:
            self._remembered = self._flight.goal if self.active else pose_of(self._camera)

    def come_back(self) -> None:
        """Move to the bookmarked pose, if there is one, and clear it."""
        pose, self._remembered = self._remembered, None
        if pose is not None:
            self.fly(Flight(self._camera, pose))
