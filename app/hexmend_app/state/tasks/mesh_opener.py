"""Reading of meshes, sessions and pictures in the background."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum
from functools import partial
from pathlib import Path

from PySide6.QtCore import QObject, Signal

from hexmend.errors import HexmendError
from hexmend.io import read
from hexmend.io.storage.file_progress import FileProgress, watch_files
from hexmend.mesh.solid_cells import count_cells
from hexmend_app.picture.picture_metadata import is_png, read_metadata
from hexmend_app.state.mesh.document import Document, MeasuredMesh
from hexmend_app.state.session import session_data
from hexmend_app.state.session.restored_picture import MissingMesh, RestoredPicture, restore_picture
from hexmend_app.state.session.session_data import SessionData
from hexmend_app.state.tasks.file_watcher import FileWatcher
from hexmend_app.state.tasks.one_task import OneTask
from hexmend_app.state.tasks.task import Task


class LoadStage(Enum):
    """Stage of opening a mesh."""

    READING = "reading"
    MEASURING = "measuring"
    PREPARING = "preparing"


@dataclass(frozen=True)
class LoadProgress:
    """Progress of opening a file.

    Parameters
    ----------
    stage : LoadStage
    path : Path
    cells : str
        Number of cells; "" while it is unknown.
    file : FileProgress, optional
        Share of the file that is read, and the time left, while they are known.
    """

    stage: LoadStage
    path: Path
    cells: str = ""
    file: FileProgress | None = None


def _reading(progress: FileProgress) -> LoadProgress:
    """Progress of opening while a file is read."""
    return LoadProgress(LoadStage.READING, progress.path, file=progress)


def _open(
    path: Path, picture: MissingMesh | None, task: Task
) -> MeasuredMesh | SessionData | RestoredPicture | MissingMesh:
    """Read a mesh, a session, or the meshes of a picture, and report the progress of files."""
    with watch_files(FileWatcher(task, _reading, ends=True)):
        if picture is None and is_png(path):
            picture = MissingMesh(path, read_metadata(path))
            found = picture.metadata.first.candidates(path)
            if not found:
                return picture
            path = found[0]
        opened = _read(path, task)
        if picture is None:
            return opened
        states = [opened] if isinstance(opened, MeasuredMesh) else opened.states()
        return restore_picture(picture, path, states, lambda other: task.report(LoadProgress(LoadStage.READING, other)))


def _read(path: Path, task: Task) -> MeasuredMesh | SessionData:
    """Read, measure and prepare a mesh, reporting each stage; errors of any kind are raised as `HexmendError`."""
    try:
        task.report(LoadProgress(LoadStage.READING, path))
        if session_data.is_session_file(path):
            opened = session_data.read(path)
            mesh = opened.document.now.mesh
        else:
            mesh = read(path)
            task.report(LoadProgress(LoadStage.MEASURING, path, count_cells(mesh.elements)))
            opened = MeasuredMesh.of(mesh)  # type: ignore[assignment]
        task.report(LoadProgress(LoadStage.PREPARING, path, count_cells(mesh.elements)))
        _ = mesh.topology.face_neighbours, mesh.topology.layers  # the view needs them to draw
    except HexmendError:
        raise
    except Exception as error:  # an unexpected error of a reader must not crash the window
        raise HexmendError(f"{path.name}: cannot be read ({type(error).__name__}: {error}).") from error
    return opened


class MeshOpener(OneTask):
    """Opens meshes, sessions and pictures in the document.

    Signals
    -------
    began(Path)
    progressed(LoadProgress)
    mesh_read(Path)
        A mesh was read from a file of its own, rather than from a session, and opened in the document.
    loaded(SessionData, Path or None)
        A session was read, and is to be restored before `ended`. The path is None for a session that is recovered
        after a crash.
    restored(RestoredPicture)
        The mesh of a picture was opened in the document; its appearance is to be restored before `ended`.
    mesh_missing(MissingMesh)
        The mesh of a picture was not found: call `open` with its path and the picture.
    ended(Path)
        The mesh was opened in the document.
    cancelled(Path)
        The document is unchanged.
    failed(Path, Exception)
        The document is unchanged.
    """

    began = Signal(object)
    progressed = Signal(object)
    mesh_read = Signal(object)
    loaded = Signal(object, object)
    restored = Signal(object)
    mesh_missing = Signal(object)
    ended = Signal(object)
    cancelled = Signal(object)
    failed = Signal(object, object)

    def __init__(self, document: Document, parent: QObject | None = None):
        super().__init__(parent)
        self._document = document
        self._path: Path | None = None  # of the file that is being read
        self._next: tuple[Path, bool, MissingMesh | None] | None = None
        self._recovers = self._restoring = False

    @property
    def busy(self) -> bool:
        """True while a mesh is being read."""
        return self._task is not None or self._restoring

    def open(self, path: str | Path, *, recovers: bool = False, picture: MissingMesh | None = None) -> None:
        """Start reading a file; of the files requested while another is read, the last is opened next.

        Parameters
        ----------
        path : path-like
        recovers : bool
            True for an autosaved session: the mesh keeps the path of its own file and its unsaved changes.
        picture : MissingMesh, optional
            Picture that shows the mesh and whose appearance is restored.
        """
        path = Path(path)
        if self.busy:
            self._next = path, recovers, picture
            return
        self._path, self._recovers = path, recovers
        self._start(f"reading {path.name}", partial(_open, path, picture))
        self.began.emit(path)

    def cancel(self) -> None:
        """Drop what is being read: its thread ends when it next reports progress; other files can be opened at once."""
        if self._task is not None:
            self._next = None
            super().close()
            self.cancelled.emit(self._path)

    def close(self) -> None:
        """Cancel the opening: the window closes."""
        self.cancel()

    def _take(self, message: LoadProgress) -> None:
        self.progressed.emit(message)

    def _finish(self, task: Task) -> None:
        result = task.result
        if self._next is not None:
            (path, recovers, picture), self._next = self._next, None
            self.open(path, recovers=recovers, picture=picture)
        elif task.error is not None:
            self.failed.emit(self._path, task.error)
        elif isinstance(result, MissingMesh):
            self.mesh_missing.emit(result)
        else:
            self._show(result)
            self.ended.emit(self._document.path if self._recovers and self._document.path else self._path)

    def _show(self, result: MeasuredMesh | SessionData | RestoredPicture) -> None:
        """Show what was read in the document."""
        if isinstance(result, SessionData):
            self._restoring = True  # busy until it is restored: signals emitted meanwhile are no changes by the user
            self.loaded.emit(result, None if self._recovers else self._path)
            self._restoring = False
            return
        if isinstance(result, RestoredPicture):
            self._path = result.path
        self._document.replace(result.state if isinstance(result, RestoredPicture) else result, self._path)
        self.mesh_read.emit(self._path)
        if isinstance(result, RestoredPicture):
            self.restored.emit(result)
