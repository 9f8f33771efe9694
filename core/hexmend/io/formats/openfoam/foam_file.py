"""Files of OpenFOAM: header, tokens and dictionaries.

*OpenFOAM User Guide*, "Basic input/output file format": a dictionary `FoamFile` says how the data behind it are
encoded. "arch" gives the byte order and the bits of labels and scalars in binary files.
"""

from __future__ import annotations

import gzip
import re
import zlib
from pathlib import Path
from typing import NamedTuple

import numpy as np

from hexmend.errors import FileError
from hexmend.io.base.cursor import ByteCursor, quoted
from hexmend.io.base.remedies import DAMAGED

#: White space and comments, and one token: text in quotes, a mark, or a word.
_TOKEN = re.compile(
    rb'(?:\s++|//[^\n]*+|/\*(?s:.*?)\*/)*+(?:("(?:[^"\\]|\\.)*+")|([{}();\[\]])|((?:(?!/[/*])[^\s{}();"\[\]])++))'
)
_COMMENT = re.compile(rb'"(?:[^"\\]|\\.)*+"|//[^\n]*+|/\*(?s:.*?)\*/')
_NOT_NEWLINE = re.compile(rb"[^\n]")
_ARCH = re.compile(r"(?P<order>LSB|MSB)|label=(?P<label>32|64)|scalar=(?P<scalar>32|64)")
_GZIP = b"\x1f\x8b"
#: Dictionaries inside one another.
_MAX_DEPTH = 32

Value = "list[str] | dict[str, Value]"


class Arch(NamedTuple):
    """Types of the numbers of binary files."""

    label: np.dtype
    scalar: np.dtype


class FoamFile(ByteCursor):
    """Cursor over a file of OpenFOAM, behind its header.

    Parameters
    ----------
    path : Path
        May be compressed by gzip.
    has_header : bool
        False for an included file, in which the header may be missing.

    Attributes
    ----------
    header : dict of str to list of str
        Entries of the dictionary FoamFile.
    is_binary : bool
    arch : Arch
    is_compressed : bool

    Raises
    ------
    FileError
        For a damaged archive, and where the header is missing.
    """

    def __init__(self, path: Path, has_header: bool = True):
        data = path.read_bytes()
        self.is_compressed = data.startswith(_GZIP)
        if self.is_compressed:
            try:
                data = gzip.decompress(data)
            except (EOFError, zlib.error, gzip.BadGzipFile):
                raise FileError(path, "is a damaged gzip file", DAMAGED) from None
        super().__init__(path, data)
        self.header: dict[str, Value] = {}
        if has_header or self.peek() == "FoamFile":
            if self.token() != "FoamFile" or self.token() != "{":
                raise self.error(
                    "does not begin with the header FoamFile { ... }", "Check that this is an OpenFOAM file."
                )
            self.header = self.dictionary("the header FoamFile")
        encoding = self.word(self.header, "format", "the header FoamFile", "ascii")
        if encoding not in ("ascii", "binary"):
            raise self.error(f"its format is {quoted(encoding)}: expected ascii or binary")
        self.is_binary = encoding == "binary"
        self._is_blanked = False
        self.arch = _arch_of(self.word(self.header, "arch", "the header FoamFile", ""))

    def peek(self) -> str:
        """Return the next token and leave it; empty at the end of the file."""
        before = self.pos
        token = self.token()
        self.pos = before
        return token

    def token(self) -> str:
        """Read the next token: a mark, a word, or a text with its quotes; empty at the end of the file."""
        found = _TOKEN.match(self.data, self.pos)
        if found is None:
            self.pos = len(self.data)
            return ""
        self.pos = found.end()
        return found[found.lastindex].decode("utf-8", errors="replace")

    def blank_comments(self) -> None:
        """Replace the comments of a file of text by blanks; lines and offsets stay the same."""
        if not self._is_blanked and self.data.find(b"/", self.pos) >= 0:
            self.data = self.data[: self.pos] + _COMMENT.sub(_blanks, self.data[self.pos :])
        self._is_blanked = True

    def expect(self, mark: str, label: str) -> None:
        """Read a token and raise `FileError` unless it is `mark`."""
        token = self.token()
        if token != mark:
            raise self.error(f"{label} continues with {self.shown(token)}: expected {mark!r}")

    def shown(self, token: str) -> str:
        """Describe a token that has been read, for errors, with its line."""
        return f"{quoted(token)} ({self.location})" if token else f"nothing (the file ends at {self.location})"

    def dictionary(self, label: str, depth: int = 0) -> dict[str, Value]:
        """Read the entries of a dictionary and the brace behind them.

        Parameters
        ----------
        label : str
            Name of the dictionary, for errors.
        depth : int
            Number of dictionaries around it.

        Returns
        -------
        dict of str to list of str or dict
            The tokens of each entry, or the entries of a dictionary in it.
        """
        entries: dict[str, Value] = {}
        while (key := self.token()) != "}":
            if not key or key in "{}();[]" or depth > _MAX_DEPTH:
                raise self.error(f"{label} continues with {self.shown(key)}: expected a name or '}}'")
            if key.startswith("#"):
                self.token()  # such as #includeIfPresent "file": nothing that a mesh needs
                continue
            if self.peek() == "{":
                self.token()
                entries[_bare(key)] = self.dictionary(f"{label}, {quoted(_bare(key))}", depth + 1)
            else:
                entries[_bare(key)] = self.entry(f"{label}, {quoted(_bare(key))}")
        return entries

    def entry(self, label: str) -> Value:
        """Read the value of an entry: its tokens up to the semicolon; `label` names it in errors."""
        tokens, nested = [], 0
        while (token := self.token()) != ";" or nested > 0:
            nested += (token in "({[") - (token in ")}]") if token else 0
            if not token or nested < 0:
                raise self.error(f"{label} continues with {self.shown(token)}: expected ';'")
            tokens.append(_bare(token))
        return tokens

    def word(self, entries: dict[str, Value], key: str, label: str, default: str | None = None) -> str:
        """Return the single word of an entry.

        Parameters
        ----------
        entries : dict
        key, label : str
            Name of the entry, and of the dictionary for errors.
        default : str, optional
            Value of a missing entry.

        Raises
        ------
        FileError
            Where the entry is missing or is not a word.
        """
        value = entries.get(key, [default] if default is not None else None)
        if value is None:
            raise self.error(f"{label} has no entry {key!r}")
        if not isinstance(value, list) or len(value) != 1:
            raise self.error(f"the entry {key!r} of {label} is not a word")
        return value[0]

    def count(self, label: str) -> int:
        """Read a natural number; `label` names it in errors."""
        return self.parse_count(self.token(), label)


def _blanks(found: re.Match[bytes]) -> bytes:
    """Blanks in place of a comment; texts in quotes stay."""
    return found[0] if found[0].startswith(b'"') else _NOT_NEWLINE.sub(b" ", found[0])


def _bare(token: str) -> str:
    """Token without quotes."""
    return token[1:-1] if token.startswith('"') else token


def _arch_of(text: str) -> Arch:
    """Types that "LSB;label=32;scalar=64" describes; these are also the defaults."""
    given = {name: value for found in _ARCH.finditer(text) for name, value in found.groupdict().items() if value}
    order = ">" if given.get("order") == "MSB" else "<"
    bits = {name: int(given.get(name, default)) // 8 for name, default in (("label", 32), ("scalar", 64))}
    return Arch(np.dtype(f"{order}i{bits['label']}"), np.dtype(f"{order}f{bits['scalar']}"))
