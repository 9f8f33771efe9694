"""The head of VTK's XML files: elements and where their arrays lie; the arrays' bytes are never taken for XML."""

from __future__ import annotations

import io
import re
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import BinaryIO

import numpy as np

from hexmend.errors import FileError
from hexmend.io.base.memory_budget import MemoryBudget

DAMAGED = "Write the file again with the program that made it: it is damaged or cut short."
#: Types of arrays, without their byte order. A bit is an eighth of a byte: see `hexmend.io.formats.vtk.xml_arrays`.
TYPES = {
    "Int8": "i1", "UInt8": "u1", "Int16": "i2", "UInt16": "u2", "Int32": "i4", "UInt32": "u4", "Int64": "i8",
    "UInt64": "u8", "Float32": "f4", "Float64": "f8", "Bit": "u1", "String": "u1",
}  # fmt: skip

_CHUNK = 1 << 18
_TAG = re.compile(rb"<(?:[^>\"']|\"[^\"]*\"|'[^']*')*>")
_COMMENT = re.compile(rb"<!--.*?-->", re.DOTALL)
#: More elements than any mesh has.
_ELEMENTS = 1_000_000
_LARGEST = 1 << 28


@dataclass(eq=False)
class XMLElement:
    """An element of the head.

    Parameters
    ----------
    name : str
    attributes : dict of str to str
    children : list of XMLElement
    spans : list of (begin, end)
        Bytes of the file in which its text lies, each from the tag that goes before it.
    """

    name: str
    attributes: dict[str, str]
    children: list[XMLElement] = field(default_factory=list)
    spans: list[tuple[int, int]] = field(default_factory=list)

    def get(self, key: str, default: str = "") -> str:
        """An attribute."""
        return self.attributes.get(key, default)

    def all(self, name: str) -> Iterator[XMLElement]:
        """Children of a name."""
        return (child for child in self.children if child.name == name)

    def first(self, name: str) -> XMLElement:
        """The first child of a name, or an empty element where there is none."""
        return next(self.all(name), XMLElement(name, {}))

    def arrays(self) -> list[XMLElement]:
        """Children that are arrays."""
        return [child for child in self.children if child.name in ("DataArray", "Array")]


