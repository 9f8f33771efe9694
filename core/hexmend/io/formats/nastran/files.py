"""Files of a Nastran deck, joined where INCLUDE names them."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path

from hexmend.io.coordinates import joined_files
from hexmend.io.coordinates.joined_files import Inclusion, JoinedFiles

_INCLUDE = re.compile(rb"^[ \t]*INCLUDE[ \t,=]*('[^']*'|\"[^\"]*\"|[^\s$,]+)[^\n]*", re.IGNORECASE | re.MULTILINE)
_END = re.compile(rb"^ENDDATA[^\n]*\n?", re.IGNORECASE | re.MULTILINE)


def join(path: Path) -> JoinedFiles:
    """Read a deck with all files that it includes; see `JoinedFiles`."""
    return JoinedFiles(path, _inclusions, _end)


def included_files(path: Path) -> set[Path]:
    """Find the files that a deck includes."""
    return joined_files.included_files(path, join)


def _inclusions(data: bytes) -> Iterator[Inclusion]:
    for found in _INCLUDE.finditer(data):
        name = found[1].strip(found[1][:1]) if found[1][:1] in (b"'", b'"') else found[1]
        text = re.sub(rb"\s*\n\s*", b"", name).decode("utf-8", errors="replace")
        yield Inclusion(found.start(), *found.span(), "INCLUDE", [(text, *found.span(1))])


def _end(data: bytes) -> int:
    found = _END.search(data)
    return found.end() if found else len(data)
