"""Files of an Abaqus deck, and their parts in the text that joins them."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path


@dataclass(frozen=True, eq=False)
class Reference:
    """Name of an included file in the file that includes it.

    Parameters
    ----------
    parent : DeckFile
    begin, end : int
        Byte range of the name in the parent, with quotes if it has them.
    name : str
        The name without quotes.
    """

    parent: DeckFile
    begin: int
    end: int
    name: str


@dataclass(eq=False)
class DeckFile:
    """The deck or a file that it includes; a file that is included twice is two of them.

    Parameters
    ----------
    path : Path
    data : bytes
        Its content.
    reference : Reference or None
        None for the deck itself.
    included : list of DeckFile
    """

    path: Path
    data: bytes
    reference: Reference | None = None
    included: list[DeckFile] = field(default_factory=list)

    def walk(self) -> Iterator[DeckFile]:
        """Iterate over the file and all files that it includes, included ones last."""
        yield self
        for one in self.included:
            yield from one.walk()


@dataclass(frozen=True, eq=False)
class Piece:
    """Part of a file in the joined text: its offset there and in the file, and its length."""

    file: DeckFile
    begin: int
    file_begin: int
    length: int
