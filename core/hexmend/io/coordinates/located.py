"""Interface of the coordinates of a file, which every format has that can replace them."""

from __future__ import annotations

from pathlib import Path
from typing import Protocol

import numpy as np

from hexmend.io.storage.atomic import AtomicFiles


class LocatedCoordinates(Protocol):
    """Coordinates of the nodes of a file, and their places in it.

    Attributes
    ----------
    points : (n, 3) float64
        Bit for bit as the reader of the format gives them to the mesh.
    """

    points: np.ndarray

    def write(self, files: AtomicFiles, target: Path, points: np.ndarray) -> tuple[str, ...]:
        """Write a copy of the file in which coordinates that differ from `points` are replaced.

        Parameters
        ----------
        files : AtomicFiles
            Takes the target, and files beside it that hold coordinates too. A case is written without it.
        target : Path
            Path that the user has named.
        points : (n, 3) float64
            New coordinates.

        Returns
        -------
        tuple of str
            Sentences for the user, such as a loss of digits.

        Raises
        ------
        CoordinatesError
            Where the file cannot hold these points.
        """


class CoordinatesError(Exception):
    """File whose coordinates cannot be replaced; the message is a reason such as "it holds other hexes"."""
