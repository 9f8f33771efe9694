"""Saving the mesh and the view: asked where, written, and said so, or said why not."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

from hexmend.errors import HexmendError
from hexmend.io.formats.session import SUFFIX
from hexmend.run.recipe import Recipe
from hexmend_app.feature import Action, Feature, Host
from hexmend_app.features.save.picture_dialog import PictureDialog
from hexmend_app.state.deeds import Wrote, moved_since
from hexmend_app.state.document import State
from hexmend_app.state.mesh_saver import Saving
from hexmend_app.state.run import Phase
from hexmend_app.state.scene import Page, Scene, write_scene
from hexmend_app.state.scene.carried import Pictured, carrying
from hexmend_app.widgets.questions import Answer, ask_session, ask_target, ask_unsaved


class FeatureSave(Feature):
    """Writes the mesh and pictures of it, and asks before what is unsaved is lost."""

    order = 11

    def __init__(self, host: Host):
        super().__init__(host)
        self._last: Scene | None = None  # what the last picture was like
        saver = self.session.saver
        saver.began.connect(self._on_began)
        saver.ended.connect(self._on_ended)
        saver.failed.connect(self._on_failed)

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
        """Whether what is unsaved was saved or may be lost; what is being saved is waited for."""
        session = self.session
        session.stepping.leave()
        if session.saver.busy and not self._wait_for_saving():
            return False
        if not session.modified and not session.smoothing.busy:
            return True
        of_mesh = session.document.modified or session.smoothing.busy
        answer = ask_unsaved(self.host.dialog_parent, session.document.name, of_mesh)
        if answer is Answer.SAVE:
            session.smoothing.stop()
            over = "The run ends after this iteration."
            return self.host.wait_until(over, lambda: not session.smoothing.busy) and self._ask_before_leaving()
        return answer is Answer.DISCARD

    def _wait_for_saving(self) -> bool:
        saver = self.session.saver
        text = f"{saver.path.name} is being saved. If it is not waited for, it may not be written."
        return self.host.wait_until(text, lambda: not saver.busy, "Do not wait")

    def ask_mesh(self) -> None:
        """Ask where the mesh goes, and begin to write it."""
        path = ask_target(self.host.dialog_parent, self.host.stem)
        if path:
            self.session.commands.save_in_background(path)

    def _ask_before_leaving(self) -> bool:
        """Ask where the mesh goes, or the session where one is open, and write it; whether it was."""
        opened = self.session.document.path
        ask = ask_session if opened is not None and opened.suffix.lower() == SUFFIX else ask_target
        path = ask(self.host.dialog_parent, self.host.stem)
        return bool(path) and self.save_and_wait(path)

    def _on_began(self, saving: Saving) -> None:
        self.host.busy.show_work("save", f"Saving {saving.path.name}…")

    def _on_ended(self, saving: Saving) -> None:
        self.host.busy.done("save")
        self.host.messages.show_info(f"{'Saved' if saving.data is None else 'Session saved'} to {saving.path}")
        if saving.omitted:
            self.host.messages.show_warning(
                "Not all is in it",
                f"A {saving.path.suffix} file cannot hold {', '.join(saving.omitted)}. Save as .vtu to keep more.",
            )

    def _on_failed(self, saving: Saving) -> None:
        self.host.busy.done("save")
        if not isinstance(saving.error, HexmendError):
            raise saving.error
        what = "mesh" if saving.data is None else "session"
        self.host.messages.show_error(f"The {what} was not saved", str(saving.error))

    def ask_picture(self) -> None:
        """Ask what the picture is to be like and where it goes, and write it."""
        dialog = self.picture_dialog()
        if dialog.exec():
            self._last = dialog.scene()
            self.session.cameras.take_in(self._last.cameras)
            self.write_picture(dialog.target.path(), self._last)
        dialog.deleteLater()

    def picture_dialog(self) -> PictureDialog:
        """The dialog that edits the scene of what is seen: page, lines, bar and axes are as they were last."""
        canvas, last = self.canvas, self._last
        size = canvas.size() * self.host.dialog_parent.devicePixelRatioF()
        page = Page(pixels=(size.width(), size.height())) if last is None else last.page
        scene = canvas.scene(page, self.session.cameras.all)
        if last is not None:
            lines = scene.lines if 0 in (scene.lines.edges, last.lines.edges) else last.lines
            scene = replace(scene, lines=lines, bar=last.bar, axes=last.axes)
        names = canvas.names if len(scene.panels) > 1 else ()
        dialog = PictureDialog(scene, canvas.sheet, size, f"{self.host.stem}.png", names, self.host.dialog_parent)
        dialog.scene_kept.connect(lambda *kept: self.session.commands.done.emit(Wrote("scene", write_scene, kept)))
        return dialog

    def picture(self, path: str | Path, size: tuple[int, int], transparent: bool = False) -> bool:
        """Write the view as a picture of `size` pixels; whether it was."""
        page = Page(pixels=size, background="transparent" if transparent else "white")
        return self.write_picture(Path(path), self.canvas.scene(page, self.session.cameras.all))

    def _recipe(self) -> Recipe | None:
        """What ran on the mesh that is shown."""
        session = self.session
        work = session.smoothing.work
        if work is None or session.document.now is session.document.start:
            return None
        begun = session.order.begun
        return work if isinstance(work, Recipe) else Recipe.of(begun if begun is not None else work)

    def write_picture(self, path: Path, scene: Scene) -> bool:
        """Write a scene of what is seen; whether it was."""
        width, height = scene.page.size
        written = self.host.said(
            "The picture was not saved",
            lambda: self.canvas.sheet(scene).write(path, self._carried(path, scene)),
            f"Picture of {width} × {height} pixels saved to {path}",
        )
        if written:
            self.session.commands.done.emit(self._told(path, scene))
        return written

    def _carried(self, path: Path, scene: Scene) -> dict[str, str]:
        """What a picture carries: the scene, which meshes it shows, and what ran on the first of them."""
        document = self.session.document
        opened = document.start.mesh
        meshes = [Pictured.of(opened, one.mesh, document.path, path) for one in self._shown]
        return carrying(scene, meshes, self._recipe())

    @property
    def _shown(self) -> list[State]:
        """What the views show, that of the mesh as it is now first."""
        return [self.session.document.now, *(one.state for one in self.session.views.all)]

    def _told(self, path: Path, scene: Scene) -> Wrote:
        """The call that draws the same."""
        from hexmend_app.scene.export.still import write_picture

        document, recipe = self.session.document, self._recipe()
        options: dict[str, Any] = {"opened": document.start}
        if document.path is not None:
            options["files"] = [document.path] * len(self._shown)
        if recipe is not None:
            options["recipe"] = recipe
        options |= moved_since(self.canvas.viewport.frame.movement, document.start)
        names = self.canvas.names if self.session.views.all else [""]
        return Wrote("picture", write_picture, (path, scene, self._shown, names), options)
