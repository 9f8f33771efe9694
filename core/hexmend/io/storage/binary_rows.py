"""Rows of binary numbers of a file, read block by block, and whole numbers in 32 bits where they fit.

Content of a file that is read into memory piece by piece.

A function over many items in as many threads as the kernels use, for functions that leave Python's lock.
"""

from __future__ import annotations

import weakref
from collections.abc import Callable, Iterable, Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import TypeVar

import numpy as np

from hexmend.io.storage.file_progress import report
from hexmend.kernels import threads

#: Bytes that are read at a time where a few are asked for, and where a mark is searched.
_WINDOW, _SEARCHED = 1 << 16, 1 << 22


class FileBytes:
    """Bytes of an open file: length, slices, `find` and `count` as of `bytes`.

    A mapped file would end the process if another program shortened it meanwhile; here bytes are missing.

    Parameters
    ----------
    path : Path

    Raises
    ------
    OSError
        Where the file cannot be read; so do all methods.
    """

    def __init__(self, path: Path):
        self._file = open(path, "rb", buffering=0)  # noqa: SIM115  (closed by the finalizer)
        weakref.finalize(self, self._file.close)
        self._size = self._file.seek(0, 2)
        self._window, self._begin = b"", 0

    def __len__(self) -> int:
        return self._size

    def __getitem__(self, part: slice) -> bytes:
        begin, end, _ = part.indices(self._size)
        if end - begin > _WINDOW:
            return self._read(begin, end - begin)
        if begin < self._begin or end > self._begin + len(self._window):
            self._window, self._begin = self._read(begin, _WINDOW), begin
        return self._window[begin - self._begin : max(begin, end) - self._begin]

    def read_into(self, at: int, array: np.ndarray) -> int:
        """Read the bytes from the offset `at` into a contiguous array; returns their number, fewer at the end."""
        view, done = memoryview(array.reshape(-1).view(np.uint8)), 0
        self._file.seek(at)
        while done < len(view):
            count = self._file.readinto(view[done:])
            if not count:
                break
            done += count
        return done

    def find(self, mark: bytes, begin: int = 0) -> int:
        """Return the offset of the first `mark` from an offset on; -1 without one."""
        for size in (_WINDOW, _SEARCHED):  # it is mostly near
            while begin < self._size:
                found = self[begin : begin + size].find(mark)
                if found >= 0:
                    return begin + found
                if begin + size >= self._size:
                    return -1
                begin += size - len(mark) + 1
                if size == _WINDOW:
                    break
        return -1

    def count(self, mark: bytes, begin: int, end: int) -> int:
        """Count a mark of one byte between two offsets."""
        parts = range(begin, min(end, self._size), _SEARCHED)
        return sum(self[at : min(at + _SEARCHED, end)].count(mark) for at in parts)

    def _read(self, at: int, size: int) -> bytes:
        """Read bytes from an offset, fewer at the end."""
        self._file.seek(at)
        parts = []
        while size > 0 and (part := self._file.read(size)):
            parts.append(part)
            size -= len(part)
        return parts[0] if len(parts) == 1 else b"".join(parts)


#: Bytes that are read at a time, and bytes that are few.
_BLOCK, _FEW = 1 << 22, 1 << 12
#: Share of the work on a binary file that reading its bytes is.
_SHARE = 0.45
_LIMITS = np.iinfo(np.int32)


def read_rows(data: bytes | FileBytes, at: int, rows: int, width: int, dtype: np.dtype) -> np.ndarray:
    """Read rows of numbers, which the data are long enough for, and report the progress.

    Parameters
    ----------
    data : bytes or FileBytes
    at : int
        Offset of the first byte.
    rows, width : int
    dtype : numpy dtype
        In the file, with its byte order.

    Returns
    -------
    (rows, width) array
        Read-only for bytes and for few rows of a file, else an array of its own.

    Raises
    ------
    OSError
        Where another program has shortened the file meanwhile.
    """
    if isinstance(data, bytes):
        return np.frombuffer(data, dtype, rows * width, at).reshape(rows, width)
    size = rows * width * dtype.itemsize
    if size <= _FEW:
        return np.frombuffer(data[at : at + size], dtype, rows * width).reshape(rows, width)
    values = np.empty((rows, width), dtype)
    for part in row_blocks(rows, width * dtype.itemsize):
        _fill(data, at + part.start * width * dtype.itemsize, values[part])
    return values


