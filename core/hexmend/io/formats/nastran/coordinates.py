"""Coordinates of a Nastran file in its GRID cards, of any layout.

A card in fields of 8 columns becomes a GRID* card in fields of 16 where 8 columns do not hold the new coordinates.

Text of a GRID card with other coordinates, in the layout that it has.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from hexmend.io.base.cursor import read_text_bytes
from hexmend.io.formats.nastran.bulk import BulkData
from hexmend.io.formats.nastran.cards import is_exact, real_field
from hexmend.io.formats.nastran.reader import BulkModel
from hexmend.io.storage.atomic import AtomicFiles
from hexmend.terminal_text import count_phrase

#: Columns of a field in the small and in the large layout, and fields of a line.
_SMALL, _LARGE = (8, 8), (16, 4)
#: Index of the first coordinate among the fields of a card: number, coordinate system, x, y, z.
_FIRST = 2


def replace_in_card(lines: Sequence[str], texts: Sequence[str | None]) -> list[str]:
    """Replace coordinates in the lines of a GRID card.

    Parameters
    ----------
    lines : sequence of str
        Its line without a line end, and for a card in fields of 16 columns the one that continues it, if there is one.
    texts : sequence of str or None
        New texts of x, y and z, of up to 16 characters; None for those that stay.

    Returns
    -------
    list of str
        One line or two.

    Examples
    --------
    >>> replace_in_card(["GRID    7               0.      0.      1."], ["0.25", None, None])
    ['GRID    7               0.25    0.      1.']
    >>> replace_in_card(["GRID,7,,0.,0.,1."], ["0.123456789", None, None])
    ['GRID*,7,,0.123456789,0.', '*,1.']
    """
    first = lines[0]
    if is_large(first):
        for k in range(2):
            first = _with_field(first, _FIRST + k, texts[k])
        second = [_with_field(line, 0, texts[2]) for line in lines[1:] or ["*"]]
        return [first, *(second if lines[1:] or texts[2] is not None else [])]
    fields, free = _fields(first), "," in first.partition("$")[0]
    in_place = all(len(text) <= 8 for text in texts if text is not None)
    if in_place or (free and any(len(text) > 8 for text in fields[_FIRST : _FIRST + 3])):
        for k, text in enumerate(texts):
            first = _with_field(first, _FIRST + k, text)
        return [first]
    return _widened(first, fields, texts)


def is_large(line: str) -> bool:
    """Return True for fields of 16 columns: the name ends in a star, or the continuation begins with one."""
    body = line.partition("$")[0]
    head = (body.split(",")[0] if "," in body else body.expandtabs(8)[:8]).strip()
    return head.endswith("*") or head.startswith("*")


def _fields(line: str) -> list[str]:
    """Name, the fields of a line of the small layout, and the name of its continuation: ten stripped texts."""
    body = line.partition("$")[0]
    if "," in body:
        parts = body.split(",")
    else:
        body = body.expandtabs(8)
        parts = [body[k : k + 8] for k in range(0, 80, 8)]
    parts = [part.strip() for part in parts]
    return (parts + [""] * 10)[1:9] + [(parts + [""] * 10)[9], parts[0]]


def _with_field(line: str, k: int, text: str | None) -> str:
    """Line with a new text in field k, counted after the name."""
    if text is None:
        return line
    body, mark, comment = line.partition("$")
    if "," in body:
        parts = body.split(",")
        parts += [""] * (k + 2 - len(parts))
        old = parts[k + 1]
        blanks = len(old) - len(old.lstrip())
        parts[k + 1] = old[:blanks] + text + (old[len(old.rstrip()) :] if old.strip() else "")
        return ",".join(parts) + mark + comment
    body = body.expandtabs(8) if "\t" in body else body
    width = (_LARGE if is_large(line) else _SMALL)[0]
    begin = 8 + width * k
    old, after = body[begin : begin + width].ljust(width), body[begin + width :]
    right = old.strip() and not old.endswith(" ") and old.startswith(" ")
    new = text.rjust(width) if right else text.ljust(width)
    return (body[:begin].ljust(begin) + (new + after).rstrip()).ljust(len(body)) + mark + comment


def _widened(line: str, fields: Sequence[str], texts: Sequence[str | None]) -> list[str]:
    """Card of the small layout in the large one, two lines; a comment stays behind the second."""
    *values, marker, name = fields
    for k, text in enumerate(texts):
        values[_FIRST + k] = values[_FIRST + k] if text is None else text
    body, mark, comment = line.partition("$")
    if "," in body:
        lines = [",".join([f"{name}*", *values[:4]]), ",".join(["*", *values[4:], marker]).rstrip(",")]
    else:
        lines = [f"{name + '*':<8}" + "".join(f"{value:<16}" for value in values[:4])]
        lines += ["*       " + "".join(f"{value:<16}" for value in values[4:]) + marker]
    return [lines[0].rstrip(), lines[1].rstrip() + (" " + mark + comment if mark else "")]


_DIGITS = "Fields of 16 columns hold 12 to 14 digits of the new coordinates."


def locate(path: Path) -> NastranCoordinates:
    """Find the coordinates of a file that the reader has accepted."""
    data = read_text_bytes(path)
    bulk = BulkData(path, data.replace(b"\r\n", b" \n").replace(b"\r", b"\n"))
    model = BulkModel(path)
    for cards in bulk.cards():
        if cards.name == "GRID":
            model.add_grid_points(cards)
    lines, _, points = map(np.concatenate, zip(*model.grid_points, strict=True))
    return NastranCoordinates(data, bulk, points, lines - 1)


@dataclass(frozen=True, eq=False)
class NastranCoordinates:
    """Coordinates of GRID cards, see `hexmend.io.coordinates.located.LocatedCoordinates`.

    Parameters
    ----------
    data : bytes
        Content of the file.
    bulk : BulkData
        The same, with lines of the same offsets that end in "\\n".
    points : (n, 3) float64
    lines : (n,) int64
        First line of each node's card, from 0.
    """

    data: bytes
    bulk: BulkData
    points: np.ndarray
    lines: np.ndarray

    def write(self, files: AtomicFiles, target: Path, points: np.ndarray) -> tuple[str, ...]:
        """Write the file with new coordinates; see `LocatedCoordinates.write`."""
        changed = ~(points == self.points)
        moved = np.flatnonzero(changed.any(axis=1))
        moved = moved[np.argsort(self.lines[moved], kind="stable")]
        rows = zip(self.lines[moved].tolist(), points[moved].tolist(), changed[moved].tolist(), strict=True)
        at, n_widened, pieces = 0, 0, []
        for line, point, which in rows:
            texts = [real_field(value) if new else None for value, new in zip(point, which, strict=True)]
            ranges = self._ranges(line)
            lines = replace_in_card([self.data[slice(*one)].decode("latin-1") for one in ranges], texts)
            n_widened += len(lines) > len(ranges)
            (begin, end), after = ranges[0], ranges[-1]
            line_end = b"\r\n" if self.data[end : end + 2] == b"\r\n" else b"\n"
            between = self.data[end : after[0]] if len(ranges) > 1 else line_end
            pieces += [self.data[at:begin], between.join(one.encode("latin-1") for one in lines)]
            at = after[1]
        with open(files.add(target), "wb") as out:
            out.writelines(pieces)
            out.write(memoryview(self.data)[at:])
        widened = count_phrase(n_widened, "GRID card has", "GRID cards have")
        notes = [f"{widened} become GRID* to hold all digits of the new coordinates."] if n_widened else []
        exact = all(map(is_exact, points[changed].tolist()))
        return (*notes, *([] if exact else [_DIGITS]))

    def _ranges(self, line: int) -> list[tuple[int, int]]:
        """Byte ranges of the line of a card, and of the line that continues it where that holds a coordinate."""
        ranges = [self._range(line)]
        if not is_large(self.data[slice(*ranges[0])].decode("latin-1")):
            return ranges
        for k in range(line + 1, len(self.bulk.start)):
            begin, end = self._range(k)
            text = self.data[begin:end].partition(b"$")[0]
            if text.strip():
                head = (text.split(b",")[0] if b"," in text else text.expandtabs(8)[:8]).strip()
                return [*ranges, (begin, end)] if head[:1] in (b"", b"+", b"*") else ranges
        return ranges

    def _range(self, line: int) -> tuple[int, int]:
        """Byte range of a line without its end."""
        begin, end = int(self.bulk.start[line]), int(self.bulk.end[line])
        return begin, end - (end > begin and self.data[end - 1 : end + 1] == b"\r\n")
