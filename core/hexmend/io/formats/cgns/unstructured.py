"""Unstructured zone of a CGNS file: sections of elements, boundary conditions and interfaces."""

from __future__ import annotations

import numpy as np

from hexmend.errors import FileError
from hexmend.io.base.cell_kinds import dimension
from hexmend.io.base.content import HEX_KINDS, Block
from hexmend.io.base.remedies import DAMAGED
from hexmend.io.formats.cgns.elements import FACE_OF_NUMBER
from hexmend.io.formats.cgns.polyhedra import polyhedra
from hexmend.io.formats.cgns.section import CGNSSection
from hexmend.io.formats.cgns.tree import CGNSNode
from hexmend.io.formats.cgns.zone import (
    Interface,
    Zone,
    add_members,
    boundary_conditions,
    coordinates,
    family_name,
    grid_location,
    solution_arrays,
    zone_size,
)


def read_unstructured(node: CGNSNode) -> Zone:
    """Read an unstructured zone.

    Raises
    ------
    FileError
        Where a part of the zone contradicts its size.
    """
    n_nodes, n_cells = zone_size(node, 1)[:2, 0].tolist()
    zone = Zone(node.name, family_name(node), coordinates(node, (n_nodes,)))
    sections = sorted((CGNSSection(child) for child in node.children("Elements_t")), key=lambda section: section.first)
    groups = [group for section in sections for group in section.cell_groups(zone.notes)]
    groups += polyhedra(sections, n_nodes, zone.notes)
    of_hexes = [group for group in groups if group.kind in HEX_KINDS]
    several = len({group.section for group in of_hexes}) > 1
    hexes = np.concatenate([group.numbers for group in of_hexes] or [np.empty(0, np.int64)])
    for kind, nodes, _, section in groups:
        if len(nodes) and (nodes.min() < 0 or nodes.max() >= n_nodes):
            raise FileError(
                node.path,
                f"section {section!r} uses the nodes {nodes.min() + 1} to {nodes.max() + 1}: expected 1 to {n_nodes}",
                DAMAGED,
            )
        named = several or kind not in HEX_KINDS
        zone.blocks.append(Block(kind, nodes, {}, {section: np.arange(len(nodes))} if named else {}))
    for section in sections:
        if section.parents is not None:
            add_members(zone.side_sets, section.name, _sides(section, np.arange(len(section)), hexes))
    numbers_of = [group.numbers for group in groups]
    _add_cell_data(zone, numbers_of, solution_arrays(node, "CellCenter", (n_cells,)), n_cells)
    zone.node_data = solution_arrays(node, "Vertex", (n_nodes,))
    for name, condition in boundary_conditions(node):
        _add_condition(zone, name, condition, sections, numbers_of, hexes)
    for parent in node.children("ZoneGridConnectivity_t"):
        for connectivity in parent.children("GridConnectivity_t"):
            _add_interface(zone, connectivity)
    return zone


def _sides(section: CGNSSection, which: np.ndarray, hexes: np.ndarray) -> np.ndarray:
    """Side set, (k, 2), of those faces of a section that are faces of hexes.

    Parameters
    ----------
    section : CGNSSection
    which : (m,) int64
        Indices of the faces in the section.
    hexes : (n,) int64
        Element numbers of the zone's hexes.
    """
    parents = section.parents[which].reshape(-1, 2)
    order = np.argsort(hexes, kind="stable")
    at = np.searchsorted(hexes, parents[:, 0], sorter=order).clip(0, max(0, len(hexes) - 1))
    rows = order[at] if len(hexes) else at
    valid = (parents[:, 1] >= 1) & (parents[:, 1] <= 6)
    valid &= hexes[rows] == parents[:, 0] if len(hexes) else False
    return np.column_stack([rows[valid], FACE_OF_NUMBER[parents[valid, 1] - 1]])


def _add_condition(
    zone: Zone,
    name: str,
    condition: CGNSNode,
    sections: list[CGNSSection],
    numbers_of: list[np.ndarray],
    hexes: np.ndarray,
) -> None:
    """Add a boundary condition: a node set, or a set of elements and sides.

    Parameters
    ----------
    zone : Zone
    name : str
    condition : CGNSNode
    sections : list of CGNSSection
    numbers_of : list of (k,) int64
        Element numbers of each block of the zone.
    hexes : (n,) int64
        Element numbers of the zone's hexes.
    """
    members = [
        child
        for child in condition.children("IndexRange_t", "IndexArray_t")
        if child.name in ("PointRange", "ElementRange", "PointList", "ElementList")
    ]
    if not members:
        return
    numbers = members[0].integers().ravel()
    of_nodes = grid_location(condition) == "Vertex" and not members[0].name.startswith("Element")
    if of_nodes and numbers.size and (numbers.min() < 1 or numbers.max() > len(zone.points)):
        raise FileError(condition.path, f"boundary condition {name!r} refers to nodes that do not exist", DAMAGED)
    if members[0].name.endswith("Range"):
        if numbers.size != 2 or numbers[1] < numbers[0]:
            raise FileError(condition.path, f"boundary condition {name!r} has the range {numbers.tolist()}", DAMAGED)
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
    kind = node.child("GridConnectivityType_t")
    points, donors = node.child_named("PointList"), node.child_named("PointListDonor")
    if kind is None or kind.text() != "Abutting1to1" or points is None or donors is None:
        return
    if grid_location(node) != "Vertex":
        return
    nodes, donor_nodes = points.integers().ravel() - 1, donors.integers().ravel() - 1
    if nodes.size == donor_nodes.size and zone.node_numbers(nodes) is not None:
        zone.interfaces.append(Interface(node.text(), nodes, donor_nodes))


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
