"""Unstructured zone of a CGNS file: sections of elements, boundary conditions and interfaces.

Polyhedra of an unstructured zone of a CGNS file (NGON_n and NFACE_n): hexes, wedges, pyramids and tetrahedra.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from hexmend.errors import FileError
from hexmend.io.base.content import HEX_KINDS, Block, dimension
from hexmend.io.base.numbering import check_numbers, lookup
from hexmend.io.base.polyhedra import RaggedArray, cells_from_faces
from hexmend.io.base.remedies import DAMAGED
from hexmend.io.formats.cgns.section import FACE_OF_NUMBER, NFACE, NGON, CellGroup, CGNSSection
from hexmend.io.formats.cgns.zone import CGNSNode, Interface, Zone, add_members, new_zone, zone_size
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
        index, there = lookup(numbers, np.abs(cells.values))
        if not there.all():
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


def read_unstructured(node: CGNSNode) -> Zone:
    """Read an unstructured zone.

    Raises
    ------
    FileError
        Where a part of the zone contradicts its size.
    """
    n_nodes, n_cells = zone_size(node, 1)[:2, 0].tolist()
    zone = new_zone(node, (n_nodes,))
    sections = sorted((CGNSSection(child) for child in node.children("Elements_t")), key=lambda section: section.first)
    groups = [group for section in sections for group in section.cell_groups(zone.notes)]
    groups += polyhedra(sections, n_nodes, zone.notes)
    of_hexes = [group for group in groups if group.kind in HEX_KINDS]
    several = len({group.section for group in of_hexes}) > 1
    hexes = np.concatenate([group.numbers for group in of_hexes] or [np.empty(0, np.int64)])
    for kind, nodes, _, section in groups:
        check_numbers(node.path, f"section {section!r} uses the nodes", nodes, n_nodes)
        named = several or kind not in HEX_KINDS
        zone.blocks.append(Block(kind, nodes, {}, {section: np.arange(len(nodes))} if named else {}))
    for section in sections:
        if section.parents is not None:
            add_members(zone.side_sets, section.name, _sides(section, np.arange(len(section)), hexes))
    numbers_of = [group.numbers for group in groups]
    _add_cell_data(zone, numbers_of, node.solution_arrays("CellCenter", (n_cells,)), n_cells)
    for name, condition in node.boundary_conditions():
        _add_condition(zone, name, condition, sections, numbers_of, hexes)
    for connectivity in node.grandchildren("ZoneGridConnectivity_t", "GridConnectivity_t"):
        _add_interface(zone, connectivity)
    return zone


def _sides(section: CGNSSection, which: np.ndarray, hexes: np.ndarray) -> np.ndarray:
    """Side set, (k, 2), of the faces `which` of a section, by number; faces that belong to no hex are left out."""
    parents = section.parents[which].reshape(-1, 2)
    rows, valid = lookup(hexes, parents[:, 0])
    valid &= (parents[:, 1] >= 1) & (parents[:, 1] <= 6)
    return np.column_stack([rows[valid], FACE_OF_NUMBER[parents[valid, 1] - 1]])


def _add_condition(
    zone: Zone, name: str, node: CGNSNode, sections: list[CGNSSection], numbers_of: list[np.ndarray], hexes: np.ndarray
) -> None:
    """Add a boundary condition: a node set, or a set of elements and sides.

    `numbers_of` are the element numbers of each block of the zone, (k,) int64, `hexes` those of its hexes.
    """
    names = ("PointRange", "ElementRange", "PointList", "ElementList")
    members = [child for child in node.children("IndexRange_t", "IndexArray_t") if child.name in names]
    if not members:
        return
    numbers = members[0].integers().ravel()
    at_vertices = node.text_of("GridLocation_t", "Vertex") == "Vertex"
    of_nodes = at_vertices and not members[0].name.startswith("Element")
    if of_nodes:
        check_numbers(node.path, f"boundary condition {name!r} refers to the nodes", numbers - 1, len(zone.points))
    if members[0].name.endswith("Range"):
        if numbers.size != 2 or numbers[1] < numbers[0]:
            raise FileError(node.path, f"boundary condition {name!r} has the range {numbers.tolist()}", DAMAGED)
        if of_nodes:
            known = np.arange(1, len(zone.points) + 1)
        else:
            faces = [np.arange(one.first, one.last + 1) for one in sections if one.parents is not None]
            known = np.concatenate([np.empty(0, int), *numbers_of, *faces])
        numbers = known[(known >= numbers[0]) & (known <= numbers[1])]  # a range may claim far more than there are
    if of_nodes:
        add_members(zone.node_sets, name, numbers - 1)
        return
    for block, own in zip(zone.blocks, numbers_of, strict=True):
        chosen = np.flatnonzero(np.isin(own, numbers))
        if chosen.size and (block.kind in HEX_KINDS or dimension(block.kind) < 3):
            block.sets[name] = np.union1d(block.sets[name], chosen) if name in block.sets else chosen
    for section in sections:
        if section.parents is not None and section.name != name:
            which = np.unique(numbers[(numbers >= section.first) & (numbers <= section.last)]) - section.first
            add_members(zone.side_sets, name, _sides(section, which, hexes))


def _add_interface(zone: Zone, node: CGNSNode) -> None:
    """Add the interface of a GridConnectivity_t node where it matches vertices one to one."""
    if node.text_of("GridConnectivityType_t") != "Abutting1to1" or node.text_of("GridLocation_t", "Vertex") != "Vertex":
        return
    nodes, donors = node.integers_of("PointList"), node.integers_of("PointListDonor")
    matching = nodes is not None and donors is not None and nodes.size == donors.size
    if matching and zone.node_numbers(nodes - 1) is not None:
        zone.interfaces.append(Interface(node.text(), nodes - 1, donors - 1))


def _add_cell_data(zone: Zone, numbers_of: list[np.ndarray], data: dict[str, np.ndarray], n_cells: int) -> None:
    """Distribute cell data, ordered by element number, to the blocks of volume cells."""
    blocks = zip(zone.blocks, numbers_of, strict=True)
    volumes = [(block, numbers) for block, numbers in blocks if dimension(block.kind) == 3]
    numbers = np.sort(np.concatenate([numbers for _, numbers in volumes] or [[]]))
    if len(numbers) != n_cells:
        zone.notes += ["Cell data are left out because some cells are."] if data else []
        return
    for block, own in volumes:
        block.data.update({name: values[np.searchsorted(numbers, own)] for name, values in data.items()})
