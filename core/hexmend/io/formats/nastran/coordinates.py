"""Coordinates of a Nastran file in its GRID cards, of any layout.

A card in fields of 8 columns becomes a GRID* card in fields of 16 where 8 columns do not hold the new coordinates.

Text of a GRID card with other coordinates, in the layout that it has.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from hexmend.io.coordinates.joined_files import JoinedFiles
from hexmend.io.coordinates.text_coordinates import Edits
from hexmend.io.formats.nastran.bulk import BulkData, join
from hexmend.io.formats.nastran.cards import is_exact, real_field
from hexmend.io.formats.nastran.reader import BulkModel, GridPoints
from hexmend.io.storage.atomic import AtomicFiles
from hexmend.terminal_text import count_phrase

#: Columns of a field in the small and in the large layout, and fields of a line.
_SMALL, _LARGE = (8, 8), (16, 4)
#: Digits that a field of 8 columns holds, with the sign and the point: smaller changes are not written.
_SMALL_DIGITS = 6
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
    files = join(path)
    bulk, model = BulkData(path, files.data, files.place), BulkModel(path)
    for cards in bulk.cards():
        model.add_position(cards)
    grid = model.grid_points()
    return NastranCoordinates(files, bulk, grid, grid.points)


@dataclass(frozen=True, eq=False)
class NastranCoordinates:
    """Coordinates of GRID cards, see `hexmend.io.coordinates.located.LocatedCoordinates`.

    Parameters
    ----------
    files : JoinedFiles
    bulk : BulkData
        Their text.
    grid : GridPoints
    points : (n, 3) float64
    """

    files: JoinedFiles
    bulk: BulkData
    grid: GridPoints
    points: np.ndarray

    def write(self, files: AtomicFiles, target: Path, points: np.ndarray) -> tuple[str, ...]:
        """Write the file with new coordinates; see `LocatedCoordinates.write`."""
        new, given = self.grid.in_file(points), self.grid.given
        changed = ~(new == given)
        same = np.abs(new - given) <= 0.5 * 10.0 ** (np.floor(np.log10(np.abs(given).max() or 1.0)) - _SMALL_DIGITS + 1)
        edits: list[tuple[int, int, bytes]] = []
        n_widened, exact = 0, True
        for node in np.flatnonzero(changed.any(axis=1)).tolist():
            lines = self._lines(int(self.grid.lines[node]) - 1)
            before = [text.decode("latin-1") for *_, text in lines]
            which = changed[node] if is_large(before[0]) else changed[node] & ~same[node]
            if not which.any():
                continue
            values = [x if is_new else None for x, is_new in zip(new[node].tolist(), which, strict=True)]
            exact = exact and all(value is None or is_exact(value) for value in values)
            after = replace_in_card(before, [None if value is None else real_field(value) for value in values])
            if len(after) > len(lines):
                n_widened += 1
                file, at = self.files.locate(lines[0][0])
                end = at + len(before[0])
                after = [("\r\n" if file.given[end : end + 2] == b"\r\n" else "\n").join(after)]
            for (begin, end, _), text in zip(lines, after, strict=True):
                edits.append((begin, end, text.encode("latin-1")))
        own = self.files.write(files, target, Edits.of(edits))
        widened = count_phrase(n_widened, "GRID card has", "GRID cards have")
        notes = [f"{widened} become GRID* to hold all digits of the new coordinates."] if n_widened else []
        return (*own, *notes, *([] if exact else [_DIGITS]))

    def _lines(self, line: int) -> list[tuple[int, int, bytes]]:
        """The line of a card, and the line that continues it where that holds a coordinate: range and text."""
        lines = [self._line(line)]
        if not is_large(lines[0][2].decode("latin-1")):
            return lines
        for k in range(line + 1, len(self.bulk.start)):
            after = self._line(k)
            text = after[2].partition(b"$")[0]
            if text.strip():
                head = (text.split(b",")[0] if b"," in text else text.expandtabs(8)[:8]).strip()
                return [*lines, after] if head[:1] in (b"", b"+", b"*") else lines
        return lines

    def _line(self, line: int) -> tuple[int, int, bytes]:
        """Byte range and text of a line without its end."""
        begin, end = int(self.bulk.start[line]), int(self.bulk.end[line])
        file, at = self.files.locate(begin)
        text = file.given[at : at + end - begin]
        text = text.removesuffix(b"\r")
        return begin, begin + len(text), text
