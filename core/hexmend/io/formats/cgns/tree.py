"""Tree of CGNS's nodes in HDF5: a node is a group with a label, its data are the dataset " data".

*CGNS File Mapping Manual*, part "HDF5".
"""

from __future__ import annotations

from pathlib import Path

import numpy as np

from hexmend.errors import FileError
from hexmend.io.base import hdf5
from hexmend.io.base.hdf5 import text_of


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
        with hdf5.library_errors(path):
            self.label = text_of(group.attrs.get("label", b""))
            self._group = self._resolve_link(group)

    def _resolve_link(self, group: object) -> object:
        """Return the group, or the target of a link."""
        if text_of(group.attrs.get("type", b"")) != "LK":
            return group
        if " file" in group and (name := text_of(hdf5.read_dataset(self.path, group[" file"]).tobytes())):
            problem = f"its {self.name} is kept in another file, {name[:80]!r}"
            raise FileError(self.path, problem, "Open that file, or write both as one.")
        return group.file[text_of(hdf5.read_dataset(self.path, group[" path"]).tobytes())]

    def children(self, *labels: str) -> list[CGNSNode]:
        """Child nodes with one of these labels, ordered by name."""
        with hdf5.library_errors(self.path):
            groups = [(name, self._group[name]) for name in self._group if not name.startswith(" ")]
            found = [one for one in groups if text_of(one[1].attrs.get("label", b"")) in labels]
            return [CGNSNode(self.path, group, name) for name, group in found]

    def child(self, label: str) -> CGNSNode | None:
        """First child node with a label; None where there is none."""
        return next(iter(self.children(label)), None)

    def grandchildren(self, parent_label: str, label: str) -> list[CGNSNode]:
        """Child nodes with a label of all child nodes with another."""
        return [child for parent in self.children(parent_label) for child in parent.children(label)]

    def text_of(self, label: str, default: str = "") -> str:
        """Text of the first child node with a label."""
        child = self.child(label)
        return default if child is None else child.text()

    def child_named(self, name: str) -> CGNSNode | None:
        """Child node of a name, whatever its label; None where there is none."""
        with hdf5.library_errors(self.path):
            return CGNSNode(self.path, self._group[name], name) if name in self._group else None

    def value(self) -> np.ndarray:
        """Data of the node, with the axes of Fortran's order reversed; empty where there are none."""
        with hdf5.library_errors(self.path):
            exists = " data" in self._group
            data = self._group[" data"] if exists else None
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
            problem = f"{self.name} holds {values.dtype}: expected whole numbers"
            raise FileError(self.path, problem, "Write the file again with the program that made it.")
        return values.astype(np.int64)

    def integers_of(self, name: str) -> np.ndarray | None:
        """Data of the child node of a name as int64, flat; None where there is none."""
        child = self.child_named(name)
        return None if child is None else child.integers().ravel()

    def text(self) -> str:
        """Data of the node as a string."""
        return text_of(self.value().tobytes())


def boundary_conditions(node: CGNSNode) -> list[tuple[str, CGNSNode]]:
    """Boundary conditions of a zone by name, or by the name of their family."""
    return [(child.text_of("FamilyName_t") or child.name, child) for child in node.grandchildren("ZoneBC_t", "BC_t")]
