"""Content of a file that is read into memory piece by piece."""

from __future__ import annotations

import weakref
from pathlib import Path

import numpy as np

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
