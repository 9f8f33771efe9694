"""Animated camera movements, and the history of camera poses."""

from __future__ import annotations

from collections.abc import Callable

from PySide6.QtCore import QObject, QTimer, QVariantAnimation, Signal
from vtkmodules.vtkRenderingCore import vtkCamera

from hexmend_app.picture.camera import CameraPose
from hexmend_app.scene.camera.flight import Flight
from hexmend_app.scene.camera.pose_history import PoseHistory
from hexmend_app.scene.camera.vtk_pose import pose_of

#: Duration of a flight in milliseconds.
_FLIGHT = 350

#: Time without movement after which the camera is at rest, in milliseconds.
_REST = 300


class CameraAnimation(QObject):
    """Animates the camera, and records the poses in which it came to rest.

    Code that moves the camera must call `begin_move` before and `end_move` after the movement.

    Parameters
    ----------
    camera : vtkCamera

    Signals
    -------
    moved
        The camera was moved during a flight.
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
        self._animation = QVariantAnimation(self, duration=_FLIGHT, startValue=0.0, endValue=1.0)
        self._animation.valueChanged.connect(self._continue)
        self._animation.finished.connect(self._commit)
        self._rest_timer = QTimer(self, interval=_REST, singleShot=True)
        self._rest_timer.timeout.connect(self._commit)

    # Flights

    @property
    def active(self) -> bool:
        """True during a flight."""
        return self._animation.state() is QVariantAnimation.State.Running

    @property
    def at_rest(self) -> bool:
        """True unless the camera is moving or has just been moved."""
        return not (self.active or self._rest_timer.isActive())

    def fly(self, flight: Flight) -> None:
        """Start a flight; a running flight ends at its current pose."""
        self.begin_move()
        self._start_flight(flight)

    def _start_flight(self, flight: Flight) -> None:
        self._rest_timer.stop()
        self._animation.stop()
        self._flight = flight
        self._animation.start()

    def _continue(self, share: float) -> None:
        if self._flight is not None:
            self._flight.at(share)
            self.moved.emit()

    # Movements by the user

    def begin_move(self) -> None:
        """Prepare for a movement by the user: record the current pose, and end a running flight."""
        if self.at_rest:
            self._commit()
        self._animation.stop()

    def end_move(self) -> None:
        """Note the end of a movement by the user; the pose is recorded when the camera is at rest."""
        if not self.active:
            self._rest_timer.start()

    def stop(self) -> None:
        """Stop flights and recording."""
        self._animation.stop()
        self._rest_timer.stop()

    def restart(self) -> None:
        """Clear the history, for example because another mesh is shown."""
        self.stop()
        self._poses.clear()
        self._remembered = None
        self.end_move()
        self.changed.emit()

    def _commit(self) -> None:
        self._rest_timer.stop()
        if self._poses.add(pose_of(self._camera)):
            self.changed.emit()

    # Back and forward

    @property
    def can_go_back(self) -> bool:
        """True if there is a previous pose."""
        return self._poses.can_go_back

    @property
    def can_go_forward(self) -> bool:
        """True if there is a next pose."""
        return self._poses.can_go_forward

    def go_back(self) -> None:
        """Fly to the previous pose, if there is one."""
        self._go(self._poses.back)

    def go_forward(self) -> None:
        """Fly to the next pose, if there is one."""
        self._go(self._poses.forward)

    def _go(self, step: Callable[[], CameraPose | None]) -> None:
        if not self.active:
            self._commit()  # a pose that was just reached has not been recorded yet
        pose = step()
        if pose is not None:
            self._start_flight(Flight(self._camera, pose))
            self.changed.emit()

    # Bookmarked pose

    def remember(self) -> None:
        """Bookmark the current pose, unless another pose is bookmarked."""
        if self._remembered is None:
            self._remembered = self._flight.goal if self.active else pose_of(self._camera)

    def fly_to_bookmark(self) -> None:
        """Fly to the bookmarked pose, if there is one, and clear the bookmark."""
        pose, self._remembered = self._remembered, None
        if pose is not None:
            self.fly(Flight(self._camera, pose))
