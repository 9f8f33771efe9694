"""Formatting and parsing of decimal numbers, the slowest part of text files."""

from __future__ import annotations

import numpy as np

from hexmend.io.storage.binary_rows import FileBytes
from hexmend.kernels import decimals

#: Rows that are formatted at a time, which limits the memory for the text of a large mesh.
CHUNK_ROWS = 65536


def format_rows(values: np.ndarray, last: np.ndarray | None = None) -> bytes:
    """Format rows of numbers, one a line; floats as the shortest text that gives the same number back.

    Parameters
    ----------
    values : (n, ...) array of int or float
        All but the first axis belong to a row.
    last : (n,) array of int, optional
        Appended to each row of floats.

    Returns
    -------
    bytes
        n lines.

    Examples
    --------
    >>> format_rows(np.array([[1, 20], [300, 0]]))
    b'1 20\\n300 0\\n'
    >>> format_rows(np.array([0.1, 1e300]), np.array([7, 100000]))
    b'0.1 7\\n1e+300 100000\\n'
    """
    rows = values.reshape(len(values), -1)
    if rows.dtype == np.uint64 and rows.size and rows.max() > np.iinfo(np.int64).max:
        return b"".join(b" ".join(b"%d" % value for value in row) + b"\n" for row in rows.tolist())
    if rows.dtype.kind in "iu":
        return decimals.whole_lines(np.ascontiguousarray(rows, np.int64).ravel(), rows.shape[1])
    behind = np.ascontiguousarray([] if last is None else last, np.int64)
    return decimals.decimal_lines(np.ascontiguousarray(rows, np.float64).ravel(), rows.shape[1], behind)


def row_chunks(count: int) -> list[slice]:
    """Split `count` rows into slices that are formatted and written at a time."""
    return [slice(begin, begin + CHUNK_ROWS) for begin in range(0, count, CHUNK_ROWS)]


def parse_numbers(text: bytes, dtype: np.dtype | type) -> np.ndarray | None:
    """Parse the numbers of a text; None if it holds something else."""
    try:
        return np.fromstring(text, dtype=dtype, sep=" ")
    except (ValueError, DeprecationWarning):  # NumPy before 2.3 only warns and gives fewer numbers than words
        return None


def exceeds_dtype(values: np.ndarray, text: bytes) -> bool:
    """Return True if a word of the text exceeds the integer type of `values`, to whose limits NumPy clips it."""
    limits = np.iinfo(values.dtype)
    if not values.size or (values.max() < limits.max and (limits.min == 0 or values.min() > limits.min)):
        return False
    return not all(limits.min <= int(word) <= limits.max for word in text.split()[: values.size])


def count_words(text: bytes | FileBytes, begin: int = 0, end: int | None = None) -> int:
    """Count the words of a text between two offsets, 16 MB at a time to limit the memory."""
    total, before, end = 0, True, len(text) if end is None else end
    for start in range(begin, end, 1 << 24):
        part = text[start : min(start + (1 << 24), end)]
        space = np.frombuffer(part, np.uint8) <= 32
        total += int(before and not space[0]) + int(np.count_nonzero(space[:-1] & ~space[1:]))
        before = bool(space[-1])
    return total
