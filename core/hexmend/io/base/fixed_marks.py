"""Pins as data of the nodes named "fixed", for formats that have nothing else to mark fixed nodes with."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from hexmend.mesh.mesh import Mesh

#: Name of point data that mark fixed nodes.
FIXED = "fixed"


def find_marks(node_data: Mapping[str, np.ndarray]) -> tuple[str | None, np.ndarray | None]:
    """Name of the data that mark fixed nodes, and which those are, (n,) bool; None where no data do.

    They are the first called "fixed", in whatever capitals, with one number a node. One of 0, or NaN, is not fixed.
    """
    for name, values in node_data.items():
        marks = np.asarray(values)
        if name.lower() == FIXED and marks.ndim == 1 and marks.dtype.kind in "biuf":
            return name, (marks != 0) & ~np.isnan(marks)
    return None, None


def needs_marks(mesh: Mesh, marks: np.ndarray | None = None) -> bool:
    """Whether a file of the mesh has to mark fixed nodes so that its reader pins the same ones.

    Parameters
    ----------
    mesh : Mesh
    marks : (n,) bool, optional
        Nodes that the file marks anyway. Those of tetrahedra, pyramids and wedges every reader pins unmarked.
    """
    if mesh.pinned is None:
        return False
    known = np.zeros(mesh.n_nodes, bool) if marks is None else np.array(marks, bool)
    free_of_cells = np.ones(mesh.n_nodes, bool)
    for cells in mesh.cells:
        if cells.dimension == 3:
            free_of_cells[cells.nodes] = False
    return not np.array_equal(known[free_of_cells], mesh.pinned[free_of_cells])


def redundant_marks(mesh: Mesh) -> str | None:
    """Name of the data that say no more than the pins do, and need not be written beside them; None for none."""
    name, marks = find_marks(mesh.node_data) if needs_marks(mesh) else (None, None)
    return name if name is not None and (np.asarray(mesh.node_data[name])[marks] == 1).all() else None


def with_marks(mesh: Mesh) -> dict[str, np.ndarray]:
    """Data of the nodes, the pins among them as data named "fixed" unless the file said just that."""
    data = dict(mesh.node_data)
    name, marks = find_marks(data)
    if needs_marks(mesh, marks):
        if name is None:  # which other data may be called
            name = next((one for one in (FIXED, FIXED.title()) if one not in data), FIXED.upper())
        data[name] = mesh.pinned.astype(np.int32)  # what the file said, unless the pins have changed since
    return data
