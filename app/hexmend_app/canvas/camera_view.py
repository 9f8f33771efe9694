"""3D view with a camera as a widget."""

from __future__ import annotations

import sys
from collections.abc import Callable
from functools import partial

from PySide6.QtCore import Qt, QTimer, Signal
from PySide6.QtGui import QKeyEvent
from PySide6.QtWidgets import QWidget
from vtkmodules.vtkRenderingCore import vtkCamera

from hexmend_app.canvas.camera_animation import CameraAnimation
from hexmend_app.canvas.render_widget import RenderWidget
from hexmend_app.picture.camera import CameraPose, Vector
from hexmend_app.picture.cut_shapes import Plane
from hexmend_app.scene.camera import steering
from hexmend_app.scene.camera.vtk_pose import pose_of
from hexmend_app.scene.views.panes import Panes
from hexmend_app.theme.style import set_help
from hexmend_app.translation import tr

#: Time without changes after which the fine frame is drawn, in milliseconds.
_REST = 300

#: Minimum width and height in pixels.
_MIN_SIZE = (160, 120)


#: Steps of a key: rotation in degrees, panning as a fraction of the picture height, and zoom factor.
_TURN, _PAN, _ZOOM = 15.0, 0.1, 1.2

_ARROWS: dict[int, tuple[int, int]] = {
    Qt.Key.Key_Right: (1, 0),
    Qt.Key.Key_Left: (-1, 0),
    Qt.Key.Key_Up: (0, 1),
    Qt.Key.Key_Down: (0, -1),
}

_ZOOMS: dict[int, float] = {Qt.Key.Key_Plus: _ZOOM, Qt.Key.Key_Equal: _ZOOM, Qt.Key.Key_Minus: 1 / _ZOOM}

#: Modifiers of other shortcuts; for example, Alt with an arrow goes back or forward.
_OTHERS = Qt.KeyboardModifier.AltModifier | Qt.KeyboardModifier.ControlModifier | Qt.KeyboardModifier.MetaModifier


