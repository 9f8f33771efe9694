"""Feature that moves the camera, and saves and restores cameras."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import TYPE_CHECKING

from PySide6.QtCore import Signal, SignalInstance
from PySide6.QtGui import QGuiApplication
from PySide6.QtWidgets import QMenu, QWidget

from hexmend.errors import ParameterError
from hexmend_app.feature import Action, Feature, Host, StatePart, always
from hexmend_app.picture import Camera, camera_from, camera_text
from hexmend_app.picture.camera import CameraPose
from hexmend_app.picture.cut_shapes import Plane
from hexmend_app.state.view.saved_cameras import SavedCameras
from hexmend_app.translation import tr
from hexmend_app.widgets.dialogs.questions import ask_camera_name

if TYPE_CHECKING:
    from hexmend_app.canvas.camera_animation import CameraAnimation

#: Direction, id, text, keys, icon and text in the tool bar.
_DIRECTIONS = (
    ("iso", "view_iso", "&Isometric", "0", "cube-outline", "Iso"),
    ("+x", "view_x", "From +&X", "1", "", "+X"),
    ("+y", "view_y", "From +&Y", "2", "", "+Y"),
    ("+z", "view_z", "From +&Z", "3", "", "+Z"),
    ("-x", "view_minus_x", "From −X", "4", "", ""),
    ("-y", "view_minus_y", "From −Y", "5", "", ""),
    ("-z", "view_minus_z", "From −Z", "6", "", ""),
)
#: Other movements: id, text, keys and help.
_MOVES = (
    ("face", "Face cutting pl&ane", "Shift+C", "Look along the normal of the plane."),
    ("roll_left", "Roll &left", "Shift+[", "Rotate the view by {angle}° counter-clockwise."),
    ("roll_right", "Roll ri&ght", "Shift+]", "Rotate the view by {angle}° clockwise."),
    ("view_back", "Previous &view", "Alt+Left", "Return to the previous camera position."),
    ("view_forward", "Ne&xt view", "Alt+Right", "Go forward to the next camera position."),
    ("copy_camera", "&Copy camera", "", "Copy the camera to the clipboard, for another window or hexmend render."),
    ("paste_camera", "&Paste camera", "", "Apply the camera from the clipboard."),
)
#: Step of a roll in degrees.
_ROLL = 15


class FeatureCamera(Feature):
    """Moves the camera, and saves and restores cameras by name."""

    def __init__(self, host: Host):
        super().__init__(host)
        self._cameras = self.session.saved_cameras
        self.menu = CamerasMenu(self._cameras, host.dialog_parent)
        self.menu.chosen.connect(self.go)
        self.menu.delete_requested.connect(self._cameras.remove)
        self.session.selection.visited.connect(self._fly)

    def actions(self) -> Iterable[Action]:
        """Yield the actions that move, copy, paste and save the camera."""
        yield Action(
            id="fit",
            text=tr("&Fit"),
            menu="View",
            keys="F",
            icon="arrow-expand-all",
            help=tr("Fit the visible mesh to the view."),
            tool=tr("Fit"),
            handle=lambda: self.canvas.fit(),
            enabled=self._ready,
            in_view=True,
        )
        yield from self._directions()
        yield from self._moves()
        for axis in "xyz":
            yield Action(
                id=f"up_{axis}",
                text=tr("{upper} &up", upper=axis.upper()) if axis == "z" else tr("{upper} up", upper=axis.upper()),
                menu="View/Up",
                help=tr("Use the {upper} axis as the vertical axis of the standard views.", upper=axis.upper()),
                handle=lambda on, axis=axis: self.canvas.set_up(axis),
                enabled=self._ready,
                checked=lambda axis=axis: self.canvas is not None and self.canvas.up == axis,
                exclusive=True,
            )
        yield from self._saved()
        yield Action(
            id="parallel",
            text=tr("&Parallel projection"),
            menu="View/Camera",
            section=3,
            keys="P",
            help=tr("Use parallel instead of perspective projection."),
            handle=lambda on: self.canvas.set_parallel(on),
            enabled=self._ready,
            checked=lambda: self.canvas is not None and self.canvas.parallel,
        )

    def _directions(self) -> Iterable[Action]:
        """Yield the actions that look along an axis or from a corner."""
        for name, id, text, keys, icon, tool in _DIRECTIONS:
            yield Action(
                id=id,
                text=tr(text),
                menu="View/Camera",
                keys=keys,
                icon=icon,
                help=tr("Look at the mesh from a corner.")
                if name == "iso"
                else tr("Look at the mesh from {direction}.", direction=name.replace("-", "−")),
                tool=tr(tool),
                handle=lambda name=name: self.canvas.look_along(name),
                enabled=self._ready,
            )

    def _moves(self) -> Iterable[Action]:
        """Yield the actions that turn the camera, go back and forward, copy and paste."""

        def animation() -> CameraAnimation:
            return self.canvas.camera_animation

        # What each does, and when it is enabled once the view exists.
        moves: dict[str, tuple[Callable[[], object], Callable[[], bool]]] = {
            "face": (lambda: self.canvas.face(self._plane), lambda: self._plane is not None),
            "roll_left": (lambda: self.canvas.roll(_ROLL), always),
            "roll_right": (lambda: self.canvas.roll(-_ROLL), always),
            "view_back": (lambda: animation().go_back(), lambda: animation().can_go_back),
            "view_forward": (lambda: animation().go_forward(), lambda: animation().can_go_forward),
            "copy_camera": (self.copy, lambda: self._draws),
            "paste_camera": (self.paste, always),
        }
        for id, text, keys, help in _MOVES:
            handle, enabled = moves[id]
            yield Action(
                id=id,
                text=tr(text),
                menu="View/Camera",
                section=1,
                keys=keys,
                help=tr(help, angle=_ROLL),
                handle=handle,
                enabled=lambda enabled=enabled: self._ready() and enabled(),
                in_view=id in ("face", "view_back"),
            )

    def _saved(self) -> Iterable[Action]:
        """Yield the action that saves the camera; the menu of saved cameras follows it."""
        yield Action(
            id="keep_camera",
            text=tr("&Save camera as…"),
            menu="View/Camera",
            section=2,
            keys="Ctrl+Shift+K",
            icon="bookmark-plus-outline",
            help=tr("Save the camera under a name, for views, pictures and the session."),
            handle=self.ask_name,
            enabled=lambda: self._draws,
            submenu=self.menu,
        )

    def states(self) -> Iterable[StatePart]:
        """Yield the pose of the camera."""
        yield StatePart(name="camera", data=CameraPose | None, to_data=self._to_data, restore=self._restore)

    def canvas_ready(self) -> None:
        """Refresh when the camera history changes."""
        self.canvas.views_changed.connect(self.host.refresh_soon)

    def refresh(self) -> None:
        """Restore the camera of an opened session, and the camera from before an isolation once it ends."""
        if self.session.view.wanted_camera is not None and self._draws:
            self._apply(self.session.view.wanted_camera)
            self.session.view.wanted_camera = None
        isolated = self.session.view.look.show.isolate is not None
        if self.canvas is not None and self._seen.changed("isolated", isolated):
            if isolated:
                self.canvas.camera_animation.remember()
            else:
                self.canvas.camera_animation.fly_to_bookmark()

    def copy(self) -> None:
        """Copy the camera to the clipboard in the format of `hexmend render --camera`."""
        QGuiApplication.clipboard().setText(camera_text(Camera.at(self.canvas.pose)))
        self.host.messages.show_info(tr("Camera copied. Paste it in another window or after hexmend render --camera."))

    def paste(self) -> None:
        """Apply the camera from the clipboard, or show an error."""
        try:
            camera = camera_from(QGuiApplication.clipboard().text())
        except ParameterError as error:
            self.host.messages.show_error(tr("Camera not pasted"), f"{error}.")
            return
        self._apply(camera)

    def ask_name(self) -> None:
        """Ask for a name, and save the camera."""
        name = ask_camera_name(self.host.dialog_parent, self._cameras.all)
        if name:
            self.keep(name)

    def keep(self, name: str) -> None:
        """Save the camera under a name, or show an error."""
        camera = Camera.at(self.canvas.pose)
        success = tr("Camera saved as “{name}”; apply it with View > Camera > Saved cameras.", name=name)
        if self.try_and_report(tr("Camera not saved"), lambda: self._cameras.add(name, camera)):
            self.host.messages.show_info(success)

    def go(self, name: str) -> None:
        """Apply a saved camera."""
        if self._draws and name in self._cameras.all:
            self._apply(self._cameras.all[name])

    def _apply(self, camera: Camera) -> None:
        if camera.pose is not None:
            self.canvas.set_pose(camera.pose)
        else:
            self.canvas.set_up(camera.up)
            self.canvas.set_parallel(camera.parallel)
            self.canvas.look_along(camera.direction)

    @property
    def _draws(self) -> bool:
        """True if the view has drawn the open mesh."""
        frame = None if self.canvas is None else self.canvas.viewport.frame
        return frame is not None and self.session.document.is_open and frame.mesh is self.session.document.now.mesh

    def _to_data(self) -> CameraPose | None:
        """Return the pose of the view; a requested pose that it has not taken yet comes first."""
        wanted = self.session.view.wanted_camera
        if wanted is not None and wanted.pose is not None:
            return wanted.pose
        return self.canvas.pose if self._draws else None

    def _restore(self, pose: CameraPose | None) -> None:
        self.session.view.request_camera(None if pose is None else Camera.at(pose))

    def _ready(self) -> bool:
        return self.canvas is not None

    @property
    def _plane(self) -> Plane | None:
        """Selected cutting plane, or the middle of the slab; None if there is neither."""
        cut = self.session.view.look.cut
        if cut.slab is not None:
            return cut.slab.middle
        return cut.planes[self.session.view.plane_at] if cut.planes else None

    def _fly(self, hexes: tuple[int, ...]) -> None:
        if self.canvas is not None and self.session.document.is_open:
            if self.session.view.look.show.isolate is not None:
                self.canvas.camera_animation.remember()
            self.canvas.fly_to(*hexes)


class CamerasMenu(QMenu):
    """Menu that applies and deletes saved cameras.

    Parameters
    ----------
    cameras : SavedCameras

    Signals
    -------
    chosen(name), delete_requested(name)
        The user selected a camera to apply or delete.
    """

    chosen = Signal(str)
    delete_requested = Signal(str)

    def __init__(self, cameras: SavedCameras, parent: QWidget | None = None):
        super().__init__(tr("Saved c&ameras"), parent)
        self._cameras = cameras
        self.aboutToShow.connect(self._fill)
        cameras.changed.connect(self._enable)
        self._enable()

    def _enable(self) -> None:
        self.menuAction().setEnabled(bool(self._cameras.all))

    def _fill(self) -> None:
        self.clear()
        self._add_names(self, self.chosen, tr("Apply the camera “{name}”."))
        self.addSeparator()
        self._add_names(self.addMenu(tr("&Delete")), self.delete_requested, tr("Delete the camera “{name}”."))

    def _add_names(self, menu: QMenu, chosen: SignalInstance, help: str) -> None:
        for number, name in enumerate(self._cameras.all, start=1):
            mnemonic = f"&{number % 10}  " if number <= 10 else "     "
            action = menu.addAction(mnemonic + name.replace("&", "&&"))
            action.setStatusTip(help.replace("{name}", name))
            action.triggered.connect(lambda _=False, name=name: chosen.emit(name))
