"""The 3D view as a widget with a camera: the scene in a Qt interactor."""

from __future__ import annotations

import sys
from collections.abc import Callable
from dataclasses import replace
from functools import partial
from typing import TYPE_CHECKING

import numpy as np
from PySide6.QtCore import QEvent, QObject, Qt, QTimer, Signal
from PySide6.QtGui import QKeyEvent
from PySide6.QtWidgets import QWidget

from hexmend_app.canvas.camera_animation import CameraAnimation
from hexmend_app.canvas.render_widget import RenderWidget
from hexmend_app.canvas.view_keys import move_of
from hexmend_app.picture.camera_pose import CameraPose
from hexmend_app.picture.cut_planes import ClipPlane
from hexmend_app.scene.camera.vtk_pose import apply_pose, pose_of
from hexmend_app.scene.views.panes import Panes
from hexmend_app.state.view.camera_request import PoseHistoryData
from hexmend_app.theme.style import set_help

if TYPE_CHECKING:
    from pyvistaqt import BackgroundPlotter

    from hexmend_app.canvas.plotter import CanvasPlotter

#: Milliseconds of rest after which the fine still frame is drawn.
_REST = 300

#: Width and height in pixels that the view has at least.
_LEAST = (320, 240)


class CameraView(QWidget):
    """Shows views of meshes through a camera that mouse, keys and calls move; draws after changes.

    Attributes
    ----------
    interactor : RenderWidget
        Draws the views.
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
        set_help(self.interactor, "3D view", "")
        self.interactor.setAccessibleDescription(
            "Arrow keys turn the mesh, Shift and arrow keys shift it, + and − zoom; F shows all of it."
        )
        self.panes = Panes(self.interactor.render_window, pixel_ratio=self.devicePixelRatioF(), on_failure=_report)
        self.viewport = self.panes.first
        self._rest = QTimer(self, interval=_REST, singleShot=True)
        self._rest.timeout.connect(self.draw_still)
        self.travel = CameraAnimation(self.viewport.camera, self)
        self.travel.moved.connect(self._on_flown)
        self.travel.changed.connect(self.views_changed)
        watch = self.interactor.iren.AddObserver
        watch("StartInteractionEvent", lambda *_: self.travel.leave())
        watch("InteractionEvent", lambda *_: self.turning())
        watch("EndInteractionEvent", lambda *_: self._on_turned())
        self._keys = _Keys(self)
        self._plotter: CanvasPlotter | None = None

    @property
    def plotter(self) -> CanvasPlotter:
        """PyVista's plotter on the first view, made when first asked for: its import takes half a second."""
        if self._plotter is None:
            from hexmend_app.canvas.plotter import CanvasPlotter

            self._plotter = CanvasPlotter(self)
        return self._plotter

    def new_plotter_window(self, title: str = "PyVista") -> BackgroundPlotter:
        """Open a further view in a window of its own, with PyVista's interactor and widgets."""
        from hexmend_app.canvas.plotter import open_window

        return open_window(title)

    def fit(self) -> None:
        """Fit the shown hexes into the view."""
        self._lead(self.panes.eye.fit)

    def look_along(self, direction: str) -> None:
        """Look along an axis: +x, -x, ..., iso."""
        self._lead(partial(self.panes.eye.look_along, direction))

    @property
    def stand(self) -> CameraPose:
        """The present camera pose."""
        return pose_of(self.viewport.camera, self.up)

    @property
    def journey(self) -> PoseHistoryData:
        """The history of camera poses."""
        before, after, remembered = self.travel.journey()
        poses = (tuple(replace(pose, axis=self.up) for pose in poses) for poses in (before, after))
        return PoseHistoryData(*poses, None if remembered is None else replace(remembered, axis=self.up))

    def stand_at(self, stand: CameraPose, journey: PoseHistoryData | None = None) -> None:
        """Set the camera pose and, if given, the history of poses."""
        self.panes.eye.up = stand.axis
        self._lead(partial(apply_pose, self.viewport.camera, stand))
        if journey is not None:
            self.travel.resume(journey.before, journey.after, journey.left)

    @property
    def up(self) -> str:
        """The axis that is up: x, y or z."""
        return self.panes.eye.up

    def set_up(self, axis: str) -> None:
        """Set the vertical axis: x, y or z."""
        self._lead(partial(self.panes.eye.set_up, axis))

    def roll(self, degrees: float) -> None:
        """Turn the picture, counter-clockwise."""
        self._lead(partial(self.panes.eye.roll, degrees))

    @property
    def parallel(self) -> bool:
        """True for parallel projection."""
        return bool(self.viewport.camera.GetParallelProjection())

    def set_parallel(self, on: bool) -> None:
        """Choose parallel projection, or perspective."""
        self._lead(partial(self.panes.eye.set_parallel, on))

    def _lead(self, move: Callable[[], None]) -> None:
        """Move the camera at once."""
        self.travel.leave()
        move()
        self.travel.arrive()
        self.panes.eye.reset_depth()
        self.changed()

    def face(self, plane: ClipPlane) -> None:
        """Move to a view straight at a plane, from the side that the cut removes."""
        self.travel.fly(self.panes.eye.flight_along(plane.normal))

    def fly_to(self, *hexes: int) -> None:
        """Move the camera to an element, or to several."""
        if self.viewport.frame is None:
            return
        mesh = self.viewport.frame.mesh
        self.travel.fly(self.panes.eye.flight_to(mesh.points[mesh.hexes[list(hexes)]]))

    def fly_around(self, place: np.ndarray) -> None:
        """Make a point, (3,) float64, the centre of the view and of rotation."""
        self.travel.fly(self.panes.eye.flight_around(place))

    @property
    def can_go_back(self) -> bool:
        """True if there is a previous view."""
        return self.travel.can_go_back

    @property
    def can_go_forward(self) -> bool:
        """True if there is a next view."""
        return self.travel.can_go_forward

    def back_view(self) -> None:
        """Move to the previous view."""
        self.travel.go_back()

    def forward_view(self) -> None:
        """Move to the next view."""
        self.travel.go_forward()

    def remember_pose(self) -> None:
        """Bookmark the present pose, unless another one is bookmarked."""
        self.travel.remember()

    def return_to_pose(self) -> None:
        """Move to the bookmarked pose, if there is one, and clear it."""
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
        """Schedule drawing after a change."""
        self.panes.moving()
        self.draw_soon()

    def draw_soon(self) -> None:
        """Schedule a fast frame, and a fine one when nothing has moved for a while."""
        self._rest.start()
        self.interactor.update()

    def turning(self) -> None:
        """Prepare for frames in which nothing but the camera moves."""
        self._rest.stop()
        self.panes.turning()

    def stay_coarse(self) -> None:
        """Cancel the fine frame: further changes follow."""
        self._rest.stop()

    def rest(self) -> None:
        """Schedule the fine frame: nothing moves for now."""
        self._rest.start()

    def draw_still(self) -> None:
        """Draw the fine frame."""
        self.panes.still()
        self.interactor.update()

    def let_go(self) -> None:
        """Release graphics resources while the window still exists."""
        self._rest.stop()
        self.travel.stop()
        if self._plotter is not None:
            self._plotter.close()
        self.interactor.let_go()

    def on_key(self, event: QKeyEvent) -> None:
        """Move the camera by a key that is bound to it."""
        move = move_of(event, self.panes.eye.up)
        if move is not None:
            self._lead(partial(move, self.viewport.camera))


def _report(error: Exception) -> None:
    """Report the exception of a layer through the exception hook; the frame is drawn without that layer."""
    sys.excepthook(type(error), error, error.__traceback__)


class _Keys(QObject):
    """Event filter that keeps keys from VTK, whose bindings would draw wireframes or quit."""

    def __init__(self, view: CameraView):
        super().__init__(view)
        self._view = view
        view.interactor.installEventFilter(self)

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Move the camera by keys."""
        if event.type() == QEvent.Type.KeyPress and event.key() not in (Qt.Key.Key_Tab, Qt.Key.Key_Backtab):
            self._view.on_key(event)
            return True
        return super().eventFilter(watched, event)
