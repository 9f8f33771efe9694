"""Polyhedra of an unstructured zone of a CGNS file (NGON_n and NFACE_n): hexes, wedges, pyramids and tetrahedra."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from hexmend.io.base.numbering import check_numbers
from hexmend.io.base.polyhedra import RaggedArray, cells_from_faces
from hexmend.io.formats.cgns.elements import NFACE, NGON
from hexmend.io.formats.cgns.section import CellGroup, CGNSSection
from hexmend.terminal_text import count_phrase


def polyhedra(sections: Sequence[CGNSSection], n_nodes: int, notes: list[str]) -> list[CellGroup]:
    """Cells of known kinds among polyhedra, and the triangles and quads of the boundary around these.

    Parameters
    ----------
    sections : sequence of CGNSSection
        In the order of their element numbers.
    n_nodes : int
    notes : list of str
        Notes on elements that are left out are appended.

    Raises
    ------
    FileError
        For a face or node that does not exist.
    """
    ngons = [section for section in sections if section.type == NGON]
    rows = [section.rows() for section in ngons]
    start = np.concatenate([[0], *(lists.lengths for lists in rows)]).cumsum()
    faces = RaggedArray(start, np.concatenate([np.empty(0, np.int64), *(lists.values for lists in rows)]) - 1)
    if ngons:
        check_numbers(ngons[0].node.path, "its faces use the nodes", faces.values, n_nodes)
    numbers = np.concatenate([np.empty(0, np.int64), *(np.arange(ngon.first, ngon.last + 1) for ngon in ngons)])
    n_cells, groups = np.zeros(len(faces), np.int64), []  # of each face
    for section in (section for section in sections if section.type == NFACE):
        cells = section.rows()
        index = np.searchsorted(numbers, np.abs(cells.values)).clip(0, max(0, len(numbers) - 1))
        if cells.values.size and (not len(numbers) or (numbers[index] != np.abs(cells.values)).any()):
            raise section.error("refers to faces that do not exist")
        outward = cells.values > 0  # the face's normal points out of the cell
        found = cells_from_faces(faces, RaggedArray(cells.start, index), outward)
        n_other = len(section) - sum(len(which) for which, _ in found.values())
        if n_other:
            notes.append(f"Left out: {count_phrase(n_other, 'polyhedron', 'polyhedra')} of section {section.name!r}.")
        n_cells += np.bincount(index, minlength=len(faces))
        for kind, (which, nodes) in found.items():
            groups.append(CellGroup(kind, nodes, section.first + which, section.name))
    first = 0
    for section, lists in zip(ngons, rows, strict=True):
        groups += _boundary_faces(section, lists, n_cells[first : first + len(lists)], notes)
        first += len(lists)
    return groups


def _boundary_faces(section: CGNSSection, rows: RaggedArray, n_cells: np.ndarray, notes: list[str]) -> list[CellGroup]:
    """Triangles and quads of an NGON_n section that bound one cell each."""
    widths, outer = rows.lengths, n_cells == 1
    n_other = int((n_cells == 0).sum() + (outer & (widths != 3) & (widths != 4)).sum())
    if n_other:
        polygons = f"{n_other:,} polygons of section {section.name!r}"
        notes.append(f"{polygons} that bound no polyhedron, or have more than 4 nodes, are left out.")
    groups = []
    for kind, width in (("triangle", 3), ("quad", 4)):
        which = np.flatnonzero(outer & (widths == width))
        if which.size:
            nodes = rows.values[rows.start[which][:, None] + np.arange(width)] - 1
            groups.append(CellGroup(kind, nodes, section.first + which, section.name))
    return groups
