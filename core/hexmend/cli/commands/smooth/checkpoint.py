"""Checkpoints of a long run: the mesh at its newest iteration, written beside the result from time to time."""

from __future__ import annotations

import os
import sys
from collections.abc import Callable
from itertools import chain, count
from pathlib import Path
from time import monotonic

from hexmend.errors import FileError, ParameterError
from hexmend.io import write
from hexmend.io.files import remove
from hexmend.io.format_lookup import format_by_place
from hexmend.mesh.mesh import Mesh


class Checkpoints:
    """Writes meshes to one file, whole or not at all: a run goes on from it as from any mesh.

    Parameters
    ----------
    output : str
        File of the result; that of checkpoints is beside it.
    minutes : float or None
        Minutes between two of them; None for none.

    Raises
    ------
    ParameterError
        For minutes that are not positive.

    Attributes
    ----------
    path : Path
        OUTPUT.checkpoint.SUFFIX, with a number where there is such a file already: it may be the mesh of this run. A
        folder, as of OpenFOAM, has a checkpoint in VTU.
    """

    def __init__(self, output: str, minutes: float | None):
        if minutes is not None and not minutes > 0:
            raise ParameterError(f"--checkpoint {minutes:g} is out of bounds: expected a number of minutes above 0")
        self.path = _free_path(Path(output))
        self._seconds = None if minutes is None else 60 * minutes
        self._last, self._written = monotonic(), False

    @property
    def due(self) -> bool:
        """True once it is time for another checkpoint."""
        return self._seconds is not None and monotonic() - self._last >= self._seconds

    def write(self, make: Callable[[], Mesh]) -> None:
        """Write the mesh that a function makes; where that fails, a warning says so and the run goes on."""
        try:
            write(self.path, make())
            self.note_written()
        except (FileError, OSError) as error:
            self.note_failure(error)

    def note_written(self) -> None:
        """Take note that the checkpoint has been written, by this object or by several ranks."""
        self._written, self._last = True, monotonic()

    def note_failure(self, error: Exception, quiet: bool = False) -> None:
        """Print a warning that it could not be written, unless another process does."""
        if not quiet:
            print(f"hexmend: no checkpoint was written, and the run continues: {error}", file=sys.stderr, flush=True)
        self._last = monotonic()

    def remove(self) -> None:
        """Remove the file of this run once its result is written."""
        if self._written:
            remove(self.path)


def _free_path(output: Path) -> Path:
    """Return a name beside the output that no file has."""
    output = output if output.name else output.absolute()  # the case in the working folder
    suffix = output.suffix if format_by_place(output) is None and output.suffix else ".vtu"
    names = (f"{output.stem}.checkpoint{end}{suffix}" for end in chain([""], (f"-{number}" for number in count(2))))
    return next(path for path in map(output.with_name, names) if not os.path.lexists(path))
