"""Files of a Nastran deck, joined where INCLUDE names them."""

from __future__ import annotations

import re
from bisect import bisect_right
from pathlib import Path

from hexmend.io.base.cursor import read_text_bytes
from hexmend.io.coordinates import deck_files
from hexmend.io.coordinates.deck_files import DeckFile

_INCLUDE = re.compile(rb"^[ \t]*INCLUDE[ \t,=]*('[^']*'|\"[^\"]*\"|[^\s$,]+)[^\n]*", re.IGNORECASE | re.MULTILINE)
_END = re.compile(rb"^ENDDATA", re.IGNORECASE | re.MULTILINE)


class BulkFiles:
    """The text of a deck and of the files that it includes.

    Parameters
    ----------
    path : Path

    Attributes
    ----------
    root : DeckFile
    data : bytes
        All files in one, with lines that end in "\\n".

    Raises
    ------
    FileError
        For an included file that cannot be read, or that includes itself.
    """

    def __init__(self, path: Path):
        self.root = DeckFile(path, read_text_bytes(path))
        self._size, self._begins, self._pieces = 0, [], []
        texts: list[bytes] = []
        self._add(self.root, texts)
        self.data = b"".join(texts)

    def _add(self, file: DeckFile, texts: list[bytes]) -> None:
        """Add the texts of a file, and of those that it includes up to ENDDATA in their places."""
        at, end = 0, _END.search(file.data)
        for found in _INCLUDE.finditer(file.data, 0, end.start() if end else len(file.data)):
            self._add_piece(file, at, found.start(), texts)
            name, line = found[1], file.data.count(b"\n", 0, found.start()) + 1
            name = re.sub(rb"\s*\n\s*", b"", name.strip(name[:1]) if name[:1] in (b"'", b'"') else name)
            included = file.include(name.decode("utf-8", errors="replace"), *found.span(1), f"INCLUDE in line {line}")
            self._add(included, texts)
            at = found.end()
        self._add_piece(file, at, len(file.data), texts)

    def _add_piece(self, file: DeckFile, begin: int, end: int, texts: list[bytes]) -> None:
        if texts and not texts[-1].endswith(b"\n"):
            texts.append(b"\n")
            self._size += 1
        self._begins.append(self._size)
        self._pieces.append((file, begin))
        texts.append(file.data[begin:end])
        self._size += end - begin

    def locate(self, at: int) -> tuple[DeckFile, int]:
        """Return the file of an offset of `data`, and the offset in that file."""
        k = bisect_right(self._begins, at) - 1
        file, begin = self._pieces[k]
        return file, begin + at - self._begins[k]


def included_files(path: Path) -> set[Path]:
    """Find the files that a deck includes; see `hexmend.io.coordinates.deck_files.included_files`."""
    return deck_files.included_files(path, lambda one: BulkFiles(one).root)
