"""Camera of the 3D view: directions, history, and saved cameras."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from typing import TYPE_CHECKING

from PySide6.QtGui import QGuiApplication

from hexmend.errors import ParameterError
from hexmend_app.feature import Action, ChangeTracker, Feature, Host
from hexmend_app.features.camera.cameras_dialog import CamerasDialog
from hexmend_app.features.camera.cameras_menu import CamerasMenu
from hexmend_app.picture import Camera, camera_from, camera_text
from hexmend_app.picture.camera_pose import CameraPose
from hexmend_app.picture.cut_planes import PlaneClip
from hexmend_app.state.view.camera_request import PoseHistoryData
from hexmend_app.widgets.dialogs.questions import ask_camera_name

if TYPE_CHECKING:
    from hexmend_app.canvas.canvas import Canvas

#: Direction, id, text, keys, icon and word in the tool bar.
_DIRECTIONS = (
    ("iso", "view_iso", "&Isometric", "0", "axis-arrow", "Iso"),
    ("+x", "view_x", "From +&X", "1", "axis-x-arrow", "X"),
    ("+y", "view_y", "From +&Y", "2", "axis-y-arrow", "Y"),
    ("+z", "view_z", "From +&Z", "3", "axis-z-arrow", "Z"),
    ("-x", "view_minus_x", "From −X", "4", "axis-x-arrow", ""),
    ("-y", "view_minus_y", "From −Y", "5", "axis-y-arrow", ""),
    ("-z", "view_minus_z", "From −Z", "6", "axis-z-arrow", ""),
)

#: Degrees that the picture is rolled by at once.
_ROLL = 15


class FeatureCamera(Feature):
    """Moves the camera, and saves and restores its pose."""

    order = 51

    def __init__(self, host: Host):
        super().__init__(host)
        self._seen = ChangeTracker()
        self._cameras = self.session.saved_cameras
        self._menu = CamerasMenu(self._cameras, host.dialog_parent)
        self._menu.chosen.connect(self.go)
        self.session.selection.visited.connect(self._fly)
        self.session.camera_request.now = self._stand
        self.session.camera_request.travelled = self._journey

    def actions(self) -> Sequence[Action]:
        """Fit, the directions, back and forward, what is up, and how depth is drawn."""
        return (
            Action(
                id="fit",
                text="&Fit",
                menu="View",
                keys="F",
                icon="fit-to-page-outline",
                help="Fit everything visible into the view.",
                tool="Fit",
                handle=lambda: self.canvas.fit(),
                enabled=self._ready,
                in_view=True,
            ),
            *self._directions(),
            self._move("face", "Face the pl&ane", "Shift+C", "Look perpendicularly at the cutting plane.", self._face,
                       lambda: self._plane is not None, in_view=True),
            self._move("roll_left", "Roll to the &left", "Shift+[", "Turn the picture counter-clockwise.",
                       lambda: self.canvas.roll(_ROLL)),
            self._move("roll_right", "Roll to the ri&ght", "Shift+]", "Turn the picture clockwise.",
                       lambda: self.canvas.roll(-_ROLL)),
            self._move("view_back", "View &back", "Alt+Left", "Return to the previous view.",
                       lambda: self.canvas.back_view(), lambda: self.canvas.can_go_back, in_view=True),
            self._move("view_forward", "View for&ward", "Alt+Right", "Go to the next view.",
                       lambda: self.canvas.forward_view(), lambda: self.canvas.can_go_forward),
            *(
                Action(
                    id=f"up_{axis}",
                    text=f"{axis.upper()} is &up" if axis == "z" else f"{axis.upper()} is up",
                    menu="View/Up",
                    help=f"Point the {axis.upper()} axis upwards in the standard views.",
                    handle=lambda on, axis=axis: self.canvas.set_up(axis),
                    enabled=self._ready,
                    checked=lambda axis=axis: self.canvas is not None and self.canvas.up == axis,
                    exclusive=True,
                )
                for axis in "xyz"
            ),
            self._move("copy_camera", "&Copy camera", "", "Copy the camera to the clipboard, for a picture or another "
                       "window.", self.copy, lambda: self._draws),
            self._move("paste_camera", "&Paste camera", "", "Apply the camera from the clipboard.", self.paste),
            *self._kept(),
            Action(
                id="parallel",
                text="&Parallel projection",
                menu="View/Camera",
                part=3,
                keys="P",
                help="Use parallel projection instead of perspective.",
                handle=lambda on: self.canvas.set_parallel(on),
                enabled=self._ready,
                checked=lambda: self.canvas is not None and self.canvas.parallel,
            ),
        )  # fmt: skip

    def _directions(self) -> Iterator[Action]:
        """Yield the actions that look along an axis or from a corner."""
        yield from (
            Action(
                id=id,
                text=text,
                menu="View/Camera",
                keys=keys,
                icon=icon,
                help=f"Look at the mesh from {'a corner' if name == 'iso' else name.replace('-', '−')}.",
                tool=tool,
                handle=lambda name=name: self.canvas.look_along(name),
                enabled=self._ready,
            )
            for name, id, text, keys, icon, tool in _DIRECTIONS
        )

    def _kept(self) -> Sequence[Action]:
        """Return the actions for saved cameras."""
        return (
            Action(
                id="keep_camera",
                text="&Save camera as…",
                menu="View/Camera",
                part=2,
                keys="Ctrl+Shift+K",
                icon="camera-plus-outline",
                help="Save the camera under a name, for later use, for pictures and in the session.",
                handle=self.ask_name,
                enabled=lambda: self._draws,
                submenu=self._menu,
            ),
            Action(
                id="cameras",
                text="Saved ca&meras…",
                menu="View/Camera",
                part=2,
                help="Apply, rename or delete a saved camera.",
                handle=self.show_cameras,
                enabled=lambda: self._draws and bool(self._cameras.all),
            ),
        )

    def canvas_ready(self, canvas: Canvas) -> None:
        """Take the 3D view."""
        canvas.views_changed.connect(self.host.refresh_soon)

    def refresh(self) -> None:
        """Come back to where the camera was before something was isolated, once it no longer is.

        Where a session says where the camera is to stand, it does once the session's mesh is drawn.
        """
        if self.session.camera_request.wanted is not None and self._draws:
            self._look_through(self.session.camera_request.wanted, self.session.camera_request.journey)
            self.session.camera_request.wanted, self.session.camera_request.journey = None, PoseHistoryData()
        isolated = self.session.view.look.isolation is not None
        if self.canvas is not None and self._seen.changed("isolated", isolated):
            if isolated:
                self.canvas.remember_pose()
            else:
                self.canvas.return_to_pose()

    def _move(
        self,
        id: str,
        text: str,
        keys: str,
        help: str,
        handle: Callable[[], object],
        enabled: Callable[[], bool] = lambda: True,
        in_view: bool = False,
    ) -> Action:
        """An action that moves the camera from where it is."""
        return Action(
            id=id,
            text=text,
            menu="View/Camera",
            part=1,
            keys=keys,
            help=help,
            handle=handle,
            enabled=lambda: self._ready() and enabled(),
            in_view=in_view,
        )

    def copy(self) -> None:
        """Copy where the camera stands, as `hexmend render --camera` takes it."""
        QGuiApplication.clipboard().setText(camera_text(Camera.at(self.canvas.pose)))
        self.host.messages.show_info("The camera was copied: paste it in another window, or after render --camera.")

    def paste(self) -> None:
        """Look from where the text that was copied says; or say what is wrong with it."""
        try:
            camera = camera_from(QGuiApplication.clipboard().text())
        except ParameterError as error:
            self.host.messages.show_error("The camera cannot be pasted", f"{error}.")
            return
        self._look_through(camera)

    def ask_name(self) -> None:
        """Ask what to call where the camera stands, and keep it."""
        name = ask_camera_name(self.host.dialog_parent, self._cameras.all)
        if name:
            self.keep(name)

    def keep(self, name: str) -> None:
        """Keep where the camera stands under a name, or say why not."""
        camera = Camera.at(self.canvas.pose)
        done = f"The camera is kept as “{name}”: View > Camera has it, and so have pictures."
        self.host.try_and_report("The camera was not kept", lambda: self._cameras.keep(name, camera), done)

    def go(self, name: str) -> None:
        """Apply a saved camera."""
        if self._draws and name in self._cameras.all:
            self._look_through(self._cameras.all[name])

    def show_cameras(self) -> None:
        """Show the cameras that are kept, to be gone to, renamed and deleted."""
        dialog = self.cameras_dialog()
        dialog.exec()
        dialog.deleteLater()

    def cameras_dialog(self) -> CamerasDialog:
        """Return the dialog that applies, renames and deletes saved cameras."""
        dialog = CamerasDialog(self._cameras, self.host.dialog_parent)
        dialog.chosen.connect(self.go)
        return dialog

    def _look_through(self, camera: Camera, journey: PoseHistoryData | None = None) -> None:
        if camera.pose is not None:
            self.canvas.set_pose(camera.pose, journey)
        else:
            self.canvas.set_up(camera.up)
            self.canvas.set_parallel(camera.parallel)
            self.canvas.look_along(camera.direction)

    @property
    def _draws(self) -> bool:
        """True if the view has drawn the open mesh."""
        frame = None if self.canvas is None else self.canvas.viewport.frame
        return frame is not None and self.session.document.is_open and frame.mesh is self.session.document.now.mesh

    def _stand(self) -> CameraPose | None:
        """Return the current pose of the camera."""
        return self.canvas.pose if self._draws else None

    def _journey(self) -> PoseHistoryData:
        """Return the history of poses."""
        return self.canvas.journey if self._draws else self.session.camera_request.journey

    def _ready(self) -> bool:
        return self.canvas is not None

    @property
    def _plane(self) -> object:
        """The plane of the cut that is moved; None where there is none."""
        clip = self.session.view.look.clip
        return clip.planes[self.session.view.plane_at] if isinstance(clip, PlaneClip) else None

    def _face(self) -> None:
        self.canvas.face(self._plane)

    def _fly(self, hexes: tuple[int, ...]) -> None:
        if self.canvas is not None and self.session.document.is_open:
            if self.session.view.look.isolation is not None:
                self.canvas.remember_pose()
            self.canvas.fly_to(*hexes)
