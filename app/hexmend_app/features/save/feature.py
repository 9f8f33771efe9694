"""Saving the mesh and the view: asked where, written, and said so, or said why not."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from hexmend.io.session import SUFFIX
from hexmend_app.feature import Action, Feature, Host
from hexmend_app.features.save.picture_dialog import PictureDialog
from hexmend_app.state.run import Phase
from hexmend_app.widgets.questions import Answer, ask_session, ask_target, ask_unsaved


class FeatureSave(Feature):
    """Writes the mesh and pictures of it, and asks before what is unsaved is lost."""

    order = 11

    def __init__(self, host: Host):
        super().__init__(host)

    def actions(self) -> Sequence[Action]:
        """Save, and the picture."""
        return (
            Action(
                id="save",
                text="&Save mesh as…",
                menu="File",
                part=1,
                keys="Ctrl+S",
                icon="content-save-outline",
                help="Save the mesh as it is now.",
                tool="Save",
                handle=self.ask_mesh,
                enabled=lambda: self.session.smoothing.phase is not Phase.RUNNING,
            ),
            Action(
                id="screenshot",
                text="Save &picture…",
                menu="File",
                part=1,
                keys="Ctrl+P",
                icon="camera-outline",
                help="Save the view as a picture, at any size.",
                tool="Picture",
                handle=self.ask_picture,
                enabled=lambda: self.canvas is not None,
                in_view=True,
            ),
        )

    def may_leave(self) -> bool:
        """Whether what is unsaved was saved or may be lost."""
        session = self.session
        session.stepping.leave()
        if not session.document.modified and not session.smoothing.busy:
            return True
        answer = ask_unsaved(self.host.window, session.document.name)
        if answer is Answer.SAVE:
            session.smoothing.end_now()
            return self.ask_mesh()
        return answer is Answer.DISCARD

    def ask_mesh(self) -> bool:
        """Ask where the mesh goes and write it, or the session that was opened; whether it was."""
        opened = self.session.document.path
        ask = ask_session if opened is not None and opened.suffix.lower() == SUFFIX else ask_target
        path = ask(self.host.window, self.host.stem)
        return bool(path) and self.mesh(path)

    def mesh(self, path: str | Path) -> bool:
        """Write the mesh as it is now; whether it was."""
        left_out: list[str] = []
        save = self.session.commands.save
        saved = self.host.said("The mesh was not saved", lambda: left_out.extend(save(path)), f"Saved to {path}")
        if left_out:
            self.host.messages.show_warning(
                "Not all is in it",
                f"A {Path(path).suffix} file cannot hold {', '.join(left_out)}. Save as .vtu to keep more.",
            )
        return saved

    def ask_picture(self) -> None:
        """Ask how large the picture is to be and where it goes, and write it."""
        size = self.canvas.size() * self.host.window.devicePixelRatioF()
        dialog = PictureDialog(size, f"{self.host.stem}.png", self.host.window)
        if dialog.exec():
            self.picture(dialog.path(), dialog.picture_size(), dialog.transparent())

    def picture(self, path: str | Path, size: tuple[int, int], transparent: bool = False) -> bool:
        """Write the view as PNG of `size` pixels; whether it was."""
        return self.host.said(
            "The picture was not saved",
            lambda: self.canvas.save_picture(Path(path), size, transparent),
            f"Picture of {size[0]} × {size[1]} pixels saved to {path}",
        )
