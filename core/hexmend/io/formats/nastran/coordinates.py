"""Coordinates of a Nastran file in its GRID cards, of any layout.

A card in fields of 8 columns becomes a GRID* card in fields of 16 where 8 columns do not hold the new coordinates.
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from hexmend.io.base.cursor import read_text_bytes
from hexmend.io.formats.nastran.bulk import BulkData
from hexmend.io.formats.nastran.card_blocks import CardBlock
from hexmend.io.formats.nastran.cards import KINDS_OF_CARD, is_exact, real_field
from hexmend.io.formats.nastran.grid_card import is_large, replace_in_card
from hexmend.io.formats.nastran.reader import BulkModel
from hexmend.terminal_text import count_phrase

_DIGITS = "Fields of 16 columns hold 12 to 14 digits of the new coordinates."


def locate(path: Path) -> NastranCoordinates:
    """Find the coordinates of a file that the reader has accepted."""
    data = read_text_bytes(path)
    bulk = BulkData(path, data.replace(b"\r\n", b" \n").replace(b"\r", b"\n"))
    model, lines = BulkModel(bulk), []
    for item in bulk.cards_and_blocks({"GRID", *KINDS_OF_CARD}):
        if isinstance(item, CardBlock) and item.name != "GRID":
            continue
        if isinstance(item, CardBlock) and model.add_block(item):
            lines.append(np.linspace(item.first, item.last, len(item.fields), endpoint=False).astype(np.int64))
            continue
        for card in bulk.cards(item.first, item.last) if isinstance(item, CardBlock) else [item]:
            if card[1] == "GRID":
                model.add_card(*card)
                lines.append(np.array([card[0] - 1]))
    return NastranCoordinates(data, bulk, model.points.array(), np.concatenate(lines))


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

    def write(self, file: Path, target: Path, points: np.ndarray) -> tuple[str, ...]:
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
            between = self.data[end : after[0]] if len(ranges) > 1 else self._line_end(end)
            pieces += [self.data[at:begin], between.join(one.encode("latin-1") for one in lines)]
            at = after[1]
        with open(file, "wb") as out:
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
        for k in range(line + 1, len(self.bulk.lines)):
            begin, end = self._range(k)
            text = self.data[begin:end].partition(b"$")[0]
            if text.strip():
                head = (text.split(b",")[0] if b"," in text else text.expandtabs(8)[:8]).strip()
                return [*ranges, (begin, end)] if head[:1] in (b"", b"+", b"*") else ranges
        return ranges

    def _range(self, line: int) -> tuple[int, int]:
        """Byte range of a line without its end."""
        begin, end = int(self.bulk.lines.start[line]), int(self.bulk.lines.end[line])
        return begin, end - (end > begin and self.data[end - 1 : end + 1] == b"\r\n")

    def _line_end(self, end: int) -> bytes:
        """Line end of the file, as after the line that ends there."""
        return b"\r\n" if self.data[end : end + 2] == b"\r\n" else b"\n"