class CameraView(QWidget):
    """Shows views of meshes with a common camera, which is moved by mouse, keyboard and method calls.

    Attributes
    ----------
    interactor : RenderWidget
        Widget that draws the views.
    panes : Panes
        The views.
    viewport : Viewport
        The first view.
    camera_animation : CameraAnimation
        Flights and pose history of the camera.

    Signals
    -------
    views_changed
        The history of camera poses or the projection has changed.
    """

    views_changed = Signal()

    def __init__(self, parent: QWidget | None = None):
        super().__init__(parent)
        self.interactor = RenderWidget(self)
        self.interactor.setMinimumSize(*_MIN_SIZE)
        set_help(self.interactor, tr("3D view"), "")
        self.interactor.setAccessibleDescription(
            tr("Arrow keys rotate, Shift and arrow keys pan, + and − zoom; F fits the mesh into the view.")
        )
        self.panes = Panes(self.interactor.render_window, pixel_ratio=self.devicePixelRatioF(), on_failure=_report)
        self.viewport = self.panes.first
        self._rest = QTimer(self, interval=_REST, singleShot=True)
        self._rest.timeout.connect(self.draw_still)
        self.camera_animation = CameraAnimation(self.viewport.camera, self)
        self.camera_animation.moved.connect(self._on_flight_frame)
        self.camera_animation.changed.connect(self.views_changed)
        observe = self.interactor.iren.AddObserver
        observe("StartInteractionEvent", lambda *_: self.camera_animation.begin_move())
        observe("InteractionEvent", lambda *_: self.turning())
        observe("EndInteractionEvent", lambda *_: self._on_interaction_end())

    def fit(self) -> None:
        """Fit the shown hexes into the view."""
        self._move_camera(self.panes.camera_controller.fit)

    def look_along(self, direction: str | Vector) -> None:
        """Show the mesh from a direction: +x, -x, ..., iso."""
        self._move_camera(partial(self.panes.camera_controller.look_along, direction))

    @property
    def pose(self) -> CameraPose:
        """Current camera pose."""
        return pose_of(self.viewport.camera, self.up)

    def set_pose(self, pose: CameraPose) -> None:
        """Set the camera pose."""
        self._move_camera(partial(self.panes.camera_controller.apply, pose))

    @property
    def up(self) -> str:
        """Vertical axis: x, y or z."""
        return self.panes.camera_controller.up

    def set_up(self, axis: str) -> None:
        """Set the vertical axis: x, y or z."""
        self._move_camera(partial(self.panes.camera_controller.set_up, axis))

    def roll(self, degrees: float) -> None:
        """Rotate the picture counter-clockwise."""
        self._move_camera(partial(self.panes.camera_controller.roll, degrees))

    @property
    def parallel(self) -> bool:
        """True for parallel projection."""
        return bool(self.viewport.camera.GetParallelProjection())

    def set_parallel(self, on: bool) -> None:
        """Switch between parallel and perspective projection."""
        self._move_camera(partial(self.panes.camera_controller.set_parallel, on))

    def _move_camera(self, move: Callable[[], None]) -> None:
        """Move the camera immediately and record the movement."""
        self.camera_animation.begin_move()
        move()
        self.camera_animation.end_move()
        self.panes.camera_controller.reset_depth()
        self.changed()

    def face(self, plane: Plane) -> None:
        """Fly to a view perpendicular to a plane, from the side that the cut removes."""
        self.camera_animation.fly(self.panes.camera_controller.flight_along(plane.normal))

    def fly_to(self, *hexes: int) -> None:
        """Fly to one or several hexes."""
        if self.viewport.frame is None:
            return
        mesh = self.viewport.frame.mesh
        self.camera_animation.fly(self.panes.camera_controller.flight_to(mesh.points[mesh.elements[list(hexes)]]))

    def _on_flight_frame(self) -> None:
        self.panes.camera_controller.reset_depth()
        self.turning()
        self.draw_soon()

    def _on_interaction_end(self) -> None:
        self.camera_animation.end_move()
        self._rest.start()

    # Fast and fine frames

    def changed(self) -> None:
        """Schedule drawing after a change."""
        self.panes.moving()
        self.draw_soon()

    def draw_soon(self) -> None:
        """Schedule a fast frame, and a fine frame after a time without changes."""
        self._rest.start()
        self.interactor.update()

    def turning(self) -> None:
        """Prepare for fast frames in which only the camera moves."""
        self._rest.stop()
        self.panes.turning()

    def rest(self) -> None:
        """Schedule a fine frame."""
        self._rest.start()

    def draw_still(self) -> None:
        """Draw the fine frame."""
        self.panes.still()
        self.interactor.update()

    def release_graphics(self) -> None:
        """Release graphics resources while the window still exists."""
        self._rest.stop()
        self.camera_animation.stop()
        self.interactor.release_graphics()

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Move the camera if the key is bound to a movement; VTK receives no keys."""
        move = move_of(event, self.panes.camera_controller.up)
        if move is not None:
            self._move_camera(partial(move, self.viewport.camera))
        else:
            super().keyPressEvent(event)


def _report(error: Exception) -> None:
    """Report the exception of a layer through the exception hook; the frame is drawn without the layer."""
    sys.excepthook(type(error), error, error.__traceback__)


def move_of(event: QKeyEvent, up: str) -> Callable[[vtkCamera], None] | None:
    """Return the camera movement of a key, given the vertical axis `up`; None for an unbound key."""
    if event.modifiers() & _OTHERS:
        return None
    if event.key() in _ARROWS:
        right, above = _ARROWS[event.key()]
        if event.modifiers() & Qt.KeyboardModifier.ShiftModifier:
            return partial(steering.pan, right=_PAN * right, up=_PAN * above)
        return partial(steering.turn, right=_TURN * right, up=_TURN * above, axis=up)
    if event.key() in _ZOOMS:
        return partial(steering.zoom, factor=_ZOOMS[event.key()])
    return None
