"""Polyhedra of an unstructured zone of a CGNS file (NGON_n and NFACE_n): those that are hexes and the like."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from hexmend.errors import FileError
from hexmend.io.base.polyhedra import RaggedArray, cells_from_faces
from hexmend.io.formats.cgns.elements import POLYGONS, POLYHEDRA
from hexmend.io.formats.cgns.section import CGNSSection
from hexmend.io.formats.cgns.zone import DAMAGED

#: Kind, nodes from 0 and numbers in the zone of some elements, and their section.
Part = tuple[tuple[str, np.ndarray, np.ndarray], CGNSSection]


def polyhedra(sections: Sequence[CGNSSection], n_nodes: int, notes: list[str]) -> list[Part]:
    """The cells that are known among polyhedra, and the triangles and quads of the boundary around these.

    Parameters
    ----------
    sections : sequence of CGNSSection
        By their numbers.
    n_nodes : int
    notes : list of str
        What is left out is added.

    Raises
    ------
    FileError
        For a face or node that there is not.
    """
    polygons = [one for one in sections if one.type == POLYGONS]
    rows = [one.rows() for one in polygons]
    faces = RaggedArray(
        np.concatenate([[0], *(np.diff(one.start) for one in rows)]).cumsum(),
        np.concatenate([np.empty(0, np.int64), *(one.values for one in rows)]) - 1,
    )
    nodes = faces.values
    if nodes.size and (nodes.min() < 0 or nodes.max() >= n_nodes):
        raise FileError(
            polygons[0].node.path,
            f"its faces use the nodes {nodes.min() + 1} to {nodes.max() + 1}: expected 1 to {n_nodes}",
            DAMAGED,
        )
    numbers = np.concatenate([np.empty(0, np.int64), *(np.arange(one.first, one.last + 1) for one in polygons)])
    uses, answer = np.zeros(len(faces), np.int64), []
    for section in (one for one in sections if one.type == POLYHEDRA):
        cells = section.rows()
        place = np.searchsorted(numbers, np.abs(cells.values)).clip(0, max(0, len(numbers) - 1))
        if cells.values.size and (not len(numbers) or (numbers[place] != np.abs(cells.values)).any()):
            raise FileError(section.node.path, f"section {section.name!r} names faces that there are not", DAMAGED)
        found = cells_from_faces(
            faces, RaggedArray(cells.start, place), cells.values > 0
        )  # whose normal points out of the cell
        left = len(section) - sum(len(which) for which, _ in found.values())
        if left:
            notes.append(f"{left:,} polyhedra of section {section.name!r} are left out.")
        uses += np.bincount(place, minlength=len(faces))
        answer += [((kind, nodes, section.first + which), section) for kind, (which, nodes) in found.items()]
    first = 0
    for section, own in zip(polygons, rows, strict=True):
        widths, times = own.lengths, uses[first : first + len(own)]
        outer = times == 1
        first += len(own)
        left = int((times == 0).sum() + (outer & (widths != 3) & (widths != 4)).sum())
        if left:
            notes.append(
                f"{left:,} polygons of section {section.name!r} that bound no polyhedron, or have more than 4 nodes, "
                "are left out."
            )
        for kind, width in (("triangle", 3), ("quad", 4)):
            which = np.flatnonzero(outer & (widths == width))
            if which.size:
                nodes = own.values[own.start[which][:, None] + np.arange(width)] - 1
                answer.append(((kind, nodes, section.first + which), section))
    return answer
