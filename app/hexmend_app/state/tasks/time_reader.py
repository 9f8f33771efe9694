"""Reading of the times of an OpenFOAM case in the background: the moved meshes become iterations of a record."""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial
from pathlib import Path

import numpy as np
from PySide6.QtCore import QObject, Signal

from hexmend.errors import FileError
from hexmend.io.formats.openfoam import find_case
from hexmend.iteration import Iteration
from hexmend.quality import measure
from hexmend_app.state.mesh.document import Document, MeasuredMesh
from hexmend_app.state.mesh.history import History
from hexmend_app.state.mesh.run_record import CONSTANT, TIME, RunRecord
from hexmend_app.state.run.timeline import Timeline
from hexmend_app.state.tasks.one_task import OneTask
from hexmend_app.state.tasks.task import Task

#: Title of the record.
TITLE = "Case times"


def _read(path: Path, state: MeasuredMesh, task: Task) -> None:
    """Report each time of a case, an Iteration, or the FileError for which it is left out."""
    try:
        for read in case_times(path, state):
            if task.cancelled.is_set():
                return
            task.report(read)
    except Exception as error:  # of any kind, such as a folder that must not be read: the open mesh is of use without
        raise FileError(path, f"its times cannot be read ({type(error).__name__}: {error})") from error


class TimeReader(OneTask):
    """Records the times of a case whose mesh was opened, at which its points are stored.

    The mesh in constant is number 0. Node positions are stored within the memory limit of the history.

    Parameters
    ----------
    document : Document
    timeline : Timeline

    Attributes
    ----------
    errors : tuple of FileError
        Reasons why times are left out, once all have been read.

    Signals
    -------
    progressed
        Another time was read.
    ended
        All times were read, or the reading was cancelled.
    """

    progressed = Signal()
    ended = Signal()

    def __init__(self, document: Document, timeline: Timeline, parent: QObject | None = None):
        super().__init__(parent)
        self._document, self._timeline, self._history = document, timeline, timeline.history
        self._state: MeasuredMesh | None = None  # of the mesh in constant
        self._record: RunRecord | None = None
        self._found: list[FileError] = []
        self.errors: tuple[FileError, ...] = ()
        document.mesh_replaced.connect(self.close)

    @property
    def last_time(self) -> str:
        """Name of the time that was read last; "" if none is being read."""
        return "" if self._record is None else self._record.label(self._record.newest)

    def read(self, path: Path) -> None:
        """Start reading the times of a case; nothing happens for other files.

        Parameters
        ----------
        path : Path
            File or folder of the open mesh, which shows the state as read.
        """
        self.close()
        if find_case(path) is None:
            return
        self._state, self._found = self._document.now, []
        self._start(f"reading the times of {path.name}", partial(_read, path, self._state))

    def close(self) -> None:
        """Drop what is being read: the window closes, or another mesh is open."""
        super().close()
        self._state = self._record = None
        self.errors = ()

    def cancel(self) -> None:
        """End the reading, and keep the times that were read."""
        if self.busy:
            self.close()
            self.errors = tuple(self._found)
            self.ended.emit()

    def _take(self, message: Iteration | FileError) -> None:
        if isinstance(message, FileError):
            self._found.append(message)
            return
        if self._record is None:
            self._record = begin_times(self._history, self._state)
        self._history.add(self._record, message)
        self._timeline.update_runs()
        self.progressed.emit()

    def _finish(self, task: Task) -> None:
        if task.error is not None:
            self._found.append(task.error)  # type: ignore[arg-type]  # `_read` raises no other error
        self._state = self._record = None
        self.errors = tuple(self._found)
        self.ended.emit()


def case_times(path: Path, state: MeasuredMesh) -> Iterator[Iteration | FileError]:
    """Read and measure the mesh at each time of a case, in order.

    Parameters
    ----------
    path : Path
        The case; see `hexmend.io.formats.openfoam.find_case`.
    state : MeasuredMesh
        The mesh in constant.

    Yields
    ------
    Iteration or FileError
        Numbers from 1, with the time as seconds; the error of a time that is left out.
    """
    from hexmend.io.formats.openfoam.foam_text import read_times  # with the reader, which other formats do not need

    mesh, number, before = state.mesh, 0, state.mesh.points
    for time in read_times(path, mesh.n_nodes):
        if time.error is not None:
            yield time.error
            continue
        number += 1
        move = float(np.linalg.norm(time.points - before, axis=1).max()) / (mesh.mean_edge_length or 1.0)
        label, quality = {TIME: f"{time.value:.12g}"}, measure(time.points, mesh.elements)
        yield Iteration(number, time.points, quality, time.value, move, label)
        before = time.points


def begin_times(history: History, state: MeasuredMesh) -> RunRecord:
    """Add the record of a case to the history, with the mesh in constant as number 0, and return it."""
    record = history.begin(TITLE, state)
    history.add(record, Iteration(0, state.mesh.points, state.quality, 0.0, 0.0, {TIME: CONSTANT}))
    return record
