"""Trees of plain data and arrays as a folder that is updated again and again; unchanged arrays are not rewritten.

An update first writes new arrays to files of their own, then replaces the description atomically, then removes arrays
that are not used any more. New arrays are on the disk before the description refers to them, so that the folder holds a
complete tree at any moment, even if the process is killed or the power fails.
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
from hexmend.io.storage.atomic import atomic_write
from hexmend.io.storage.temporary_files import flush_file, flush_folder, make_folder
from hexmend_app.formats.session.archive import encode_description, write_array
from hexmend_app.formats.session.members import ARRAYS, DESCRIPTION, MEMBER


class ArchiveFolder:
    """Folder that holds a tree; files of arrays are created and removed, never changed.

    Parameters
    ----------
    path : Path
        Created by the first `write`.
    """

    def __init__(self, path: Path):
        self.path = path
        self._written: dict[int, tuple[weakref.ref, int]] = {}  # by id of a living array: its number
        self._next = 0

    def write(self, format: str, version: int, data: Any) -> None:
        """Update the folder to a tree; parameters as of `hexmend_app.formats.session.archive.write_archive`.

        Raises
        ------
        FileError
            For a value of another type, and where the folder is not writable; the earlier tree stays.
        """
        used: dict[int, tuple[np.ndarray, int]] = {}
        fresh: list[tuple[np.ndarray, int]] = []
        present = self._prepare()

        def number(array: np.ndarray) -> int:
            if id(array) not in used:
                before = self._written.get(id(array))
                if before is not None and before[0]() is array and before[1] in present:
                    used[id(array)] = array, before[1]
                else:
                    fresh.append((array, self._next))
                    used[id(array)] = fresh[-1]
                    self._next += 1
            return used[id(array)][1]

        description = encode_description(self.path, format, version, data, number)
        try:
            for array, at in fresh:
                with open(self._file(at), "wb") as file:
                    write_array(file, array)
            for _, at in fresh:  # in a second loop, which lets the system write them together
                flush_file(self._file(at))
            if fresh:
                flush_folder(self.path / ARRAYS)
            with atomic_write(self.path / DESCRIPTION) as temporary:
                temporary.write_text(description, encoding="utf-8")
        except (OSError, FileError) as error:
            self._remove(at for _, at in fresh)
            if isinstance(error, FileError):
                raise
            raise FileError(
                self.path, f"cannot be written: {error.strerror or error}", "Check free space and permissions."
            ) from None
        self._written = {key: (weakref.ref(array), at) for key, (array, at) in used.items()}
        self._remove(set(self._numbers()) - {at for _, at in used.values()})

    def _prepare(self) -> frozenset[int]:
        """Make the folder; returns the numbers of its arrays, and does not reuse those of another writer."""
        try:
            make_folder(self.path / ARRAYS)
            present = frozenset(self._numbers())
        except OSError as error:
            raise FileError(
                self.path, f"cannot be written: {error.strerror or error}", "Check free space and permissions."
            ) from None
        if not self._written:
            self._next = max([self._next, *(at + 1 for at in present)])
        return present

    def _file(self, number: int) -> Path:
        return self.path / ARRAYS / f"{number}.npy"

    def _numbers(self) -> Iterable[int]:
        names = (f"{ARRAYS}/{name}" for name in os.listdir(self.path / ARRAYS))
        return [int(found[1]) for found in map(MEMBER.fullmatch, names) if found]

    def _remove(self, numbers: Iterable[int]) -> None:
        for number in numbers:
            with suppress(OSError):
                self._file(number).unlink()
