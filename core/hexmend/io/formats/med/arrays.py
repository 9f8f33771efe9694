"""Arrays of a MED file, read once their size is known to be plausible."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

import numpy as np

from hexmend.errors import FileError
from hexmend.io.base.remedies import DAMAGED

#: Bytes of an array for each byte of the file, and bytes that are never too many.
_RATIO, _ALWAYS_ALLOWED = 200, 1 << 26


def max_bytes(path: Path) -> int:
    """Most bytes that an array of the file may have."""
    return max(_ALWAYS_ALLOWED, _RATIO * path.stat().st_size)


def read_array(path: Path, group: Mapping, name: str) -> np.ndarray:
    """Read an array of a group.

    Raises
    ------
    FileError
        For an array that is missing, or far larger than the file.
    """
    if name not in group:
        raise FileError(path, f"{group.name} has no {name}", DAMAGED)
    dataset = group[name]
    if int(np.prod(dataset.shape, dtype=object)) * dataset.dtype.itemsize > max_bytes(path):
        raise FileError(path, f"{group.name}/{name} declares more data than a file of its size can hold", DAMAGED)
    return np.asarray(dataset[()])


def read_integers(path: Path, group: Mapping, name: str, count: int) -> np.ndarray:
    """Read an array of whole numbers, (count,) int64.

    Raises
    ------
    FileError
        For an array of another type or length.
    """
    values = read_array(path, group, name)
    if values.shape != (count,) or values.dtype.kind not in "iu":
        raise FileError(path, f"{group.name}/{name} holds {values.size} numbers: expected {count}", DAMAGED)
    return values.astype(np.int64)
