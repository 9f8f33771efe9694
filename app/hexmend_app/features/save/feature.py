"""Saving the mesh and pictures of the view."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

from hexmend.errors import FileError, HexmendError
from hexmend.io import unsupported_data
from hexmend.io.storage.file_progress import FileProgress
from hexmend.run.recipe import Recipe
from hexmend_app.feature import Action, Feature, Host
from hexmend_app.features.save.picture_dialog import PictureDialog
from hexmend_app.features.save.visible_saver import VisibleSaver, warn_of_omitted
from hexmend_app.formats.session import SUFFIX
from hexmend_app.picture import Page, Scene
from hexmend_app.picture.picture_metadata import PicturedMesh, with_metadata
from hexmend_app.state.run.run_controller import Phase
from hexmend_app.state.tasks.mesh_saver import SaveTask, original_for
from hexmend_app.translation import tr
from hexmend_app.widgets.dialogs.questions import Answer, ask_rewrite, ask_session, ask_target, ask_unsaved


class FeatureSave(Feature):
    """Saves the mesh and pictures, and asks before unsaved changes are lost."""

    order = 11

    def __init__(self, host: Host):
        super().__init__(host)
        self._last: Scene | None = None  # scene of the last picture
        self.visible = VisibleSaver(host)
        saver = self.session.saver
        saver.began.connect(self._on_began)
        saver.progressed.connect(self._on_progressed)
        saver.ended.connect(self._on_ended)
        saver.failed.connect(self._on_failed)

    def actions(self) -> Sequence[Action]:
        """Return the actions that save the mesh and a picture."""
        return (
            Action(
                id="save",
                text=tr("&Save mesh as…"),
                menu="File",
                part=1,
                keys="Ctrl+S",
                icon="content-save-outline",
                help=tr("Save the displayed mesh to a file."),
                tool=tr("Save"),
                handle=self.ask_mesh,
                enabled=lambda: self.session.run.phase is not Phase.RUNNING,
            ),
            Action(
                id="save_visible",
                text=tr("Save &visible hexes as…"),
                menu="File",
                part=1,
                help=tr("Save the hexes that the view shows as a mesh: after cut, filters, isolation and hiding."),
                handle=lambda: self.visible.ask(self.canvas.viewport),
                enabled=self._can_save_visible,
            ),
            Action(
                id="screenshot",
                text=tr("Save &picture…"),
                menu="File",
                part=1,
                keys="Ctrl+P",
                icon="camera-outline",
                help=tr("Save a picture of the view in any size."),
                tool=tr("Picture"),
                handle=self.ask_picture,
                enabled=lambda: self.canvas is not None,
                in_view=True,
            ),
        )

    def close(self) -> None:
        """Wait for no file any more."""
        self.visible.close()

    def may_leave(self) -> bool:
        """Wait for a save in progress and ask about unsaved changes; return True if leaving is allowed."""
        session = self.session
        session.end_previews()
        if session.saver.busy and not self._wait_for_saving():
            return False
        if not session.modified and not session.run.busy:
            return True
        of_mesh = session.document.modified or session.run.busy
        answer = ask_unsaved(self.host.dialog_parent, session.document.name, of_mesh, self._in_session)
        if answer is Answer.SAVE:
            session.run.stop()
            stopping = tr("The run stops after this iteration.")
            return self.host.wait_until(stopping, lambda: not session.run.busy) and self._ask_before_leaving()
        return answer is Answer.DISCARD

    @property
    def _in_session(self) -> bool:
        """True if the mesh was opened from a session file."""
        source = self.session.document.path
        return source is not None and source.suffix.lower() == SUFFIX

    def _wait_for_saving(self) -> bool:
        saver = self.session.saver
        text = tr("{file} is being saved. If you close now, the file may be incomplete.", file=saver.path.name)
        return self.host.wait_until(text, lambda: not saver.busy, tr("Close anyway"))

    def ask_mesh(self) -> None:
        """Ask for a path and save the mesh in the background."""
        source = self.session.document.path
        path = ask_target(self.host.dialog_parent, self.host.stem, source.suffix if source is not None else ".vtu")
        if path and (rewrite := self._ask_rewrite(Path(path))) is not None:
            self.session.commands.save_in_background(path, rewrite)

    def _can_save_visible(self) -> bool:
        drawn = self.canvas is not None and self.canvas.viewport.frame is not None
        return drawn and self.session.run.phase is not Phase.RUNNING and not self.visible.going_on

    def _ask_rewrite(self, path: Path) -> bool | None:
        """Ask whether a file is written anew, if its coordinates could be replaced instead; None if cancelled."""
        document = self.session.document
        try:
            original = original_for(path, document.originals)
            lost = unsupported_data(path, document.now.mesh)
        except FileError:  # for a folder there is no choice; saving reports an unknown suffix
            return False
        return original is not None and ask_rewrite(self.host.dialog_parent, path, original.path, lost)

    def _ask_before_leaving(self) -> bool:
        """Ask for a path and save the mesh, or the session if a session is open; return True if it was saved."""
        ask = ask_session if self._in_session else ask_target
        path = ask(self.host.dialog_parent, self.host.stem)
        return bool(path) and self.save_and_wait(path)

    def _on_began(self, saving: SaveTask) -> None:
        self.host.busy.show_work("save", tr("Saving {name}…", name=saving.path.name))

    def _on_progressed(self, saving: SaveTask, progress: FileProgress) -> None:
        text = tr("Saving {name}: {done}…", name=saving.path.name, done=progress.phrase)
        self.host.busy.show_work("save", text, share=progress.share)

    def _on_ended(self, saving: SaveTask) -> None:
        self.host.busy.done("save")
        self.host.messages.show_info(
            self._saved_words(saving) if saving.data is None else tr("Session saved to {path}", path=saving.path)
        )
        if saving.written is not None:
            for note in saving.written.notes:
                self.host.messages.show_warning(tr("Saved with a note"), note)
        warn_of_omitted(self.host, saving.path, saving.omitted)

    def _saved_words(self, saving: SaveTask) -> str:
        """Tell whether the file is written anew, or keeps all but its coordinates."""
        if saving.written is None or not saving.written.replaced:
            return tr("Saved to {path}", path=saving.path)
        return tr("Coordinates replaced in {path}; everything else is unchanged", path=saving.path)

    def _on_failed(self, saving: SaveTask) -> None:
        self.host.busy.done("save")
        if not isinstance(saving.error, HexmendError):
            raise saving.error
        content = "mesh" if saving.data is None else "session"
        self.host.messages.show_error(tr("The {content} was not saved", content=content), str(saving.error))

    def ask_picture(self) -> None:
        """Ask for the settings and path of a picture, and write it."""
        dialog = self.picture_dialog()
        if dialog.exec():
            self._last = dialog.scene()
            self.session.saved_cameras.add_all(self._last.cameras)
            self.write_picture(dialog.target.path(), self._last)
        dialog.deleteLater()

    def picture_dialog(self) -> PictureDialog:
        """Return the dialog for a picture of the view, with the page, lines, colour bar and axes used last."""
        canvas, last = self.canvas, self._last
        size = canvas.size() * self.host.dialog_parent.devicePixelRatioF()
        page = Page(pixels=(size.width(), size.height())) if last is None else last.page
        scene = canvas.scene(page, self.session.saved_cameras.all)
        if last is not None:
            lines = scene.lines if 0 in (scene.lines.edges, last.lines.edges) else last.lines
            scene = replace(scene, lines=lines, bar=last.bar, axes=last.axes)
        names = canvas.names if len(scene.panels) > 1 else ()
        return PictureDialog(scene, canvas.draw_page, size, f"{self.host.stem}.png", names, self.host.dialog_parent)

    def picture(self, path: str | Path, size: tuple[int, int], transparent: bool = False) -> bool:
        """Write the view as a picture of `size` pixels; return True if it was written."""
        page = Page(pixels=size, background="transparent" if transparent else "white")
        return self.write_picture(Path(path), self.canvas.scene(page, self.session.saved_cameras.all))

    def _recipe(self) -> Recipe | None:
        """Return the recipe of the last run on the mesh, or None if the mesh is as it was opened."""
        session = self.session
        work = session.run.work
        if work is None or session.document.now is session.document.start:
            return None
        stage = session.run_setup.active_stage
        if isinstance(work, Recipe):
            return work
        return Recipe.of(stage if stage is not None else work, rules=session.run.record.rules)

    def write_picture(self, path: Path, scene: Scene) -> bool:
        """Write a picture of a scene; return True if it was written."""
        width, height = scene.page.size
        return self.host.try_and_report(
            tr("Picture not saved"),
            lambda: self.canvas.draw_page(scene).write(path, self._metadata(path, scene)),
            tr("Picture of {width} × {height} pixels saved to {path}", width=width, height=height, path=path),
        )

    def _metadata(self, path: Path, scene: Scene) -> dict[str, str]:
        """Return the metadata of a picture: the scene, its meshes, and the recipe of the first mesh."""
        document = self.session.document
        opened = document.start.mesh
        shown = [document.now, *(one.state for one in self.session.side_views.all)]
        meshes = [PicturedMesh.of(opened, state.mesh, document.path, path) for state in shown]
        return with_metadata(scene, meshes, self._recipe())
