"""XML of VTK's files up to the appended data: elements, and the offsets of their text, which is not kept in memory."""

from __future__ import annotations

import io
import re
from collections.abc import Iterator
from contextlib import suppress
from dataclasses import dataclass, field
from pathlib import Path
from typing import BinaryIO
from xml.parsers import expat

import numpy as np

from hexmend.errors import FileError
from hexmend.io.base.cursor import is_number
from hexmend.io.base.remedies import DAMAGED, MemoryBudget, check_suffix
from hexmend.terminal_text import printable

#: NumPy types of arrays, without the byte order. Bits are packed: see `hexmend.io.formats.vtk.xml_arrays`.
TYPES = {
    "Int8": "i1", "UInt8": "u1", "Int16": "i2", "UInt16": "u2", "Int32": "i4", "UInt32": "u4", "Int64": "i8",
    "UInt64": "u8", "Float32": "f4", "Float64": "f8", "Bit": "u1", "String": "u1",
}  # fmt: skip

#: Bytes that are parsed at a time.
_CHUNK = 1 << 18
_TAG = re.compile(rb"<(?:[^>\"']|\"[^\"]*\"|'[^']*')*>")
_COMMENT = re.compile(rb"<!--.*?-->", re.DOTALL)
#: Largest number of elements.
_MAX_ELEMENTS = 1_000_000


@dataclass(eq=False)
class XMLElement:
    """Element of the XML.

    Parameters
    ----------
    name : str
    attributes : dict of str to str
    children : list of XMLElement
    spans : list of (begin, end)
        Offsets of its text, each part from the beginning of the tag before it.
    """

    name: str
    attributes: dict[str, str]
    children: list[XMLElement] = field(default_factory=list)
    spans: list[tuple[int, int]] = field(default_factory=list)

    def get(self, key: str, default: str = "") -> str:
        """Return an attribute."""
        return self.attributes.get(key, default)

    def all(self, name: str) -> Iterator[XMLElement]:
        """Yield the children with a name."""
        return (child for child in self.children if child.name == name)

    def first(self, name: str) -> XMLElement:
        """Return the first child with a name, or an empty element."""
        return next(self.all(name), XMLElement(name, {}))

    def arrays_by_name(self) -> dict[str, XMLElement]:
        """Child elements that are arrays, by name."""
        return {array.get("Name"): array for array in self.arrays()}

    def arrays(self) -> list[XMLElement]:
        """Return the children that are arrays."""
        return [child for child in self.children if child.name in ("DataArray", "Array")]


