"""Arrays of VTK's legacy format: numbers in decimals or big-endian bytes, strings, and lists of cells."""

from __future__ import annotations

from urllib.parse import unquote

import numpy as np

from hexmend.io.base.cursor import ByteCursor, quoted
from hexmend.io.base.polyhedra import RaggedArray
from hexmend.io.storage.binary_rows import native

#: NumPy types of VTK's types, without the byte order.
TYPES = {
    "bit": "u1", "char": "i1", "signed_char": "i1", "unsigned_char": "u1", "short": "i2", "unsigned_short": "u2",
    "int": "i4", "unsigned_int": "u4", "long": "i8", "unsigned_long": "u8", "vtktypeint64": "i8",
    "vtktypeuint64": "u8", "vtkidtype": "i4", "float": "f4", "double": "f8",
}  # fmt: skip
#: VTK's types of texts.
STRINGS = ("string", "utf8_string")


def read_array(cursor: ByteCursor, section: str, rows: int, width: int, kind: str) -> np.ndarray:
    """Read numbers of a VTK type.

    Parameters
    ----------
    cursor : ByteCursor
    section : str
        Name in error messages.
    rows, width : int
    kind : str
        VTK's name of the type.

    Returns
    -------
    (rows, width) array
        In the machine's byte order; real numbers of text files are float64.

    Raises
    ------
    FileError
        For an unknown type, missing numbers, and numbers outside the range of the type.
    """
    code = TYPES.get(kind.lower())
    if code is None:
        raise cursor.error(f"{section} has the type {quoted(kind)}: expected {', '.join(TYPES)}")
    if cursor.is_text:
        wide = np.float64 if code[0] == "f" else np.uint64 if code == "u8" else np.int64
        values = cursor.read_numbers(section, rows, width, wide)
        if code[0] == "f":
            return values
        limit = np.iinfo(code)
        if values.size and (values.min() < limit.min or values.max() > limit.max):
            row, column = np.argwhere((values < limit.min) | (values > limit.max))[0]
            problem = f"{section} holds {values[row, column]} in row {row + 1} of {rows}"
            raise cursor.error(f"{problem}, which its type {kind} cannot")
        return values.astype(code)
    if kind.lower() == "bit":
        bits = np.unpackbits(np.frombuffer(cursor.read_bytes((rows * width + 7) // 8, section), np.uint8))
        return bits[: rows * width].reshape(rows, width)
    return native(cursor.read_binary(section, rows, width, f">{code}"))


def read_integers(cursor: ByteCursor, section: str, rows: int, kind: str) -> np.ndarray:
    """Read whole numbers of a VTK type, (rows,) int32 where they fit and the file is binary; see `read_array`."""
    if TYPES.get(kind.lower(), "i8")[0] == "f":
        raise cursor.error(f"{section} has the type {kind}: expected whole numbers")
    code = TYPES.get(kind.lower())
    if code is not None and not cursor.is_text and kind.lower() != "bit":
        return cursor.read_integers(section, rows, 1, f">{code}")[:, 0]
    return read_array(cursor, section, rows, 1, kind)[:, 0]


def read_strings(cursor: ByteCursor, count: int) -> list[str]:
    """Read strings: one a line in text files, each after its length in binary files."""
    if count > len(cursor.data) - cursor.pos:
        raise cursor.error(f"{count} strings are declared before {cursor.location}: the file ends before")
    if cursor.is_text:
        return [unquote(cursor.rest_of_line()) for _ in range(count)]
    strings = []
    for _ in range(count):
        # The first two bits of the length tell its size in bytes: 11 one, 10 two, 01 four, 00 eight.
        size = 8 >> cursor.read_bytes(1, "a string")[0] // 64
        cursor.pos -= 1
        length = int.from_bytes(cursor.read_bytes(size, "a string"), "big") & ((1 << 8 * size - 2) - 1)
        strings.append(cursor.read_bytes(length, "a string").decode("utf-8", errors="replace"))
    return strings


def split_cells(cursor: ByteCursor, flat: np.ndarray, count: int) -> tuple[np.ndarray, np.ndarray]:
    """Split the numbers of a section CELLS, in which each cell is its number of nodes and these.

    Parameters
    ----------
    cursor : ByteCursor
        Raises the errors.
    flat : (k,) int32 or int64
    count : int
        Number of cells.

    Returns
    -------
    start : (count + 1,) int64
        Cell i has the nodes nodes[start[i]:start[i + 1]].
    nodes : (start[-1],) int
        Of the type of `flat`.

    Raises
    ------
    FileError
        Where the numbers do not make `count` cells.
    """
    if len(flat) == 9 * count and (flat[::9] == 8).all():
        return 8 * np.arange(count + 1), np.ascontiguousarray(flat.reshape(-1, 9)[:, 1:]).ravel()
    cells, whole = RaggedArray.of_counted_rows(flat)
    if len(cells) > count:
        raise cursor.error(f"CELLS holds {len(flat)} numbers: its {count} cells need {cells.start[count] + count}")
    if len(cells) < count or not whole:
        raise cursor.error(f"CELLS ends in cell {len(cells) - (not whole)} of the {count} that CELL_TYPES names")
    return cells.start, cells.values
