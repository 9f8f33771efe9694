"""The 3D view as a widget: the scene in a Qt interactor, from wherever the user wants to see it."""

from __future__ import annotations

import sys
from collections.abc import Callable
from functools import partial

import numpy as np
from PySide6.QtCore import QEvent, QObject, Qt, QTimer, Signal
from PySide6.QtGui import QKeyEvent
from PySide6.QtWidgets import QWidget

from hexmend_app.canvas.render_widget import RenderWidget
from hexmend_app.canvas.travel import Travel
from hexmend_app.canvas.view_keys import move_of
from hexmend_app.scene.camera.pose import Pose
from hexmend_app.scene.panes import Panes
from hexmend_app.state.clip import ClipPlane
from hexmend_app.state.eye import Journey
from hexmend_app.state.stand import Stand
from hexmend_app.widgets.style import explain

#: Milliseconds of rest after which the fine still frame is drawn.
_REST = 300

#: Width and height in pixels that the view has at least.
_LEAST = (320, 240)


class CameraView(QWidget):
    """Shows views of meshes through a camera that is led by mouse, keys and calls; draws when something has changed.

    Attributes
    ----------
    interactor : RenderWidget
        Where it is drawn.
    panes : Panes
        The views.
    viewport : Viewport
        The first of them.
    travel : Travel
        The camera's flights and rests.

    Signals
    -------
    views_changed
        There is another view to go back or forward to, or another projection.
    """

    views_changed = Signal()

    def __init__(self, parent: QWidget | None = None):
        super().__init__(parent)
        self.interactor = RenderWidget(self)
        self.interactor.setMinimumSize(*_LEAST)
        explain(self.interactor, "3D view", "")
        self.interactor.setAccessibleDescription(
            "Arrow keys turn the mesh, Shift and arrow keys shift it, + and − zoom; F shows all of it."
        )
        self.panes = Panes(self.interactor.render_window, pen=self.devicePixelRatioF(), on_failure=_report)
        self.viewport = self.panes.first
        self._rest = QTimer(self, interval=_REST, singleShot=True)
        self._rest.timeout.connect(self.draw_still)
        self.travel = Travel(self.viewport.camera, self)
        self.travel.moved.connect(self._on_flown)
        self.travel.changed.connect(self.views_changed)
        watch = self.interactor.iren.AddObserver
        watch("StartInteractionEvent", lambda *_: self.travel.leave())
        watch("InteractionEvent", lambda *_: self.turning())
        watch("EndInteractionEvent", lambda *_: self._on_turned())
        self._keys = _Keys(self)

    def fit(self) -> None:
        """Show what is shown as large as it can be."""
        self._lead(self.panes.eye.fit)

    def look_along(self, direction: str) -> None:
        """Look along an axis: +x, -x, ..., iso."""
        self._lead(partial(self.panes.eye.look_along, direction))

    @property
    def stand(self) -> Stand:
        """Where the camera stands."""
        return self._stand(Pose.of(self.viewport.camera))

    @property
    def journey(self) -> Journey:
        """Where it has stood."""
        before, after, remembered = self.travel.journey()
        stands = (tuple(self._stand(pose) for pose in poses) for poses in (before, after))
        return Journey(*stands, None if remembered is None else self._stand(remembered))

    def stand_at(self, stand: Stand, journey: Journey | None = None) -> None:
        """Have the camera stand somewhere; with a journey, as if it had come that way."""
        self.panes.eye.up = stand.axis
        self._lead(partial(_pose(stand).give, self.viewport.camera))
        if journey is not None:
            before, after = map(_pose, journey.before), map(_pose, journey.after)
            self.travel.resume(list(before), list(after), None if journey.left is None else _pose(journey.left))

    def _stand(self, pose: Pose) -> Stand:
        return Stand(pose.position, pose.focal, pose.up, pose.parallel, pose.scale, self.up)

    @property
    def up(self) -> str:
        """The axis that is up: x, y or z."""
        return self.panes.eye.up

    def set_up(self, axis: str) -> None:
        """Let another axis be up: x, y or z."""
        self._lead(partial(self.panes.eye.set_up, axis))

    def roll(self, degrees: float) -> None:
        """Turn the picture, counter-clockwise."""
        self._lead(partial(self.panes.eye.roll, degrees))

    @property
    def parallel(self) -> bool:
        """Whether the projection is parallel."""
        return bool(self.viewport.camera.GetParallelProjection())

    def set_parallel(self, on: bool) -> None:
        """Parallel projection or perspective."""
        self._lead(partial(self.panes.eye.set_parallel, on))

    def _lead(self, move: Callable[[], None]) -> None:
        """Move the camera at once."""
        self.travel.leave()
        move()
        self.travel.arrive()
        self.panes.eye.reset_depth()
        self.changed()

    def face(self, plane: ClipPlane) -> None:
        """Fly to where a plane is seen from straight before it, with what is beyond cut away."""
        self.travel.fly(self.panes.eye.flight_along(plane.normal))

    def fly_to(self, *hexes: int) -> None:
        """Bring an element, or several together, before the camera."""
        if self.viewport.frame is None:
            return
        mesh = self.viewport.frame.mesh
        self.travel.fly(self.panes.eye.flight_to(mesh.points[mesh.hexes[list(hexes)]]))

    def fly_around(self, place: np.ndarray) -> None:
        """Bring a place, (3,) float64, into the middle of the picture: the camera turns about it from then on."""
        self.travel.fly(self.panes.eye.flight_around(place))

    @property
    def can_go_back(self) -> bool:
        """Whether there is a view before the one of now."""
        return self.travel.can_go_back

    @property
    def can_go_forward(self) -> bool:
        """Whether there is a view after the one of now."""
        return self.travel.can_go_forward

    def back_view(self) -> None:
        """Fly to the view before."""
        self.travel.go_back()

    def forward_view(self) -> None:
        """Fly to the view after."""
        self.travel.go_forward()

    def remember_pose(self) -> None:
        """Remember from where the mesh is seen, unless there is something that has not been returned to yet."""
        self.travel.remember()

    def return_to_pose(self) -> None:
        """Fly to what is remembered, and forget it; where nothing is, stay."""
        self.travel.come_back()

    def _on_flown(self) -> None:
        self.panes.eye.reset_depth()
        self.turning()
        self.draw_soon()

    def _on_turned(self) -> None:
        self.travel.arrive()
        self._rest.start()

    # Fast frames and fine ones

    def changed(self) -> None:
        """Draw soon: something else is to be seen."""
        self.panes.moving()
        self.draw_soon()

    def draw_soon(self) -> None:
        """Draw as it is, and a fine frame when nothing has moved for a while."""
        self._rest.start()
        self.interactor.update()

    def turning(self) -> None:
        """Prepare for frames in which nothing but the camera moves."""
        self._rest.stop()
        self.panes.turning()

    def stay_coarse(self) -> None:
        """Draw no fine frame: more is to come."""
        self._rest.stop()

    def rest(self) -> None:
        """Draw the fine frame soon: nothing moves for now."""
        self._rest.start()

    def draw_still(self) -> None:
        """Draw the fine frame."""
        self.panes.still()
        self.interactor.update()

    def let_go(self) -> None:
        """Let go of the graphics while the window still exists."""
        self._rest.stop()
        self.travel.stop()
        self.interactor.let_go()

    def on_key(self, event: QKeyEvent) -> None:
        """Lead the camera as a key says, if it says anything."""
        move = move_of(event, self.panes.eye.up)
        if move is not None:
            self._lead(partial(move, self.viewport.camera))


def _report(error: Exception) -> None:
    """Show what a layer has raised, as what a slot raises is shown; the picture is drawn without that layer."""
    sys.excepthook(type(error), error, error.__traceback__)


def _pose(stand: Stand) -> Pose:
    return Pose(stand.position, stand.focal, stand.up, stand.parallel, stand.scale)


class _Keys(QObject):
    """Keeps the keys from VTK, which has some of its own that would draw wires or end it."""

    def __init__(self, view: CameraView):
        super().__init__(view)
        self._view = view
        view.interactor.installEventFilter(self)

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Lead the camera."""
        if event.type() == QEvent.Type.KeyPress and event.key() not in (Qt.Key.Key_Tab, Qt.Key.Key_Backtab):
            self._view.on_key(event)
            return True
        return super().eventFilter(watched, event)
