"""Saving the mesh."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path

import numpy as np

from hexmend.doctor.nodes import extract_hexes
from hexmend.errors import FileError, HexmendError
from hexmend.io import unsupported_data
from hexmend.io.storage.file_progress import FileProgress
from hexmend_app.feature import Action, Feature, Host
from hexmend_app.formats.session import SUFFIX
from hexmend_app.state.mesh.document import MeasuredMesh
from hexmend_app.state.mesh.mesh_place import mesh_place
from hexmend_app.state.run.run_controller import Phase
from hexmend_app.state.tasks.mesh_saver import SaveTask, original_for
from hexmend_app.translation import tr
from hexmend_app.widgets.dialogs.questions import Answer, ask_mesh_target, ask_rewrite, ask_session, ask_unsaved


class FeatureSave(Feature):
    """Saves the mesh, and asks before unsaved changes are lost."""

    def __init__(self, host: Host):
        super().__init__(host)
        self._anew = False  # the file chosen last is written anew, not by replacing its coordinates
        saver = self.session.saver
        saver.began.connect(self._on_began)
        saver.progressed.connect(self._on_progressed)
        saver.ended.connect(self._on_ended)
        saver.failed.connect(self._on_failed)

    def actions(self) -> Iterable[Action]:
        """Yield the actions that save the mesh."""
        yield Action(
            id="save",
            text=tr("&Save"),
            menu="File",
            section=1,
            keys="Ctrl+S",
            icon="content-save-outline",
            help=tr("Save the displayed mesh, or the session, to the file chosen last; the first time, choose one."),
            tool=tr("Save"),
            handle=self.save,
            enabled=self._savable,
        )
        yield Action(
            id="save_as",
            text=tr("Save mesh &as…"),
            menu="File",
            section=1,
            keys="Ctrl+Shift+S",
            help=tr("Save the displayed mesh to another file."),
            handle=self.ask_mesh,
            enabled=lambda: self.session.run.phase is not Phase.RUNNING,
        )
        yield Action(
            id="save_visible",
            text=tr("Save &visible hexes as…"),
            menu="File",
            section=1,
            help=tr("Save the hexes that the view shows as a mesh: after cut, filters, isolation and hiding."),
            handle=self.ask_visible,
            enabled=self._can_save_visible,
        )

    def confirm_close(self) -> bool:
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
            return self.host.wait_until(stopping, lambda: not session.run.busy) and self._save_before_leaving()
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

    def _ask_path(self, title: str, purpose: str) -> str:
        """Ask for a path for a mesh, with the purpose in the proposed name, and the suffix of the open file."""
        source, stem = self.session.document.path, f"{self.host.default_file_stem}-{purpose}"
        return ask_mesh_target(self.host.dialog_parent, title, stem, source.suffix if source is not None else ".vtu")

    def _savable(self) -> bool:
        target, session = self.session.document.target, self.session
        if target is None or target.suffix.lower() != SUFFIX:
            return session.run.phase is not Phase.RUNNING
        return session.savable

    def save(self) -> None:
        """Save to the file chosen last, in the background, or ask for one."""
        target = self.session.document.target
        if target is None:
            self.ask_mesh()
        else:
            self.session.commands.save_in_background(target, self._anew)

    def ask_mesh(self) -> None:
        """Ask for a path and save the mesh in the background."""
        path = self._ask_path(tr("Save mesh as"), "smoothed")
        if path and (rewrite := self._ask_rewrite(Path(path))) is not None:
            self._anew = rewrite
            self.session.commands.save_in_background(path, rewrite)

    def save_and_wait(self, path: str | Path) -> bool:
        """Save the mesh, or the session if the path has its suffix, and wait; return True if it was written."""
        rewrite = self._anew and path == self.session.document.target
        saving = self.session.commands.save_in_background(path, rewrite)
        completed = self.host.wait_until(f"Saving {saving.path.name}…", lambda: saving.over)
        return completed and saving.error is None

    def ask_visible(self) -> None:
        """Ask for a path and save the hexes that the view shows."""
        path = self._ask_path(tr("Save visible hexes as"), "visible")
        if path:
            self.save_visible(Path(path))

    def save_visible(self, path: Path) -> None:
        """Save the hexes that the view shows in the background; those that a smooth cut shows in part, as a whole."""
        mesh, shown = self.session.document.now.mesh, self.canvas.viewport.remaining_after_cut()
        shown = np.ones(mesh.n_elements, bool) if shown is None else shown
        if shown.any():
            part = MeasuredMesh.of(extract_hexes(mesh, shown))
            self.session.saver.save(SaveTask(path, part, part, None, rewrite=True))
        else:
            self.host.messages.show_error(tr("No hex is visible"), tr("Show the hexes that are to be saved first."))

    def _can_save_visible(self) -> bool:
        drawn = self.canvas is not None and self.canvas.viewport.frame is not None
        return drawn and self.session.run.phase is not Phase.RUNNING

    def _ask_rewrite(self, path: Path) -> bool | None:
        """Ask whether a file that exists is written anew, if its coordinates could be replaced; None if cancelled."""
        document = self.session.document
        try:
            original = original_for(path, document.originals)
            lost = unsupported_data(path, document.now.mesh)
        except FileError:  # for a folder there is no choice; saving reports an unknown suffix
            return False
        asks = original is not None and mesh_place(path).exists()
        return asks and ask_rewrite(self.host.dialog_parent, path, original.path, lost)

    def _save_before_leaving(self) -> bool:
        """Save to the file chosen last, or ask for one, and wait; return True if it was saved."""
        path: str | Path | None = self.session.document.target
        if path is None and self._in_session:
            path = ask_session(self.host.dialog_parent, self.host.default_file_stem)
        elif path is None:
            path = self._ask_path(tr("Save mesh as"), "smoothed")
        return bool(path) and self.save_and_wait(path)

    def _on_began(self, saving: SaveTask) -> None:
        self.host.busy.show_work("save", tr("Saving {name}…", name=saving.path.name))

    def _on_progressed(self, saving: SaveTask, progress: FileProgress) -> None:
        text = tr("Saving {name}: {done}…", name=saving.path.name, done=progress.phrase)
        self.host.busy.show_work("save", text, share=progress.share)

    def _on_ended(self, saving: SaveTask) -> None:
        self.host.busy.done("save")
        place = mesh_place(saving.path)
        words = tr("Saved to {path}", path=place)
        if saving.data is not None:
            words = tr("Session saved to {path}", path=place)
        elif saving.written is not None and saving.written.replaced:
            words = tr("Coordinates replaced in {path}; everything else is unchanged", path=place)
        self.host.messages.show_written(words, place)
        if saving.written is not None:
            for note in saving.written.notes:
                self.host.messages.show_warning(tr("Saved with a note"), note)
        if saving.omitted:
            remedy = tr(
                "A {suffix} file cannot store {count}. Save as .vtu to store more.",
                suffix=saving.path.suffix,
                count=", ".join(saving.omitted),
            )
            self.host.messages.show_warning(tr("Some data was not saved"), remedy)

    def _on_failed(self, saving: SaveTask) -> None:
        self.host.busy.done("save")
        if not isinstance(saving.error, HexmendError):
            raise saving.error
        content = "mesh" if saving.data is None else "session"
        self.host.messages.show_error(tr("The {content} was not saved", content=content), str(saving.error))
