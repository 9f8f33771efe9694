"""CGNS's tree of nodes as HDF5 keeps it: a node is a group with a label, and its data are a dataset called " data"."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from hexmend.errors import FileError
from hexmend.io.base import hdf5

#: What the library raises where a file is damaged.
_FAILURES = (OSError, RuntimeError, ValueError, KeyError, TypeError, AttributeError)


class CGNSNode:
    """A node of the tree.

    Parameters
    ----------
    path : Path
        The file.
    group : h5py.Group
    name : str
    """

    def __init__(self, path: Path, group: object, name: str = ""):
        self.path, self.name = path, name
        try:
            self.label = _text(group.attrs.get("label", b""))
            self._group = self._followed(group)
        except _FAILURES as error:
            raise hdf5.damaged_file(path, error) from None

    def _followed(self, group: object) -> object:
        """The group, or that to which a link leads."""
        if _text(group.attrs.get("type", b"")) != "LK":
            return group
        if " file" in group and (name := _text(hdf5.read_dataset(self.path, group[" file"]).tobytes())):
            raise FileError(
                self.path,
                f"its {self.name} is kept in another file, {name[:80]!r}",
                "Open that file, or write both as one.",
            )
        return group.file[_text(hdf5.read_dataset(self.path, group[" path"]).tobytes())]

    def children(self, *labels: str) -> list[CGNSNode]:
        """Nodes below this one that have one of some labels, by name."""
        try:
            return [
                CGNSNode(self.path, self._group[name], name)
                for name in self._group
                if not name.startswith(" ") and _text(self._group[name].attrs.get("label", b"")) in labels
            ]
        except FileError:
            raise
        except _FAILURES as error:
            raise hdf5.damaged_file(self.path, error) from None

    def child(self, label: str) -> CGNSNode | None:
        """The first node below this one that has a label."""
        return next(iter(self.children(label)), None)

    def named(self, name: str) -> CGNSNode | None:
        """The node below this one that has a name, whatever its label."""
        try:
            return CGNSNode(self.path, self._group[name], name) if name in self._group else None
        except _FAILURES as error:
            raise hdf5.damaged_file(self.path, error) from None

    def value(self) -> np.ndarray:
        """The data, axes in Fortran's order reversed; empty where there are none."""
        try:
            there = " data" in self._group
            data = self._group[" data"] if there else None
        except _FAILURES as error:
            raise hdf5.damaged_file(self.path, error) from None
        return hdf5.read_dataset(self.path, data) if there else np.empty(0)

    def numbers(self) -> np.ndarray:
        """The data as 64-bit integers.

        Raises
        ------
        FileError
            Where they are no whole numbers.
        """
        values = self.value()
        if values.dtype.kind not in "iu":
            raise FileError(
                self.path,
                f"{self.name} holds {values.dtype}: expected whole numbers",
                "Write the file again with the program that made it.",
            )
        return values.astype(np.int64)

    def text(self) -> str:
        """The data as a text."""
        return _text(self.value().tobytes())


def _text(value: object) -> str:
    value = value if isinstance(value, str) else bytes(value).decode("utf-8", errors="replace")
    return value.split("\0")[0].strip()
