"""Deck of LS-DYNA as blocks: a keyword, and the lines of data that follow it, cut into fields."""

from __future__ import annotations

import re
from collections.abc import Iterator
from functools import partial
from pathlib import Path

from hexmend.io.coordinates.joined_files import Inclusion, JoinedFiles, included_files
from hexmend.io.formats.decks.lines import CardLines, keyword_lines

_INCLUDE = re.compile(rb"^\*INCLUDE[ \t]*\n((?:(?!\*)[^\n]*(?:\n|\Z))*)", re.IGNORECASE | re.MULTILINE)
#: Name of a file in a line that is no comment; it goes on in the next line behind " +".
_NAME = re.compile(rb"^(?!\$)[ \t]*(\S(?:[^\n]* \+[ \t]*\n)*[^\n]*)", re.MULTILINE)
_END = re.compile(rb"^\*END[ \t]*$", re.IGNORECASE | re.MULTILINE)
#: Columns of a field in long format and with wide ids, by those in standard format.
_LONG, _WIDE_IDS = {8: 20, 10: 20, 16: 20}, {8: 10}


def join(path: Path) -> JoinedFiles:
    """Read a deck with all files that it includes; see `JoinedFiles`."""
    return JoinedFiles(path, _inclusions, _END)


def _inclusions(data: bytes) -> Iterator[Inclusion]:
    for found in _INCLUDE.finditer(data):
        names = []
        for one in _NAME.finditer(data, *found.span(1)):
            name = re.sub(rb" \+[ \t]*\n[ \t]*", b"", one[1]).rstrip()
            names.append((name.decode("utf-8", errors="replace"), one.start(1), one.start(1) + len(one[1].rstrip())))
        yield Inclusion(found.start(), *found.span(), "*INCLUDE", names)


def keywords(files: JoinedFiles) -> Iterator[CardLines]:
    """Iterate over the keywords of a deck; their lines are those that are neither blank nor comments.

    Names are in upper case, behind an asterisk and without the marks of their format.
    """
    is_long = has_wide_ids = False
    for at, line, begin, end in keyword_lines(files.data, b"*", b"$"):
        name, *options = line.upper().replace(",", " ").split() or [""]
        if name == "KEYWORD":
            is_long = any(word.startswith(("LONG=Y", "LONG=S")) for word in options)
            has_wide_ids = "I10=Y" in "".join(options)
        own = (is_long and "-" not in options) or "+" in options
        columns = _LONG if own else _WIDE_IDS if has_wide_ids else {}
        one = CardLines(f"*{name.rstrip('+-%')}", files, at, begin, end, columns)
        if one.name.startswith("*INCLUDE_TRANSFORM"):
            raise one.error("moves and renumbers what it includes", "Write the deck with it expanded.")
        yield one


#: included_files_of(path) finds the files that a deck includes.
included_files_of = partial(included_files, join)
