"""A tree of plain data and arrays as a folder, written again and again: of arrays that are there only once.

Arrays come first, in files of their own; then the description, as a whole or not at all; then arrays that it does not
name go. So the folder is at any moment the tree that was written last, whenever the writer is killed or the power is
cut: new arrays are on the disk before the description names them.
"""

from __future__ import annotations

import os
import weakref
from collections.abc import Iterable
from contextlib import suppress
from pathlib import Path
from typing import Any

import numpy as np

from hexmend.errors import FileError
from hexmend.io.archive.archive import encode_description, write_array
from hexmend.io.archive.members import ARRAYS, DESCRIPTION, MEMBER
from hexmend.io.storage.atomic import atomic_write
from hexmend.io.storage.temporary_files import flush_file, flush_folder, make_folder


class ArchiveFolder:
    """A folder that holds a tree; arrays in it are never changed, and those that were removed are written again.

    Parameters
    ----------
    path : Path
        It is made when something is written, below a folder that is there.
    """

    def __init__(self, path: Path):
        self.path = path
        self._there: dict[int, tuple[weakref.ref, int]] = {}  # by id, while the array lives: its number
        self._next = 0

    def write(self, format: str, version: int, data: Any) -> None:
        """Write a tree, as `hexmend.io.archive.archive.write_archive` takes it: what is new of it, and its description.

        Raises
        ------
        FileError
            For a value that is no data, and where the folder cannot be written to; what was there stays.
        """
        named: dict[int, tuple[np.ndarray, int]] = {}
        fresh: list[tuple[np.ndarray, int]] = []
        there = self._begin()

        def number(array: np.ndarray) -> int:
            if id(array) not in named:
                before = self._there.get(id(array))
                if before is not None and before[0]() is array and before[1] in there:
                    named[id(array)] = array, before[1]
                else:
                    fresh.append((array, self._next))
                    named[id(array)] = fresh[-1]
                    self._next += 1
            return named[id(array)][1]

        description = encode_description(self.path, format, version, data, number)
        try:
            for array, at in fresh:
                with open(self._file(at), "wb") as file:
                    write_array(file, array)
            for _, at in fresh:  # after all of them are written, which lets the system write them together
                flush_file(self._file(at))
            if fresh:
                flush_folder(self.path / ARRAYS)
            with atomic_write(self.path / DESCRIPTION) as temporary:
                temporary.write_text(description, encoding="utf-8")
        except (OSError, FileError) as error:
            self._remove(at for _, at in fresh)
            if isinstance(error, FileError):
                raise
            raise FileError(self.path, f"cannot be written: {error.strerror or error}", "Free the place.") from None
        self._there = {key: (weakref.ref(array), at) for key, (array, at) in named.items()}
        self._remove(set(self._numbers()) - {at for _, at in named.values()})

    def _begin(self) -> frozenset[int]:
        """Make the folder: the numbers there; of what another writer has left there, none is given again."""
        try:
            make_folder(self.path / ARRAYS)
            there = frozenset(self._numbers())
        except OSError as error:
            raise FileError(self.path, f"cannot be written: {error.strerror or error}", "Free the place.") from None
        if not self._there:
            self._next = max([self._next, *(at + 1 for at in there)])
        return there

    def _file(self, number: int) -> Path:
        return self.path / ARRAYS / f"{number}.npy"

    def _numbers(self) -> Iterable[int]:
        names = (f"{ARRAYS}/{name}" for name in os.listdir(self.path / ARRAYS))
        return [int(found[1]) for found in map(MEMBER.fullmatch, names) if found]

    def _remove(self, numbers: Iterable[int]) -> None:
        for number in numbers:
            with suppress(OSError):
                self._file(number).unlink()
