"""Checkpoints of a long run: the mesh at its newest iteration, written beside the result from time to time."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from time import monotonic

from hexmend.errors import ParameterError
from hexmend.io import write
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
    """

    def __init__(self, output: str, minutes: float | None):
        if minutes is not None and not minutes > 0:
            raise ParameterError(f"--checkpoint {minutes:g} is out of bounds: expected a number of minutes above 0")
        path = Path(output)
        self.path = path.with_name(f"{path.stem}.checkpoint{path.suffix}")
        self._seconds = None if minutes is None else 60 * minutes
        self._last, self._written = monotonic(), False

    @property
    def due(self) -> bool:
        """True once it is time for another checkpoint."""
        return self._seconds is not None and monotonic() - self._last >= self._seconds

    def write(self, make: Callable[[], Mesh]) -> None:
        """Write the mesh that a function makes."""
        write(self.path, make())
        self._last, self._written = monotonic(), True

    def remove(self) -> None:
        """Remove the file of this run once its result is written."""
        if self._written:
            self.path.unlink(missing_ok=True)
