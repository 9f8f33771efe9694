"""Lists of labels, vectors and faces, as text and binary."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from hexmend.io.base.cursor import ByteCursor
from hexmend.io.base.polyhedra import RaggedArray
from hexmend.io.formats.openfoam.foam_file import FoamFile

#: Parentheses count as white space between numbers, and bytes keep their places for errors.
_BLANKS = bytes.maketrans(b"()", b"  ")


class Span(NamedTuple):
    """Location of the items of a list: offsets of the first byte and behind the last, and the number of items."""

    begin: int
    end: int
    count: int


def read_labels(file: FoamFile, label: str, expected: int | None = None) -> np.ndarray:
    """Read a list of labels.

    Parameters
    ----------
    file : FoamFile
    label : str
        Name of the list, for errors.
    expected : int, optional
        Number of labels; any number if None.

    Returns
    -------
    (n,) int64

    Raises
    ------
    FileError
        For a list that is cut short, holds something else, or has another length.
    """
    values = _uniform(file, label, expected)
    if values is None:
        span = find_list(file, label, file.arch.label, 1)
        values = _numbers(file, span, label, 1, file.arch.label)[:, 0].astype(np.int64)
    if expected is not None and len(values) != expected:
        raise file.error(f"{label} holds {len(values):,} numbers: expected {expected:,}")
    return values


def read_vectors(file: FoamFile, label: str) -> np.ndarray:
    """Read a list of points, (n, 3) float64; raises `FileError` as `read_labels`."""
    span = find_list(file, label, file.arch.scalar, 3)
    if not file.is_binary and file.data.count(b"(", span.begin, span.end) > span.count:
        raise file.error(f"{label} holds more points than the {span.count:,} that it declares")
    return _numbers(file, span, label, 3, file.arch.scalar).astype(np.float64)


def read_faces(file: FoamFile) -> RaggedArray:
    """Read the nodes of faces: a list of lists, or the compact form of binary files, offsets and nodes."""
    if file.word(file.header, "class", "the header FoamFile", "faceList") == "faceCompactList":
        start, nodes = read_labels(file, "the offsets of faces"), read_labels(file, "the nodes of faces")
        if not len(start) or start[0] != 0 or start[-1] != len(nodes) or (np.diff(start) < 0).any():
            raise file.error(f"the offsets of faces do not rise from 0 to {len(nodes):,}")
        return RaggedArray(start, nodes)
    if file.is_binary:
        problem = "is a binary list of faces of an old kind: expected the class faceCompactList"
        raise file.error(problem, "Convert the case with foamFormatConvert.")
    span = find_list(file, "faces", file.arch.label, 1)
    cursor = _blanked(file, span)
    values = cursor.read_numbers_to("faces", span.end, np.int64)
    if values.size == 5 * span.count and (values[::5] == 4).all():  # quads alone
        return RaggedArray(4 * np.arange(span.count + 1), values.reshape(-1, 5)[:, 1:].ravel())
    rows, whole = RaggedArray.of_counted_rows(values)
    if len(rows) != span.count or not whole:
        raise file.error(f"faces holds {len(rows):,} whole faces: expected {span.count:,}")
    return rows


def find_list(file: FoamFile, label: str, dtype: np.dtype, width: int) -> Span:
    """Read the number of items of a list and find them; the cursor is then behind the list.

    Parameters
    ----------
    file : FoamFile
    label : str
        Name of the list, for errors.
    dtype : dtype
        Type of the numbers of a binary list.
    width : int
        Numbers in an item.

    Returns
    -------
    Span
    """
    count = file.count(f"the number of {label}")
    if file.is_binary:
        if count == 0 and file.peek() != "(":
            return Span(file.pos, file.pos, 0)
        file.expect("(", label)
        begin, file.is_text = file.pos, False
        file.read_binary(label, count, width, dtype)
        end = file.pos
        if file.data[end : end + 1] != b")":
            bits = f"labels of {file.arch.label.itemsize * 8} and scalars of {file.arch.scalar.itemsize * 8} bits"
            raise file.error(f"{label} of {count:,} items does not end at byte {end}, as {bits} would have it")
        file.pos = end + 1
        return Span(begin, end, count)
    file.blank_comments()
    file.expect("(", label)
    end = _closing(file.data, file.pos)
    if end < 0:
        raise file.error(f"{label} ends without ')': the file ends at {file.location_of(len(file.data))}")
    span = Span(file.pos, end, count)
    file.pos = end + 1
    return span


def _closing(data: bytes, begin: int) -> int:
    """Offset of the parenthesis that closes a list; -1 if it is missing. Items may be lists themselves."""
    first = data.find(b")", begin)
    if first < 0 or data.find(b"(", begin, first) < 0:
        return first
    end = data.rfind(b")", begin)
    return end if data.count(b"(", begin, end) == data.count(b")", begin, end) else -1


def _numbers(file: FoamFile, span: Span, label: str, width: int, dtype: np.dtype) -> np.ndarray:
    """Numbers of a list, (count, width)."""
    if file.is_binary:
        return np.frombuffer(file.data, dtype, span.count * width, span.begin).reshape(span.count, width)
    cursor = _blanked(file, span)
    kind = np.float64 if dtype.kind == "f" else np.int64
    values = cursor.read_numbers(label, span.count, width, kind)
    if cursor.data[cursor.pos : span.end].strip():
        raise file.error(f"{label} holds more than the {span.count:,} items that it declares ({cursor.location})")
    return values


def _blanked(file: FoamFile, span: Span) -> ByteCursor:
    """Cursor over the numbers of a list of text, without parentheses and what follows."""
    cursor = ByteCursor(file.path, file.data[: span.end].translate(_BLANKS))
    cursor.pos = span.begin
    return cursor


def _uniform(file: FoamFile, label: str, expected: int | None) -> np.ndarray | None:
    """Labels of a list such as 5{0}, all equal; None for another list, which is not read."""
    before = file.pos
    count = file.count(f"the number of {label}")
    if file.peek() != "{":
        file.pos = before
        return None
    file.expect("{", label)
    if count != expected:
        raise file.error(f"{label} holds {count:,} equal numbers, which is not the number expected here")
    value = file.count(label)
    file.expect("}", label)
    return np.full(count, value, np.int64)