class Document:
    """An open VTK XML file: its head as `root`, and its bytes. Used in a `with` statement.

    Parameters
    ----------
    path : Path
    kind : str
        The type that it should have, such as "UnstructuredGrid".

    Raises
    ------
    FileError
        Where the file is no XML, of another type, or declares a document type or entities (which no VTK file does).
    """

    def __init__(self, path: Path, kind: str):
        self.path = path
        self.file: BinaryIO = open(path, "rb")  # noqa: SIM115  (closed by __exit__)
        try:
            self._encoding = None
            start = self.file.read(4096)
            if start[:2] in (b"\xff\xfe", b"\xfe\xff"):  # UTF-16, in which no raw bytes can lie
                self.file, self._encoding = io.BytesIO(_recoded(path, self.file)), "utf-8"
                start = self.file.read(4096)
            if not start.removeprefix(b"\xef\xbb\xbf").lstrip().startswith(b"<"):
                raise FileError(path, "does not begin with <VTKFile ...>", "Is it a VTK XML file? Check its suffix.")
            self.size = self.file.seek(0, io.SEEK_END)
            self.budget = MemoryBudget(path, self.size)
            self._appended: int | None = None
            self.root = self._head(kind)
        except BaseException:
            self.file.close()
            raise

    def __enter__(self) -> Document:
        return self

    def __exit__(self, *_) -> None:
        self.file.close()

    def error(self, problem: str, remedy: str = DAMAGED) -> FileError:
        """The error to raise."""
        return FileError(self.path, problem, remedy)

    def count(self, element: XMLElement, key: str) -> int:
        """A count among the attributes of an element."""
        word = element.get(key, "0").strip()
        if not (word.isascii() and word.isdigit() and len(word) < 19):
            raise self.error(f"{key} of {element.name} is {word[:20]!r}: expected a natural number")
        return int(word)

    def dtype(self, array: XMLElement) -> np.dtype:
        """The type of an array's numbers as they lie in the file."""
        kind = array.get("type")
        if kind not in TYPES:
            raise self.error(f"{array_title(array)} has the type {kind[:20]!r}: expected {', '.join(TYPES)}")
        return np.dtype(TYPES[kind]).newbyteorder(self.order)

    @property
    def order(self) -> str:
        """The byte order, as NumPy says it."""
        return ">" if self.root.get("byte_order", "LittleEndian") == "BigEndian" else "<"

    def text(self, element: XMLElement) -> bytes:
        """The text of an element, without that of its children."""
        parts = []
        for begin, end in element.spans:
            part = self.bytes(begin, end - begin)
            tag = _TAG.match(part)
            parts.append(_COMMENT.sub(b"", part[tag.end() :] if tag else part))
        return b"".join(parts)

    def bytes(self, begin: int, size: int) -> bytes:
        """Bytes as they lie in the file; fewer at its end."""
        self.file.seek(begin)
        return self.file.read(size)

    def appended(self) -> tuple[int, str]:
        """Where the appended data begin, behind their mark "_", and how they are encoded: "raw" or "base64"."""
        if self._appended is None:
            raise self.error("has no AppendedData, in which its arrays should be")
        start = self.bytes(self._appended, _CHUNK)
        tag = _TAG.match(start)
        mark = start.find(b"_", tag.end()) if tag else -1
        if mark < 0 or start[tag.end() : mark].strip():
            raise self.error("its AppendedData do not begin with '_'")
        encoding = self.root.first("AppendedData").get("encoding", "base64")
        return self._appended + mark + 1, encoding

    def _head(self, kind: str) -> XMLElement:
        """The elements, up to the appended data."""
        from xml.parsers import expat

        parser = expat.ParserCreate(self._encoding)
        top, count = XMLElement("", {}), 0
        stack = [top]

        def begin(name: str, attributes: dict[str, str]) -> None:
            nonlocal count
            at, count = parser.CurrentByteIndex, count + 1
            if count > _ELEMENTS:
                raise self.error(f"has more than {_ELEMENTS:,} elements")
            if stack[-1] is top:
                self._check(name, attributes, kind)
            else:
                stack[-1].spans[-1] = (stack[-1].spans[-1][0], at)
            stack.append(XMLElement(name, attributes, spans=[(at, at)]))
            stack[-2].children.append(stack[-1])
            if name == "AppendedData":
                self._appended = at
                raise _Reached

        def end(_: str) -> None:
            at = parser.CurrentByteIndex
            one = stack.pop()
            one.spans[-1] = (one.spans[-1][0], at)
            if stack[-1].spans:
                stack[-1].spans.append((at, at))

        def refused(*_) -> None:
            raise self.error("declares a document type, which no VTK file does", "Remove <!DOCTYPE ...>.")

        parser.StartElementHandler, parser.EndElementHandler = begin, end
        parser.StartDoctypeDeclHandler = parser.EntityDeclHandler = refused
        self.file.seek(0)
        try:
            while chunk := self.file.read(_CHUNK):
                parser.Parse(chunk, False)
            parser.Parse(b"", True)
        except _Reached:
            pass
        except (expat.ExpatError, LookupError, UnicodeError, ValueError) as error:  # or an encoding of no name
            line, column = getattr(error, "lineno", parser.CurrentLineNumber), getattr(error, "offset", 0)
            raise self.error(f"its XML is broken at line {line}, column {column}") from None
        return top.children[0]

    def _check(self, name: str, attributes: dict[str, str], kind: str) -> None:
        if name != "VTKFile":
            raise self.error("does not begin with <VTKFile ...>", "Is it a VTK XML file? Check its suffix.")
        found = attributes.get("type", "")
        if found != kind:
            found = "".join(c if c.isprintable() else "?" for c in found[:40])
            raise self.error(f"is a VTKFile of the type {found!r}: expected {kind}", f"Convert it to {kind}.")


def array_title(array: XMLElement) -> str:
    """An array for a message."""
    name = array.get("Name", "without name")
    return f"the array {''.join(c if c.isprintable() else '?' for c in name)[:60]!r}"


class _Reached(Exception):
    """The head ends here."""


def _recoded(path: Path, file: BinaryIO) -> bytes:
    """A file in UTF-16 as UTF-8."""
    with file:
        if file.seek(0, io.SEEK_END) > _LARGEST:
            raise FileError(path, "is text in UTF-16, of more than 256 MB", "Write it in UTF-8.")
        file.seek(0)
        try:
            return file.read().decode("utf-16").encode()
        except UnicodeError:
            raise FileError(path, "is no text in UTF-16, though it begins as such", DAMAGED) from None
