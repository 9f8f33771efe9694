"""The camera in time: its flights, and the way back through the views that there have been."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from PySide6.QtCore import QElapsedTimer, QObject, QTimer, Signal
from vtkmodules.vtkRenderingCore import vtkCamera

from hexmend_app.scene.camera.flight import Flight
from hexmend_app.scene.camera.history import Poses
from hexmend_app.scene.camera.pose import Pose

#: Milliseconds that the camera flies, and between two of its frames.
_FLIGHT, _FRAME = 350, 25

#: Milliseconds without a movement after which the camera has come to rest.
_REST = 300


class Travel(QObject):
    """Leads the camera on its flights, and remembers where it came to rest.

    Whatever moves the camera says so: `leave` before, `arrive` after.

    Parameters
    ----------
    camera : vtkCamera

    Signals
    -------
    moved
        The camera is a little further on a flight.
    changed
        What there is to go back or forward to is another.
    """

    moved = Signal()
    changed = Signal()

    def __init__(self, camera: vtkCamera, parent: QObject | None = None):
        super().__init__(parent)
        self._camera = camera
        self._poses = Poses()
        self._remembered: Pose | None = None
        self._flight: Flight | None = None
        self._flown = QElapsedTimer()
        self._timer = QTimer(self, interval=_FRAME)
        self._timer.timeout.connect(self._go_on)
        self._settling = QTimer(self, interval=_REST, singleShot=True)
        self._settling.timeout.connect(self._settle)

    # Flights

    @property
    def under_way(self) -> bool:
        """Whether the camera flies."""
        return self._timer.isActive()

    @property
    def at_rest(self) -> bool:
        """Whether the camera neither flies nor has just been moved."""
        return not (self.under_way or self._settling.isActive())

    def fly(self, flight: Flight) -> None:
        """Set out; a flight that is on its way ends where it is."""
        self.leave()
        self._set_out(flight)

    def _set_out(self, flight: Flight) -> None:
        self._settling.stop()
        self._flight = flight
        self._flown.start()
        self._timer.start()

    def _go_on(self) -> None:
        share = min(self._flown.elapsed() / _FLIGHT, 1.0)
        self._flight.at(share)
        if share == 1.0:
            self._timer.stop()
            self._settle()
        self.moved.emit()

    # Comings and goings

    def leave(self) -> None:
        """The camera is about to be moved: where it has rested is a view to come back to; a flight ends."""
        if self.at_rest:
            self._settle()
        self._timer.stop()

    def arrive(self) -> None:
        """The camera has been moved, and may come to rest."""
        if not self.under_way:
            self._settling.start()

    def stop(self) -> None:
        """Neither fly nor remember any more."""
        self._timer.stop()
        self._settling.stop()

    def begin_anew(self) -> None:
        """Forget all views: they were of another mesh."""
        self.stop()
        self._poses.clear()
        self._remembered = None
        self.arrive()
        self.changed.emit()

    def journey(self) -> tuple[list[Pose], list[Pose], Pose | None]:
        """What there is to go back to and forward to, the oldest first, and what is remembered."""
        before, after = self._poses.around(Pose.of(self._camera))
        return before, after, self._remembered

    def resume(self, before: Sequence[Pose], after: Sequence[Pose], remembered: Pose | None) -> None:
        """Go on from where the camera is as if it had come this way."""
        self.stop()
        self._poses.restore(before, Pose.of(self._camera), after)
        self._remembered = remembered
        self.changed.emit()

    def _settle(self) -> None:
        self._settling.stop()
        if self._poses.add(Pose.of(self._camera)):
            self.changed.emit()

    # Back and forward

    @property
    def can_go_back(self) -> bool:
        """Whether there is a view before the one of now."""
        return self._poses.can_go_back

    @property
    def can_go_forward(self) -> bool:
        """Whether there is a view after the one of now."""
        return self._poses.can_go_forward

    def go_back(self) -> None:
        """Fly to the view before; there may be none."""
        self._go(self._poses.back)

    def go_forward(self) -> None:
        """Fly to the view after; there may be none."""
        self._go(self._poses.forward)

    def _go(self, step: Callable[[], Pose | None]) -> None:
        if not self.under_way:
            self._settle()  # where the camera has just been led, it has not rested yet
        pose = step()
        if pose is not None:
            self._set_out(Flight(self._camera, pose))
            self.changed.emit()

    # The pose before an excursion

    def remember(self) -> None:
        """Remember where the camera is, unless there is something that it has not come back to yet."""
        if self._remembered is None:
            self._remembered = self._flight.goal if self.under_way else Pose.of(self._camera)

    def come_back(self) -> None:
        """Fly to what is remembered, and forget it; there may be nothing."""
        pose, self._remembered = self._remembered, None
        if pose is not None:
            self.fly(Flight(self._camera, pose))
