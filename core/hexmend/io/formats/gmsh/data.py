"""$NodeData and $ElementData of Gmsh's format, and its numbers as they are written."""

from __future__ import annotations

from typing import BinaryIO

import numpy as np

from hexmend.io.base.cursor import ByteCursor
from hexmend.io.base.decimals import format_rows, row_chunks
from hexmend.io.formats.gmsh.content import Data, Read

#: The sections, and what their rows belong to.
DATA = {"$NodeData": "nodes", "$ElementData": "elements"}
#: How many values a row has in Gmsh's own files, and how many it may have in those of others.
_WIDTHS, _WIDEST = (1, 3, 9), 1000


def read_data(source: ByteCursor, order: str, key: str, result: Read) -> None:
    """A section of data: a name, times, the step, and how many values a row and how many rows there are."""
    titles = [source.next_line() for _ in range(_count(source, key))]
    for _ in range(_count(source, key)):
        source.next_line()
    whole = [source.parse_count(source.next_line(), f"a number of {key}") for _ in range(_count(source, key))]
    if not titles or len(whole) < 3 or not 1 <= whole[1] <= _WIDEST:
        raise source.error(f"{key} has not a name, a step, 1 to {_WIDEST} values a row, and a number of rows")
    name, (step, width, count) = titles[0].strip('"'), whole[:3]
    if order:
        rows = source.read_binary(key, count, 1, [("tag", f"{order}i4"), ("values", f"{order}f8", (width,))])[:, 0]
        tags, values = rows["tag"].astype(np.int64), rows["values"].astype(np.float64)
    else:
        rows = source.read_numbers(key, count, 1 + width, np.float64)
        if not (np.isfinite(rows[:, 0]) & (np.abs(rows[:, 0]) < 2**53)).all():
            raise source.error(f"{key} holds tags that are no numbers")
        tags, values = rows[:, 0].astype(np.int64), rows[:, 1:].copy()
    end = f"$End{key[1:]}"
    if source.next_line() != end:
        raise source.error(f"{key} ends without {end} before {source.location}")
    if any(one.name == name and one.of_nodes == (key == "$NodeData") for one in result.data):
        name = f"{name} ({step})"
    result.data.append(Data(key == "$NodeData", name, tags, values[:, 0] if width == 1 else values))


def _count(source: ByteCursor, key: str) -> int:
    count = source.parse_count(source.next_line(), f"a number of {key}")
    if count > 1000:
        raise source.error(f"{key} announces {count} words: expected a few")
    return count


class DataWriter:
    """Numbers as text, a row a line, or binary."""

    def __init__(self, file: BinaryIO, binary: bool):
        self.file, self.binary = file, binary

    def whole(self, *parts: tuple[object, str]) -> None:
        """A line of whole numbers, each part with its type in binary, i4 or u8."""
        arrays = [(np.atleast_1d(np.asarray(values, np.int64)), code) for values, code in parts]
        if self.binary:
            self.file.write(b"".join(values.astype(f"<{code}").tobytes() for values, code in arrays))
        else:
            self.file.write(format_rows(np.concatenate([values for values, _ in arrays])[None]))

    def rows(self, values: np.ndarray) -> None:
        """Rows of floats, or of whole numbers of the type u8."""
        if self.binary:
            self.file.write(values.astype("<f8" if values.dtype.kind == "f" else "<u8").tobytes())
        else:
            for part in row_chunks(len(values)):
                self.file.write(format_rows(values[part]))

    def end(self, name: bytes) -> None:
        self.file.write((b"\n" if self.binary else b"") + b"$End%s\n" % name)


def data_title(name: str, end: str) -> str:
    """The name of data as the format can have it, with an end."""
    return (" ".join(name.replace('"', "'").split()) or "unnamed") + end


def width_of_row(values: np.ndarray) -> int:
    """How many values a row of an array has."""
    return int(np.prod(values.shape[1:], dtype=np.int64))


def written_width(values: np.ndarray) -> int | None:
    """How many values a row is written with, 1, 3 or 9; None for what is no number or has more than nine."""
    width = width_of_row(values)
    return next((one for one in _WIDTHS if 1 <= width <= one), None) if values.dtype.kind in "biuf" else None


def write_data(out: DataWriter, key: str, name: str, tags: list[np.ndarray], data: list[np.ndarray]) -> None:
    """A section of data, in rows of 1, 3 or 9 values, of which some are 0 where there are fewer.

    What is no number, or has more than nine values a row, is not written.
    """
    rows = [values.reshape(len(values), width_of_row(values)) for values in data]
    if len({one.shape[1] for one in rows}) > 1 or None in map(written_width, rows):
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
