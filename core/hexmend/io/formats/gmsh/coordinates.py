"""Coordinates of a Gmsh file in its section $Nodes."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from hexmend.io.base.cursor import ByteCursor
from hexmend.io.coordinates.binary_coordinates import ALL_COLUMNS, BinaryCoordinates, BinaryPiece
from hexmend.io.coordinates.located import CoordinatesError, LocatedCoordinates
from hexmend.io.coordinates.text_coordinates import TextCoordinates, fields_of_words, word_ranges
from hexmend.io.formats.gmsh.reader import read_format, skip_section

#: Bytes of a binary node of version 2: a tag of 32 bits, and three coordinates.
_NODE_SIZE = 28


def locate(path: Path) -> LocatedCoordinates:
    """Find the coordinates of a file that the reader has accepted."""
    source = ByteCursor(path, path.read_bytes())
    version, order = 1, ""
    while not source.at_end:
        key = source.next_line()
        if key == "$MeshFormat":
            version, order = read_format(source)
        elif key == "$NOD":
            return _text(source, b"$ENDNOD", version)
        elif key == "$Nodes":
            if order:
                return _binary_2(source, order) if version == 2 else _binary_4(source, order)
            return _text(source, b"$EndNodes", version)
        else:
            skip_section(source, key)
    raise CoordinatesError("it has no section $Nodes")


def _text(source: ByteCursor, end: bytes, version: int) -> TextCoordinates:
    """Coordinates of a text."""
    begin = source.pos
    values = source.read_numbers_until("$Nodes", end, np.float64)
    first, last = word_ranges(source.data, begin, source.pos - len(end))
    words = _words_4(values) if version == 4 else np.arange(1, values.size, 4)[:, None] + [1, 2, 3]
    points = values[words] if words.size else np.zeros((0, 3))
    return TextCoordinates(source.data, points, fields_of_words(first[words], last[words]))


def _words_4(values: np.ndarray) -> np.ndarray:
    """Indices of the coordinates among the numbers of $Nodes of version 4, (n, 3) int64."""
    at, parts = 4, [np.zeros((0, 3), np.int64)]
    for _ in range(int(values[0])):
        dimension, _, parametric, count = values[at : at + 4].astype(np.int64).tolist()
        width = 3 + (dimension if parametric else 0)
        first = at + 4 + count
        parts.append((first + width * np.arange(count))[:, None] + np.arange(3))
        at = first + width * count
    return np.concatenate(parts)


def _binary_2(source: ByteCursor, order: str) -> BinaryCoordinates:
    """Coordinates of a binary file of version 2."""
    count = source.parse_count(source.next_line(), "the number of nodes")
    piece = BinaryPiece(source.pos + 4, np.dtype(f"{order}f8"), (_NODE_SIZE, 8), slice(0, count), ALL_COLUMNS)
    return _located(source, (piece,))


def _binary_4(source: ByteCursor, order: str) -> BinaryCoordinates:
    """Coordinates of a binary file of version 4."""
    blocks = int(source.read_binary("$Nodes", 1, 4, f"{order}u8")[0, 0])
    pieces, first = [], 0
    for _ in range(blocks):
        dimension, _, parametric = source.read_binary("$Nodes", 1, 3, f"{order}i4")[0].tolist()
        count = int(source.read_binary("$Nodes", 1, 1, f"{order}u8")[0, 0])
        width = 3 + (dimension if parametric else 0)
        source.read_binary("$Nodes", count, 1, f"{order}u8")
        rows = slice(first, first + count)
        pieces.append(BinaryPiece(source.pos, np.dtype(f"{order}f8"), (8 * width, 8), rows, ALL_COLUMNS))
        source.read_binary("$Nodes", count, width, f"{order}f8")
        first += count
    return _located(source, tuple(pieces))


def _located(source: ByteCursor, pieces: tuple[BinaryPiece, ...]) -> BinaryCoordinates:
    views = [piece.view(source.data).astype(np.float64) for piece in pieces]
    points = np.concatenate([np.zeros((0, 3)), *views])
    return BinaryCoordinates(source.path, points, pieces)
