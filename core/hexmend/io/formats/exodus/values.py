"""Variables of an ExodusII file as what they have to be."""

from __future__ import annotations

import re
from collections.abc import Mapping
from pathlib import Path

import numpy as np

from hexmend.errors import FileError
from hexmend.io.formats.exodus.store import ExodusStore

DAMAGED = "Write the file again with the program that made it: it is damaged or cut short."
_COMPONENT = re.compile(r"(.+)_(x|1)$", re.IGNORECASE)


class Values:
    """The variables of one file; whatever is not of the kind or length that is asked for is a `FileError`.

    Parameters
    ----------
    path : Path
    store : ExodusStore
    last : int
        The time step that is read, from 0.
    """

    def __init__(self, path: Path, store: ExodusStore, last: int):
        self.path, self.store, self.last = path, store, last

    def array(self, name: str, *shape: int) -> np.ndarray:
        """Numbers, of exactly this shape."""
        values = self.store.array(name, self.last)
        if values.dtype.kind not in "iuf" or values.shape != shape:
            raise FileError(
                self.path, f"variable {name!r} holds {values.dtype} {values.shape}: expected numbers {shape}", DAMAGED
            )
        return values

    def whole(self, name: str, *shape: int) -> np.ndarray:
        """Whole numbers, of exactly this shape; int64."""
        values = self.array(name, *shape)
        if values.dtype.kind == "f":
            raise FileError(self.path, f"variable {name!r} holds {values.dtype}: expected whole numbers", DAMAGED)
        return values.astype(np.int64)

    def members(self, name: str, dimension: str, bound: int, what: str) -> np.ndarray:
        """Numbers of nodes or elements, from 0."""
        members = self.whole(name, self.store.dimensions.get(dimension, 0)) - 1
        if members.size and (members.min() < 0 or members.max() >= bound):
            raise FileError(
                self.path,
                f"{name!r} names the {what} {members.min() + 1} to {members.max() + 1}: expected 1 to {bound}",
                DAMAGED,
            )
        return members

    def ids(self, name: str, dimension: str) -> list[int]:
        """The ids of blocks or of sets, of which there are as many as a dimension says; from 1 where none are told."""
        count = self.store.dimensions.get(dimension, 0)
        if count > len(self.store):  # each has a variable at least
            raise FileError(self.path, f"{dimension} is {count}, of {len(self.store)} variables", DAMAGED)
        return self.whole(name, count).tolist() if name in self.store else list(range(1, count + 1))

    def words(self, name: str) -> list[str]:
        """Texts; none where the variable holds anything else."""
        values = self.store.array(name, self.last)
        if values.dtype.kind != "S" or values.ndim != 2:
            return []
        rows = [bytes(row.tobytes()).split(b"\0")[0] for row in values]
        return [row.decode("utf-8", errors="replace").strip() for row in rows]


def with_columns(found: Mapping[str, np.ndarray]) -> dict[str, np.ndarray]:
    """Arrays of which those called a_x a_y a_z, or a_1 a_2 ..., are one with columns."""
    left, answer = dict(found), {}
    while left:
        name = next(iter(left))
        match = _COMPONENT.match(name)
        parts = [name]
        if match:
            start, mark = match.groups()
            ends = ["x", "y", "z"] if mark in "xX" else [str(k) for k in range(1, len(left) + 1)]
            parts = [start + "_" + (end.upper() if mark == "X" else end) for end in ends]
            parts = parts[: next((k for k, part in enumerate(parts) if part not in left), len(parts))]
            if len(parts) < (3 if mark in "xX" else 2) or start in found:
                parts = [name]
        arrays = [left.pop(part) for part in parts]
        answer[match[1] if len(parts) > 1 else name] = np.column_stack(arrays) if len(parts) > 1 else arrays[0]
    return answer
