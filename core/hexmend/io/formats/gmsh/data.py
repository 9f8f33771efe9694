"""Sections $NodeData and $ElementData of Gmsh's format, and the writer of a section's numbers."""

from __future__ import annotations

from typing import BinaryIO

import numpy as np

from hexmend.io.base.cursor import ByteCursor
from hexmend.io.base.decimals import format_rows, row_chunks
from hexmend.io.formats.gmsh.sections import DataSection, Sections
from hexmend.io.storage.file_progress import advance

#: Keywords of the sections of data.
DATA = ("$NodeData", "$ElementData")
#: Values of a row in Gmsh's own files (scalars, vectors, tensors), and the most that other files may have.
_WIDTHS, _MAX_WIDTH = (1, 3, 9), 1000
#: String, real and integer tags that a section may have of each.
_MAX_TAGS = 1000


def read_data(source: ByteCursor, order: str, key: str, sections: Sections) -> None:
    """Read a section of data: string tags (a name), real tags, integer tags (step, width, rows), and its rows.

    Parameters
    ----------
    source : ByteCursor
    order : str
        Byte order, "<" or ">"; "" for text.
    key : str
        One of `DATA`.
    sections : Sections
        The section is appended to its data.
    """
    names = [source.next_line() for _ in range(_count(source, key))]
    for _ in range(_count(source, key)):
        source.next_line()
    integers = [source.parse_count(source.next_line(), f"a number of {key}") for _ in range(_count(source, key))]
    if not names or len(integers) < 3 or not 1 <= integers[1] <= _MAX_WIDTH:
        raise source.error(f"{key} needs a name, a step, 1 to {_MAX_WIDTH} values a row, and a number of rows")
    name, (step, width, count) = names[0].strip('"'), integers[:3]
    if order:
        blocks = source.binary_blocks(key, count, 1, [("tag", f"{order}i4"), ("values", f"{order}f8", (width,))])
        tags, values = np.empty(count, np.int64), np.empty((count, width))
        for part, rows in blocks:
            tags[part], values[part] = rows["tag"][:, 0], rows["values"][:, 0]
    else:
        rows = source.read_numbers(key, count, 1 + width, np.float64)
        if not (np.isfinite(rows[:, 0]) & (np.abs(rows[:, 0]) < 2**53)).all():
            raise source.error(f"{key} holds tags that are not numbers")
        tags, values = rows[:, 0].astype(np.int64), rows[:, 1:].copy()
    end = f"$End{key[1:]}"
    if source.next_line() != end:
        raise source.error(f"{key} ends without {end} before {source.location}")
    of_nodes = key == "$NodeData"
    if any(other.name == name and other.of_nodes == of_nodes for other in sections.data):
        name = f"{name} ({step})"
    sections.data.append(DataSection(of_nodes, name, tags, values[:, 0] if width == 1 else values))


def _count(source: ByteCursor, key: str) -> int:
    """Number of the tags that follow."""
    count = source.parse_count(source.next_line(), f"a number of {key}")
    if count > _MAX_TAGS:
        raise source.error(f"{key} declares {count} words: expected a few")
    return count


class SectionWriter:
    """Writer of the numbers of sections, as text with a line for each row, or binary (little-endian).

    Parameters
    ----------
    file : BinaryIO
    binary : bool
    total : int
        Numbers that `rows` will write about, for the progress.
    """

    def __init__(self, file: BinaryIO, binary: bool, total: int):
        self.file, self.binary, self.total = file, binary, total

    def integers(self, *parts: tuple[object, str]) -> None:
        """Write a line of whole numbers; each part has its binary type, i4 or u8."""
        arrays = [(np.atleast_1d(np.asarray(values, np.int64)), code) for values, code in parts]
        if self.binary:
            self.file.write(b"".join(values.astype(f"<{code}").tobytes() for values, code in arrays))
        else:
            self.file.write(format_rows(np.concatenate([values for values, _ in arrays])[None]))

    def rows(self, values: np.ndarray) -> None:
        """Write rows of floats, or of whole numbers (u8)."""
        code = "<f8" if values.dtype.kind == "f" else "<u8"
        for part in row_chunks(len(values)):
            rows = values[part]
            self.file.write(rows.astype(code).tobytes() if self.binary else format_rows(rows))
            advance(rows.size, self.total)

    def end(self, name: bytes) -> None:
        """Write the end of the section of a name."""
        self.file.write((b"\n" if self.binary else b"") + b"$End%s\n" % name)


def data_title(name: str, end: str) -> str:
    """Name of data that the format can have: no double quotes, single spaces; `end` is appended."""
    return (" ".join(name.replace('"', "'").split()) or "unnamed") + end


def width_of_row(values: np.ndarray) -> int:
    """Number of values in each row of an array."""
    return int(np.prod(values.shape[1:], dtype=np.int64))


def written_width(values: np.ndarray) -> int | None:
    """Number of values in each row as written, 1, 3 or 9; None for other data than numbers, or more than nine."""
    width = width_of_row(values)
    return next((wide for wide in _WIDTHS if 1 <= width <= wide), None) if values.dtype.kind in "biuf" else None


def write_data(out: SectionWriter, key: str, name: str, tags: list[np.ndarray], data: list[np.ndarray]) -> None:
    """Write a section of data in rows of 1, 3 or 9 values, filled up with 0; other data are not written.

    Parameters
    ----------
    out : SectionWriter
    key : str
        One of `DATA`.
    name : str
    tags : list of (k,) int arrays
    data : list of (k, ...) arrays
        Arrays of several blocks, all of one width.
    """
    rows = [values.reshape(len(values), width_of_row(values)) for values in data]
    if len({values.shape[1] for values in rows}) > 1 or None in map(written_width, rows):
        return
    numbers, values = np.concatenate(tags), np.concatenate(rows).astype(np.float64)
    values = np.pad(values, ((0, 0), (0, written_width(values) - values.shape[1])))
    head = f'{key}\n1\n"{name}"\n1\n0\n3\n0\n{values.shape[1]}\n{len(values)}\n'
    out.file.write(head.encode())
    if out.binary:
        packed = np.empty(len(values), [("tag", "<i4"), ("values", "<f8", (values.shape[1],))])
        packed["tag"], packed["values"] = numbers, values
        out.file.write(packed.tobytes() + b"\n")
    else:
        for part in row_chunks(len(values)):
            texts = format_rows(values[part]).split(b"\n")
            out.file.write(b"".join(b"%d %s\n" % pair for pair in zip(numbers[part].tolist(), texts, strict=False)))
    out.file.write(b"$End%s\n" % key[1:].encode())
