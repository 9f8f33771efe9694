"""Tree of CGNS's nodes in HDF5: a node is a group with a label, its data are the dataset " data".

*CGNS File Mapping Manual*, part "HDF5".
"""

from __future__ import annotations

from pathlib import Path

import numpy as np

from hexmend.errors import FileError
from hexmend.io.base import hdf5

#: Exceptions of h5py for damaged files.
_FAILURES = (OSError, RuntimeError, ValueError, KeyError, TypeError, AttributeError)


class CGNSNode:
    """Node of the tree.

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
            self._group = self._resolve_link(group)
        except _FAILURES as error:
            raise hdf5.damaged_file(path, error) from None

    def _resolve_link(self, group: object) -> object:
        """Return the group, or the target of a link."""
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
        """Child nodes with one of these labels, ordered by name."""
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
        """First child node with a label; None where there is none."""
        return next(iter(self.children(label)), None)

    def child_named(self, name: str) -> CGNSNode | None:
        """Child node of a name, whatever its label; None where there is none."""
        try:
            return CGNSNode(self.path, self._group[name], name) if name in self._group else None
        except _FAILURES as error:
            raise hdf5.damaged_file(self.path, error) from None

    def value(self) -> np.ndarray:
        """Data of the node, with the axes of Fortran's order reversed; empty where there are none."""
        try:
            exists = " data" in self._group
            data = self._group[" data"] if exists else None
        except _FAILURES as error:
            raise hdf5.damaged_file(self.path, error) from None
        return hdf5.read_dataset(self.path, data) if exists else np.empty(0)

    def integers(self) -> np.ndarray:
        """Data of the node as int64.

        Raises
        ------
        FileError
            Unless they are whole numbers.
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
        """Data of the node as a string."""
        return _text(self.value().tobytes())


def _text(value: object) -> str:
    """Text up to the first zero byte, stripped."""
    value = value if isinstance(value, str) else bytes(value).decode("utf-8", errors="replace")
    return value.split("\0")[0].strip()
