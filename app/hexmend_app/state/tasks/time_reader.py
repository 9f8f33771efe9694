"""Reading of the times of an OpenFOAM case in the background: the moved meshes become iterations of a record."""

from __future__ import annotations

from functools import partial
from pathlib import Path

import numpy as np
from PySide6.QtCore import QObject, Signal

from hexmend.errors import FileError
from hexmend.io.formats.openfoam import find_case
from hexmend.iteration import Iteration
from hexmend.quality import measure
from hexmend_app.state.mesh.document import Document, State
from hexmend_app.state.mesh.run_record import CONSTANT, TIME, RunRecord
from hexmend_app.state.run.timeline import Timeline
from hexmend_app.state.tasks.task import Task, drop

#: Title of the record.
TITLE = "Times of the case"


def _read(path: Path, state: State, task: Task) -> None:
    """Report the mesh at each time of a case, as (Iteration, Path), or the error of its file."""
    try:
        _read_all(path, state, task)
    except Exception as error:  # of any kind, such as a folder that must not be read: the open mesh is of use without
        task.report(FileError(path, f"its times cannot be read ({type(error).__name__}: {error})"))


def _read_all(path: Path, state: State, task: Task) -> None:
    from hexmend.io.formats.openfoam.times import read_times  # with the reader, which other formats do not need

    mesh, number, before = state.mesh, 0, state.mesh.points
    for time in read_times(path, mesh.n_nodes):
        if task.cancelled.is_set():
            return
        if time.error is not None:
            task.report(time.error)
            continue
        number += 1
        move = float(np.linalg.norm(time.points - before, axis=1).max()) / (mesh.mean_edge_length or 1.0)
        quality, label = measure(time.points, mesh.hexes), {TIME: f"{time.value:.12g}"}
        task.report((Iteration(number, time.points, quality, time.value, move, label), time.path))
        before = time.points


class TimeReader(QObject):
    """Records the times of a case whose mesh was opened, at which its points are stored.

    The mesh in constant is number 0. Node positions are stored within the memory limit of the history.

    Parameters
    ----------
    document : Document
    timeline : Timeline

    Signals
    -------
    progressed(str)
        Another time was read; the argument names it.
    ended(tuple of FileError)
        All times were read; the errors tell which are left out.
    """

    progressed = Signal(str)
    ended = Signal(object)

    def __init__(self, document: Document, timeline: Timeline, parent: QObject | None = None):
        super().__init__(parent)
        self._document, self._timeline, self._history = document, timeline, timeline.history
        self._state: State | None = None  # of the mesh in constant
        self._record: RunRecord | None = None
        self._errors: list[FileError] = []
        self._task: Task | None = None
        document.mesh_replaced.connect(self.close)

    @property
    def busy(self) -> bool:
        """True while times are being read."""
        return self._task is not None

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
        self._state, self._record, self._errors = self._document.now, None, []
        self._task = Task(f"reading the times of {path.name}", partial(_read, path, self._state), yields=True)
        self._task.reported.connect(self._add)
        self._task.ended.connect(self._finish)
        self._task.start()

    def close(self) -> None:
        """Cancel the reading; the times read so far stay, unless another mesh is opened."""
        drop(self._task)
        self._task = self._state = self._record = None

    def cancel(self) -> None:
        """Cancel the reading, and keep the times that were read."""
        if self.busy:
            self.close()
            self.ended.emit(tuple(self._errors))

    def _add(self, report: tuple[Iteration, Path] | FileError) -> None:
        if isinstance(report, FileError):
            self._errors.append(report)
            return
        iteration, path = report
        if self._record is None:
            self._record = self._history.begin(TITLE, self._state)
            self._history.add(
                self._record, Iteration(0, self._state.mesh.points, self._state.figures, 0.0, 0.0, {TIME: CONSTANT})
            )
        self._record.files[iteration.number] = path
        self._history.add(self._record, iteration)
        self._timeline.update_runs()
        self.progressed.emit(self._record.label(iteration.number))

    def _finish(self) -> None:
        self._task = self._state = self._record = None
        self.ended.emit(tuple(self._errors))
