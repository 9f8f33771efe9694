"""Fixed nodes as point data named "fixed", for formats that have no other way to mark them."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from hexmend.mesh.mesh import Mesh

#: Name of point data that mark fixed nodes.
FIXED = "fixed"


def find_marks(node_data: Mapping[str, np.ndarray]) -> tuple[str | None, np.ndarray | None]:
    """Find point data that mark fixed nodes: the first one called "fixed", in any case, with one number a node.

    Parameters
    ----------
    node_data : mapping of str to (n, ...) array

    Returns
    -------
    name : str or None
    fixed : (n,) bool or None
        False where the number is 0 or NaN. Both are None if there are no such data.
    """
    for name, values in node_data.items():
        marks = np.asarray(values)
        if name.lower() == FIXED and marks.ndim == 1 and marks.dtype.kind in "biuf":
            return name, (marks != 0) & ~np.isnan(marks)
    return None, None


def needs_marks(mesh: Mesh, marks: np.ndarray | None = None) -> bool:
    """Return True if a file must mark fixed nodes so that its reader pins the same nodes.

    Parameters
    ----------
    mesh : Mesh
    marks : (n,) bool, optional
        Nodes that the file marks in any case.
    """
    if mesh.pinned is None:
        return False
    marked = np.zeros(mesh.n_nodes, bool) if marks is None else np.array(marks, bool)
    return not np.array_equal(marked, mesh.pinned)


def redundant_marks(mesh: Mesh) -> str | None:
    """Return the name of point data that repeat the fixed nodes and need not be written; None if there are none."""
    name, marks = find_marks(mesh.node_data) if needs_marks(mesh) else (None, None)
    return name if name is not None and (np.asarray(mesh.node_data[name])[marks] == 1).all() else None


def with_marks(mesh: Mesh) -> dict[str, np.ndarray]:
    """Copy the point data of a mesh and add the marks of fixed nodes, where a file needs them."""
    data = dict(mesh.node_data)
    name, marks = find_marks(data)
    if needs_marks(mesh, marks):
        if name is None:  # other data, such as vectors, may have the name
            name = next((title for title in (FIXED, FIXED.title()) if title not in data), FIXED.upper())
        data[name] = mesh.pinned.astype(np.int32)
    return data