class Document:
    """Open VTK XML file, for a `with` statement; `root` is its element VTKFile.

    Parameters
    ----------
    path : Path
    *kinds : str
        Expected types, such as "UnstructuredGrid".

    Raises
    ------
    FileError
        Where the file is not XML, is of another type, or declares a document type or entities, as no VTK file does.
    """

    def __init__(self, path: Path, *kinds: str):
        self.path = path
        self.file: BinaryIO = open(path, "rb")  # noqa: SIM115  (closed by __exit__)
        try:
            if not self.file.read(4096).removeprefix(b"\xef\xbb\xbf").lstrip().startswith(b"<"):
                raise FileError(path, "does not begin with <VTKFile ...>", check_suffix("a VTK XML file"))
            self.size = self.file.seek(0, io.SEEK_END)
            self.budget = MemoryBudget(path, self.size)
            self._appended: int | None = None
            self.root = self._parse(kinds)
        except BaseException:
            self.file.close()
            raise

    def __enter__(self) -> Document:
        return self

    def __exit__(self, *_) -> None:
        self.file.close()

    def error(self, problem: str, remedy: str = DAMAGED) -> FileError:
        """Make the error to raise; `problem` and `remedy` are as of `FileError`."""
        return FileError(self.path, problem, remedy)

    def count(self, element: XMLElement, key: str) -> int:
        """Convert an attribute to a count; 0 where it is missing."""
        word = element.get(key, "0").strip()
        if not is_number(word):
            raise self.error(f"{key} of {element.name} is {word[:20]!r}: expected a natural number")
        return int(word)

    def dtype(self, array: XMLElement) -> np.dtype:
        """Return the NumPy type of an array in the file, with its byte order."""
        kind = array.get("type")
        if kind not in TYPES:
            raise self.error(f"{array_title(array)} has the type {kind[:20]!r}: expected {', '.join(TYPES)}")
        return np.dtype(TYPES[kind]).newbyteorder(self.order)

    @property
    def order(self) -> str:
        """Byte order in NumPy's notation."""
        return ">" if self.root.get("byte_order", "LittleEndian") == "BigEndian" else "<"

    def text(self, element: XMLElement) -> bytes:
        """Read the text of an element, without that of its children."""
        parts = []
        for begin, end in element.spans:
            part = self.bytes(begin, end - begin)
            tag = _TAG.match(part)
            parts.append(_COMMENT.sub(b"", part[tag.end() :] if tag else part))
        return b"".join(parts)

    def bytes(self, begin: int, size: int) -> bytes:
        """Read `size` bytes from the offset `begin`; fewer at the end of the file."""
        self.file.seek(begin)
        return self.file.read(size)

    def appended(self) -> tuple[int, str]:
        """Return the offset of the appended data, behind their mark "_", and the encoding: "raw" or "base64"."""
        if self._appended is None:
            raise self.error("has no AppendedData, in which its arrays should be")
        start = self.bytes(self._appended, _CHUNK)
        tag = _TAG.match(start)
        mark = start.find(b"_", tag.end()) if tag else -1
        if mark < 0 or start[tag.end() : mark].strip():
            raise self.error("its AppendedData do not begin with '_'")
        encoding = self.root.first("AppendedData").get("encoding", "base64")
        return self._appended + mark + 1, encoding

    def _parse(self, kinds: tuple[str, ...]) -> XMLElement:
        """Parse the elements up to the appended data."""
        parser = expat.ParserCreate()
        top, count = XMLElement("", {}), 0
        stack = [top]

        def begin(name: str, attributes: dict[str, str]) -> None:
            nonlocal count
            at, count = parser.CurrentByteIndex, count + 1
            if count > _MAX_ELEMENTS:
                raise self.error(f"has more than {_MAX_ELEMENTS:,} elements")
            if stack[-1] is top:
                self._check(name, attributes, kinds)
            else:
                stack[-1].spans[-1] = (stack[-1].spans[-1][0], at)
            stack.append(XMLElement(name, attributes, spans=[(at, at)]))
            stack[-2].children.append(stack[-1])
            if name == "AppendedData":
                self._appended = at
                raise _AppendedDataReached

        def end(_: str) -> None:
            at = parser.CurrentByteIndex
            element = stack.pop()
            element.spans[-1] = (element.spans[-1][0], at)
            if stack[-1].spans:
                stack[-1].spans.append((at, at))

        def reject_doctype(*_) -> None:
            raise self.error("declares a document type, which no VTK file does", "Remove <!DOCTYPE ...>.")

        parser.StartElementHandler, parser.EndElementHandler = begin, end
        parser.StartDoctypeDeclHandler = parser.EntityDeclHandler = reject_doctype
        self.file.seek(0)
        try:
            with suppress(_AppendedDataReached):
                while chunk := self.file.read(_CHUNK):
                    parser.Parse(chunk, False)
                parser.Parse(b"", True)
        except (expat.ExpatError, LookupError, UnicodeError, ValueError) as error:  # or an unknown encoding
            line, column = getattr(error, "lineno", parser.CurrentLineNumber), getattr(error, "offset", 0)
            raise self.error(f"its XML is broken at line {line}, column {column}") from None
        return top.children[0]

    def _check(self, name: str, attributes: dict[str, str], kinds: tuple[str, ...]) -> None:
        if name != "VTKFile":
            raise self.error("does not begin with <VTKFile ...>", check_suffix("a VTK XML file"))
        found = attributes.get("type", "")
        if found not in kinds:
            problem = f"is a VTKFile of the type {printable(found[:40])!r}: expected {' or '.join(kinds)}"
            raise self.error(problem, f"Convert it to {kinds[0]}.")


def array_title(array: XMLElement) -> str:
    """Choose an array for a message."""
    return f"the array {printable(array.get('Name', 'without name'))[:60]!r}"


class _AppendedDataReached(Exception):
    """The part of the file that is XML ends here."""
