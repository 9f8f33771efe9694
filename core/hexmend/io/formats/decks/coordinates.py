"""Coordinates of the nodes of a deck, also of files that it includes."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from hexmend.io.coordinates.joined_files import JoinedFiles
from hexmend.io.coordinates.text_coordinates import TextFields, shortened
from hexmend.io.formats.decks.lines import CardLines
from hexmend.io.storage.atomic import AtomicFiles

#: Most characters of a number between commas, which Abaqus, CalculiX and LS-DYNA read.
_WIDTH = 20


@dataclass(frozen=True, eq=False)
class DeckCoordinates:
    """Coordinates in the lines of a deck, see `hexmend.io.coordinates.located.LocatedCoordinates`.

    Parameters
    ----------
    files : JoinedFiles
    points : (n, 3) float64
        As the reader gives them.
    fields : TextFields
        Of x, y and z.
    """

    files: JoinedFiles
    points: np.ndarray
    fields: TextFields

    @classmethod
    def of_lines(cls, parts: Sequence[CardLines], widths: Sequence[int], first: int) -> DeckCoordinates:
        """Find the coordinates of nodes, a line each, from the field `first` on; `widths` are as of `CardLines`."""
        three = slice(first, first + 3)
        points = np.concatenate([one.cards(widths).reals(first, first + 3) for one in parts])
        return cls(parts[0].files, points, TextFields.joined([one.fields(widths) for one in parts], three))

    @classmethod
    def joined(cls, parts: Sequence[DeckCoordinates]) -> DeckCoordinates:
        """Join the nodes of blocks of different formats."""
        points = np.concatenate([one.points for one in parts])
        return cls(parts[0].files, points, TextFields.joined([one.fields for one in parts]))

    def write(self, files: AtomicFiles, target: Path, points: np.ndarray) -> tuple[str, ...]:
        """Write the deck and its files with new coordinates; see `LocatedCoordinates.write`."""
        changed = ~(points == self.points)  # not a number differs from everything
        changed |= changed.any(axis=1)[:, None] & self.fields.absent
        values, columns = points[changed].tolist(), self.fields.columns[changed].tolist()
        texts = [number_text(*one) for one in zip(values, columns, strict=True)]
        short = {width for width, value, text in zip(columns, values, texts, strict=True) if float(text) != value}
        notes = self.files.write(files, target, self.fields.edits(changed, [text.encode() for text in texts]))
        return (*notes, *(_digits(width) for width in sorted(short) if width))


def number_text(value: float, columns: int) -> str:
    """Format a number for a field of so many columns, of which one stays blank; 0 for one between commas.

    It has a decimal point, without which a fixed field may have one where its format says.

    Examples
    --------
    >>> number_text(1e-05, 16), number_text(2 / 3, 16), number_text(2 / 3, 0)
    ('1.e-05', '0.6666666666667', '0.6666666666666666')
    """
    width = columns - 1 if columns else _WIDTH
    text = repr(value) if len(repr(value)) <= width else shortened(value, width)
    mantissa, mark, exponent = text.partition("e")
    return text if "." in mantissa or not columns or len(text) == width else f"{mantissa}.{mark}{exponent}"


def _digits(columns: int) -> str:
    return f"Fields of {columns} columns hold {columns - 7} to {min(columns - 2, 17)} digits of the new coordinates."
