"""Files that an Abaqus deck includes, whose cards and data lines come in the places that name them."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path

from hexmend.io.coordinates import joined_files
from hexmend.io.coordinates.joined_files import Inclusion, JoinedFiles
from hexmend.io.formats.abaqus.deck import Deck, keywords
from hexmend.io.formats.abaqus.model import unquoted

#: Keywords whose data lines may be in another file.
_INCLUDING = ("INCLUDE", "NODE", "ELEMENT", "NSET", "ELSET", "SURFACE")
_INPUT = re.compile(rb"input\s*=[ \t]*(\"[^\"\n]*\"|[^,\r\n]*)", re.IGNORECASE)


def join(path: Path) -> JoinedFiles:
    """Read a deck with all files that it includes; see `JoinedFiles`."""
    return JoinedFiles(path, _inclusions)


def read_deck(path: Path) -> Deck:
    """Read the cards of a deck and of all files that it includes."""
    return Deck(path, join(path))


def included_files(path: Path) -> set[Path]:
    """Find the files that a deck includes."""
    return joined_files.included_files(path, join)


def _inclusions(data: bytes) -> Iterator[Inclusion]:
    for first, end, name, options in keywords(data):
        if name in _INCLUDING and "INPUT" in options:
            file = unquoted(options["INPUT"]), *_INPUT.search(data, first).span(1)
            yield Inclusion(first, first if name == "INCLUDE" else end, end, f"*{name}", [file])