def read_blocks(
    data: bytes | FileBytes, at: int, rows: int, width: int, dtype: np.dtype
) -> Iterator[tuple[slice, np.ndarray]]:
    """Read rows of numbers block by block; parameters and errors are those of `read_rows`.

    Yields
    ------
    part : slice
        Of the rows.
    values : (k, width) array
        In the byte order of the file; valid until the next block.
    """
    size = width * dtype.itemsize
    parts = row_blocks(rows, size)
    if isinstance(data, bytes):
        values = read_rows(data, at, rows, width, dtype)
        yield from ((part, values[part]) for part in parts)
        return
    buffer = np.empty((parts[0].stop if parts else 0, width), dtype)
    for part in parts:
        values = buffer[: part.stop - part.start]
        _fill(data, at + part.start * size, values)
        yield part, values


def row_blocks(rows: int, row_size: int) -> list[slice]:
    """Split rows of so many bytes into blocks that are read at a time."""
    step = max(1, _BLOCK // max(1, row_size))
    return [slice(begin, min(begin + step, rows)) for begin in range(0, rows, step)]


def native(values: np.ndarray) -> np.ndarray:
    """Return numbers in the byte order of the machine; an array that is not read-only may be changed in place."""
    if not values.flags.writeable:
        return values.astype(values.dtype.newbyteorder("="))
    return values if values.dtype.isnative else values.byteswap(inplace=True).view(values.dtype.newbyteorder("="))


def _fill(data: FileBytes, at: int, values: np.ndarray) -> None:
    if data.read_into(at, values) < values.nbytes:
        raise OSError("another program has shortened it meanwhile")
    report(_SHARE * (at + values.nbytes), len(data))


def gather_integers(shape: tuple[int, ...], blocks: Iterable[tuple[slice, np.ndarray]]) -> np.ndarray:
    """Gather blocks of rows of whole numbers in one array.

    Parameters
    ----------
    shape : tuple of int
    blocks : iterable of (slice, array of int)
        Rows and their values, of any type and byte order; each is read before the next is asked for.

    Returns
    -------
    array
        Of the given shape, int32 if all numbers fit, else int64; unsigned numbers of 64 bits and above 2^63 wrap.

    Examples
    --------
    >>> gather_integers((2,), [(slice(0, 1), np.array([5])), (slice(1, 2), np.array([7], ">u8"))]).dtype
    dtype('int32')
    >>> gather_integers((1,), [(slice(0, 1), np.array([1 << 40]))])
    array([1099511627776])
    """
    values = np.empty(shape, np.int32)
    for rows, block in blocks:
        if values.dtype == np.int32 and not _fits(block):
            values = values.astype(np.int64)
        values[rows] = block
    return values


def _fits(block: np.ndarray) -> bool:
    """Return True if the numbers of a block have 32 bits."""
    if not block.size or np.can_cast(block.dtype, np.int32):
        return True
    return bool(block.max() <= _LIMITS.max and block.min() >= _LIMITS.min)


T = TypeVar("T")
R = TypeVar("R")


def parallel_map(function: Callable[[T], R], items: Sequence[T]) -> Iterator[R]:
    """Yield function(item) of each item in turn; as many are computed at once as the kernels have threads.

    Parameters
    ----------
    function : callable
        Such as one that compresses a block by zlib.
    items : sequence

    Raises
    ------
    Exception
        That of the first item for which the function raises one.

    Examples
    --------
    >>> list(parallel_map(len, ["a", "bb", ""]))
    [1, 2, 0]
    """
    count = threads()
    if count == 1 or len(items) < 2:
        yield from map(function, items)
        return
    with ThreadPoolExecutor(count) as pool:
        for begin in range(0, len(items), count):
            batch = items[begin : begin + count]
            try:
                results = pool.map(function, batch)
            except RuntimeError:  # the system starts no more threads
                results = map(function, batch)
            yield from results
