"""Coordinates of a Gmsh file in its section $Nodes."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from hexmend.io.base.cursor import ByteCursor
from hexmend.io.coordinates.binary_coordinates import ALL_COLUMNS, BinaryCoordinates, BinaryPiece
from hexmend.io.coordinates.located import CoordinatesError, LocatedCoordinates
from hexmend.io.coordinates.text_coordinates import TextCoordinates, fields_of_words, word_ranges
from hexmend.io.formats.gmsh.reader import READERS, read_format, skip_section
from hexmend.io.formats.gmsh.sections import Sections


def locate(path: Path) -> LocatedCoordinates:
    """Find the coordinates of a file that the reader has accepted."""
    source, sections = ByteCursor(path, path.read_bytes()), Sections()
    version, order = 1, ""
    while not source.at_end:
        key, begin = source.next_line(), source.pos
        if key == "$MeshFormat":
            version, order = read_format(source)
        elif key in ("$NOD", "$Nodes"):
            READERS[version][key](source, order, sections)
            return _binary(source, order, sections) if order else _text(source, begin, sections)
        else:
            skip_section(source, key)
    raise CoordinatesError("it has no section $Nodes")


def _text(source: ByteCursor, begin: int, sections: Sections) -> TextCoordinates:
    """Coordinates among the words of a text from an offset on."""
    first, last = word_ranges(source.data, begin, source.pos)
    rows = [(at + stride * np.arange(count))[:, None] + np.arange(3) for at, count, stride in sections.places]
    words = np.concatenate([np.zeros((0, 3), np.int64), *rows])
    return TextCoordinates(source.data, sections.points, fields_of_words(first[words], last[words]))


def _binary(source: ByteCursor, order: str, sections: Sections) -> BinaryCoordinates:
    pieces, first, dtype = [], 0, np.dtype(f"{order}f8")
    for at, count, stride in sections.places:
        pieces.append(BinaryPiece(at, dtype, (stride, dtype.itemsize), slice(first, first + count), ALL_COLUMNS))
        first += count
    return BinaryCoordinates(source.path, sections.points, tuple(pieces))
