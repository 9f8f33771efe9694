"""Coordinates of an LS-DYNA deck in the columns of *NODE, also of files that it includes."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from hexmend.io.coordinates.joined_files import JoinedFiles
from hexmend.io.coordinates.text_coordinates import Edits, shortened
from hexmend.io.formats.lsdyna.deck import Keyword, join, keywords
from hexmend.io.formats.lsdyna.reader import NODE_COLUMNS
from hexmend.io.storage.atomic import AtomicFiles

_DIGITS = "Fields of 16 columns hold 9 to 14 digits of the new coordinates."


def locate(path: Path) -> DynaCoordinates:
    """Find the coordinates of a file that the reader has accepted."""
    files = join(path)
    nodes = [keyword for keyword in keywords(files) if keyword.name == "NODE"]
    return DynaCoordinates(files, nodes, np.concatenate([one.cards(NODE_COLUMNS).reals(1, 4) for one in nodes]))


@dataclass(frozen=True, eq=False)
class DynaCoordinates:
    """Coordinates of all nodes, see `hexmend.io.coordinates.located.LocatedCoordinates`.

    Parameters
    ----------
    files : JoinedFiles
    nodes : list of Keyword
        Those named *NODE.
    points : (n, 3) float64
    """

    files: JoinedFiles
    nodes: list[Keyword]
    points: np.ndarray

    def write(self, files: AtomicFiles, target: Path, points: np.ndarray) -> tuple[str, ...]:
        """Write the deck and its files with new coordinates; see `LocatedCoordinates.write`."""
        rows: list[tuple[int, int, bytes]] = []
        first, exact = 0, True
        for keyword in self.nodes:
            begin, end, free = keyword.ranges(NODE_COLUMNS)
            own = slice(first, first + len(begin))
            first = own.stop
            for node, axis in np.argwhere(~(points[own] == self.points[own])).tolist():
                value, low, high = float(points[own][node, axis]), int(begin[node, axis + 1]), int(end[node, axis + 1])
                width = 0 if free[node] else (20 if keyword.is_long else 16)
                text = repr(value) if len(repr(value)) < (width or 21) else shortened(value, (width or 21) - 1)
                exact = exact and float(text) == value
                rows.append((low, high, text.rjust(width).encode()))
        notes = self.files.write(files, target, Edits.of(rows))
        return notes if exact else (*notes, _DIGITS)
