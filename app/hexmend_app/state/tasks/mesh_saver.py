"""Saving of the mesh or the session in the background."""

from __future__ import annotations

from collections import deque
from collections.abc import Iterable
from functools import partial
from pathlib import Path

from PySide6.QtCore import QObject, Signal

from hexmend.io import Original, Written, replaces_coordinates, unsupported_data, write_as_given
from hexmend.io.storage.file_progress import FileProgress, watch_files
from hexmend_app.state.mesh.document import Document, MeasuredMesh
from hexmend_app.state.session import session_data
from hexmend_app.state.session.session_data import SessionData
from hexmend_app.state.tasks.file_watcher import FileWatcher
from hexmend_app.state.tasks.one_task import OneTask
from hexmend_app.state.tasks.task import Task
from hexmend_app.state.view.saved_cameras import SavedCameras


class SaveTask:
    """Writing of one file: the mesh or the session, as it was when the user saved it.

    Parameters
    ----------
    path : Path
    state : MeasuredMesh
        The state that was shown, which a mesh file contains.
    recorded : MeasuredMesh
        The state that counts as saved afterwards.
    data : SessionData or None
        The content of a session file; None for a mesh file.
    rewrite : bool
        Write a mesh file anew even if coordinates could be replaced in a copy of the file of the mesh.

    Attributes
    ----------
    omitted : list of str
        Data that the format of the written file does not support, or that the file as given does not hold.
    originals : tuple of Original
        Files that hold the mesh: saved in the format of one, only its coordinates change.
    original : Original or None
        The first of them that has the format of the written file.
    written : Written or None
        The way in which a mesh file was written.
    over : bool
        True once the file has been written or writing has failed.
    error : BaseException or None
        Error of writing, if it failed.
    """

    def __init__(
        self, path: Path, state: MeasuredMesh, recorded: MeasuredMesh, data: SessionData | None, rewrite: bool = False
    ):
        self.path, self.state, self.recorded, self.data, self.rewrite = path, state, recorded, data, rewrite
        self.omitted: list[str] = []
        self.originals: tuple[Original, ...] = ()
        self.original: Original | None = None
        self.written: Written | None = None
        self.over = False
        self.error: BaseException | None = None

    def write(self) -> None:
        """Write the file; if that raises `HexmendError`, an existing file is left unchanged."""
        if self.data is not None:
            session_data.write(self.path, self.data)
        else:
            self.original = None if self.rewrite else original_for(self.path, self.originals)
            self.written = write_as_given(self.path, self.state.mesh, self.original)
            self.omitted = unsupported_data(self.path, self.state.mesh)
            if self.written.replaced:  # what the mesh had when it was read is still in the file
                given = unsupported_data(self.path, self.original.mesh)
                self.omitted = [data for data in self.omitted if data not in given]


def original_for(path: Path, originals: Iterable[Original]) -> Original | None:
    """Return the first original file in whose copy coordinates are replaced if the mesh is written to a path."""
    return next((one for one in originals if replaces_coordinates(path, one)), None)


def _write(saving: SaveTask, task: Task) -> None:
    """Write a file and report the progress; a file that was begun is written to its end."""
    with watch_files(FileWatcher(task, lambda progress: progress, ends=False)):
        saving.write()


class MeshSaver(OneTask):
    """Writes meshes and sessions in the background, one after another.

    Parameters
    ----------
    document : Document
    cameras : SavedCameras

    Signals
    -------
    began(SaveTask)
        The file is being written.
    progressed(SaveTask, FileProgress)
        A part of a mesh file has been written.
    ended(SaveTask)
        The file is on disk, and its state counts as saved.
    failed(SaveTask)
        The file could not be written, see `SaveTask.error`.
    """

    began = Signal(object)
    progressed = Signal(object, object)
    ended = Signal(object)
    failed = Signal(object)

    def __init__(self, document: Document, cameras: SavedCameras, parent: QObject | None = None):
        super().__init__(parent)
        self._document, self._cameras = document, cameras
        self._waiting: deque[SaveTask] = deque()
        self._saving: SaveTask | None = None

    @property
    def path(self) -> Path | None:
        """Path of the file that is being written; None if there is none."""
        return None if self._saving is None else self._saving.path

    def save(self, saving: SaveTask) -> None:
        """Write a file when those before it are written."""
        self._waiting.append(saving)
        self._begin()

    def close(self) -> None:
        """Drop all files that are not written yet; the caller has waited for them or decided not to."""
        self._waiting.clear()
        super().close()
        self._saving = None

    def _begin(self) -> None:
        if self._saving is None and self._waiting:
            self._saving = saving = self._waiting.popleft()
            saving.originals = self._document.originals  # not earlier: a save before may have written one of them
            self._start(f"saving {saving.path.name}", partial(_write, saving))
            self.began.emit(saving)

    def _take(self, message: FileProgress) -> None:
        self.progressed.emit(self._saving, message)

    def _finish(self, task: Task) -> None:
        saving, self._saving = self._saving, None
        saving.error = task.error
        if saving.error is None:
            self._mark_saved(saving)
        saving.over = True
        (self.ended if saving.error is None else self.failed).emit(saving)
        self._begin()

    def _mark_saved(self, saving: SaveTask) -> None:
        """Mark the state as saved if its mesh is still open."""
        if self._document.mark_saved(saving.path, saving.recorded) and saving.data is not None:
            self._cameras.mark_saved(saving.data.saved_cameras)
