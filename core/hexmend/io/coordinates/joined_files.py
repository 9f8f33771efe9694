"""A deck and the files that it includes as one text."""

from __future__ import annotations

import re
from bisect import bisect_right
from collections.abc import Callable, Iterable
from functools import partial
from pathlib import Path
from typing import NamedTuple

from hexmend.errors import HexmendError
from hexmend.io.base.cursor import read_text_bytes
from hexmend.io.coordinates.deck_files import DeckFile, write_files
from hexmend.io.coordinates.text_coordinates import Edits
from hexmend.io.storage.atomic import AtomicFiles

_NEWLINE = b"\n"


class Inclusion(NamedTuple):
    """A card that includes files, whose texts take a byte range: its name, and those of the files with their ranges."""

    at: int
    begin: int
    end: int
    card: str
    names: list[tuple[str, int, int]]


class JoinedFiles:
    """The text of a deck, with those of the files that it includes in the places of the cards that name them.

    Parameters
    ----------
    path : Path
    inclusions : callable
        inclusions(data) finds the cards in a file that include others, in order.
    end : pattern, optional
        The card at which a file ends.

    Attributes
    ----------
    root : DeckFile
    data : bytes
        With lines that end in "\\n".

    Raises
    ------
    FileError
        For an included file that cannot be read, or that includes itself.
    """

    def __init__(
        self,
        path: Path,
        inclusions: Callable[[bytes], Iterable[Inclusion]] = lambda data: (),
        end: re.Pattern[bytes] | None = None,
    ):
        self.root, self._inclusions, self._end = DeckFile(path, read_text_bytes(path)), inclusions, end
        self._size, self._begins, self._pieces = 0, list[int](), list[tuple[DeckFile, int]]()
        texts: list[bytes] = []
        self._add(self.root, texts)
        self.data = b"".join(texts)

    def _add(self, file: DeckFile, texts: list[bytes]) -> None:
        last = self._end.search(file.data) if self._end else None
        at, end = 0, last.start() if last else len(file.data)
        for found in self._inclusions(file.data[:end]):
            self._add_piece(file, at, found.begin, texts)
            for name in found.names:
                line = file.data.count(_NEWLINE, 0, found.at) + 1
                self._add(file.include(*name, f"{found.card} in line {line}"), texts)
            at = found.end
        self._add_piece(file, at, end, texts)

    def _add_piece(self, file: DeckFile, begin: int, end: int, texts: list[bytes]) -> None:
        if texts and not texts[-1].endswith(_NEWLINE):
            texts.append(_NEWLINE)
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

    def write(self, files: AtomicFiles, target: Path, edits: Edits) -> tuple[str, ...]:
        """Write the deck and its files with edits of `data`, none over the end of a file; see `write_files`."""
        rows: dict[DeckFile, list[tuple[int, int, bytes]]] = {}
        for begin, end, text in zip(edits.begin.tolist(), edits.end.tolist(), edits.texts, strict=True):
            file, at = self.locate(begin)
            rows.setdefault(file, []).append((at, at + end - begin, text))
        own = {file: Edits.of(parts) for file, parts in rows.items()}
        old = included_files(partial(JoinedFiles, inclusions=self._inclusions, end=self._end), target)
        return write_files(self.root, own, target, files, old)

    def place(self, at: int) -> str:
        """Name the line of an offset, such as "line 12", or "line 3 of nodes.bdf" in an included file."""
        file, own = self.locate(at)
        return file.place(own)


def included_files(join: Callable[[Path], JoinedFiles], path: Path) -> set[Path]:
    """Find the files that a deck includes, and those that they include.

    Parameters
    ----------
    join : callable
        join(path) reads a deck with its files.
    path : Path

    Returns
    -------
    set of Path
        With links resolved; empty for a file that is missing or cannot be read.
    """
    try:
        return {one.path.resolve() for one in list(join(path).root.walk())[1:]}
    except (HexmendError, OSError):
        return set()
