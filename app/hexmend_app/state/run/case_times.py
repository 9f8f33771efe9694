"""Times of an OpenFOAM case as a record: the meshes that a solver has moved are its iterations."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import numpy as np

from hexmend.errors import FileError
from hexmend.iteration import Iteration
from hexmend.quality import measure
from hexmend_app.state.mesh.document import State
from hexmend_app.state.mesh.history import History, RunRecord
from hexmend_app.state.mesh.run_record import CONSTANT, TIME

#: Title of the record.
TITLE = "Case times"


def case_times(path: Path, state: State) -> Iterator[Iteration | FileError]:
    """Read and measure the mesh at each time of a case, in order.

    Parameters
    ----------
    path : Path
        The case; see `hexmend.io.formats.openfoam.find_case`.
    state : State
        The mesh in constant.

    Yields
    ------
    Iteration or FileError
        Numbers from 1, with the time as seconds; the error of a time that is left out.
    """
    from hexmend.io.formats.openfoam.moved_points import read_times  # with the reader, which other formats do not need

    mesh, number, before = state.mesh, 0, state.mesh.points
    for time in read_times(path, mesh.n_nodes):
        if time.error is not None:
            yield time.error
            continue
        number += 1
        move = float(np.linalg.norm(time.points - before, axis=1).max()) / (mesh.mean_edge_length or 1.0)
        label, quality = {TIME: f"{time.value:.12g}"}, measure(time.points, mesh.hexes)
        yield Iteration(number, time.points, quality, time.value, move, label)
        before = time.points


def begin_times(history: History, state: State) -> RunRecord:
    """Add the record of a case to the history, with the mesh in constant as number 0, and return it."""
    record = history.begin(TITLE, state)
    history.add(record, Iteration(0, state.mesh.points, state.figures, 0.0, 0.0, {TIME: CONSTANT}))
    return record
