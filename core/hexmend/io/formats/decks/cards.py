"""Cards of a deck in fixed columns or between commas: the fields of many cards at once, as numbers."""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from hexmend.errors import FileError
from hexmend.io.base.cursor import is_number, quoted

#: Letters of a field between commas that are kept: a number has fewer.
LONGEST = 64
_EXPONENT = re.compile(r"([+-]?[0-9.]+)(?:[ED]([+-]?)|([+-]))([0-9]+)", re.IGNORECASE)


@dataclass(frozen=True, eq=False)
class Cards:
    """Cards of one name in a part of a file.

    Parameters
    ----------
    path : Path
        The file; errors name it.
    name : str
    lines : (k,) int64
        Their first lines, from 1.
    texts : (f,) array of bytes
        Fields of all cards of the part.
    begins, ends : (k,) int64
        Ranges of the fields of each card after its name, continuations joined.
    place : callable
        place(line) names a line, for errors.
    """

    path: Path
    name: str
    lines: np.ndarray
    texts: np.ndarray
    begins: np.ndarray
    ends: np.ndarray
    place: Callable[[int], str] = "line {}".format

    def fields(self, first: int, last: int) -> np.ndarray:
        """Fields first to last - 1 of each card after its name, (k, last - first) bytes; blank where it has fewer."""
        at = self.begins[:, None] + np.arange(first, last)
        found = np.strings.strip(self.texts[np.minimum(at, len(self.texts) - 1)])
        return np.where(at < self.ends[:, None], found, b"")

    def integers(self, first: int, last: int) -> np.ndarray:
        """Whole numbers in such fields, (k, last - first) int64, 0 for a blank one; `FileError` names card and line."""
        return self._parsed(first, last, np.int64, self._integer)

    def reals(self, first: int, last: int) -> np.ndarray:
        """Real numbers in such fields, float64, 0 for a blank one; an exponent may have the letter D or none: 1.5-3."""
        return self._parsed(first, last, np.float64, self._real)

    def error(self, at: int, problem: str, remedy: str = "Correct the file.") -> FileError:
        """Make the error to raise for a card, whose name and line begin the sentence."""
        return FileError(self.path, f"{self.name} in {self.place(int(self.lines[at]))} {problem}", remedy)

    def _parsed(self, first: int, last: int, dtype: type, parse: Callable[[str, int], Any]) -> np.ndarray:
        fields = self.fields(first, last)
        fields = np.where(fields == b"", b"0", fields)
        try:
            if b"_" not in fields.tobytes() and not (np.strings.str_len(fields) >= LONGEST).any():  # Python allows _
                return fields.astype(dtype)
        except (ValueError, OverflowError):
            pass
        rows = enumerate(fields.tolist())
        return np.array([[parse(word.decode("latin-1"), at) for word in row] for at, row in rows], dtype)

    def _integer(self, word: str, at: int) -> int:
        digits = word[1:] if word[0] in "+-" else word
        if not is_number(digits):
            raise self.error(at, f"holds {quoted(word)}: expected a whole number")
        return int(word)

    def _real(self, word: str, at: int) -> float:
        found = _EXPONENT.fullmatch(word)
        try:
            if "_" in word or len(word) >= LONGEST:
                raise ValueError(word)
            return float(f"{found[1]}e{found[2] or found[3] or ''}{found[4]}" if found else word)
        except ValueError:
            raise self.error(at, f"holds {quoted(word)}: expected a number") from None
