"""An unstructured zone of a CGNS file: sections of elements, and what its boundary conditions name."""

from __future__ import annotations

import numpy as np

from hexmend.errors import FileError
from hexmend.io.base.content import HEX_KINDS, Block
from hexmend.io.formats.cgns.elements import FACE_OF
from hexmend.io.formats.cgns.polyhedra import polyhedra
from hexmend.io.formats.cgns.section import CGNSSection
from hexmend.io.formats.cgns.tree import CGNSNode
from hexmend.io.formats.cgns.zone import (
    DAMAGED,
    Zone,
    add,
    conditions,
    coordinates,
    family,
    location_of,
    results,
    sizes,
)
from hexmend.mesh.cells import CELL_KINDS


def unstructured(node: CGNSNode) -> Zone:
    """Read an unstructured zone."""
    n_nodes, n_cells = sizes(node, 1)[:2, 0].tolist()
    zone = Zone(node.name, family(node), coordinates(node, (n_nodes,)))
    sections = sorted((CGNSSection(one) for one in node.children("Elements_t")), key=lambda one: one.first)
    parts = [(part, section) for section in sections for part in section.parts(zone.notes)]
    parts += polyhedra(sections, n_nodes, zone.notes)
    hexes = np.concatenate([numbers for (kind, _, numbers), _ in parts if kind in HEX_KINDS] or [np.empty(0, np.int64)])
    several = len({section.name for (kind, _, _), section in parts if kind in HEX_KINDS}) > 1
    numbers_of = []
    for (kind, nodes, numbers), section in parts:
        if len(nodes) and (nodes.min() < 0 or nodes.max() >= n_nodes):
            raise FileError(
                node.path,
                f"section {section.name!r} uses the nodes {nodes.min() + 1} to {nodes.max() + 1}: "
                f"expected 1 to {n_nodes}",
                DAMAGED,
            )
        named = several or kind not in HEX_KINDS
        zone.blocks.append(Block(kind, nodes, {}, {section.name: np.arange(len(nodes))} if named else {}))
        numbers_of.append(numbers)
    for section in sections:
        if section.parents is not None:
            add(zone.side_sets, section.name, _sides(section, np.arange(len(section)), hexes))
    _add_cell_data(zone, numbers_of, results(node, "CellCenter", (n_cells,)), n_cells)
    zone.node_data = results(node, "Vertex", (n_nodes,))
    for name, condition in conditions(node):
        _add_condition(zone, name, condition, sections, numbers_of, hexes)
    for parent in node.children("ZoneGridConnectivity_t"):
        for one in parent.children("GridConnectivity_t"):
            _add_interface(zone, one)
    return zone


def _sides(section: CGNSSection, which: np.ndarray, hexes: np.ndarray) -> np.ndarray:
    """Hexes and faces of some faces of a section; `hexes` are the numbers of the hexes in the zone."""
    parents = section.parents[which].reshape(-1, 2)
    order = np.argsort(hexes, kind="stable")
    place = np.searchsorted(hexes, parents[:, 0], sorter=order).clip(0, max(0, len(hexes) - 1))
    hex_ = order[place] if len(hexes) else place
    good = (parents[:, 1] >= 1) & (parents[:, 1] <= 6)
    good &= hexes[hex_] == parents[:, 0] if len(hexes) else False
    return np.column_stack([hex_[good], FACE_OF[parents[good, 1] - 1]])


def _add_condition(
    zone: Zone,
    name: str,
    condition: CGNSNode,
    sections: list[CGNSSection],
    numbers_of: list[np.ndarray],
    hexes: np.ndarray,
) -> None:
    """A boundary condition: a set of nodes, of elements, or of sides."""
    members = [
        one
        for one in condition.children("IndexRange_t", "IndexArray_t")
        if one.name in ("PointRange", "ElementRange", "PointList", "ElementList")
    ]
    if not members:
        return
    numbers, of_nodes = members[0].numbers().ravel(), location_of(condition) == "Vertex"
    of_nodes &= not members[0].name.startswith("Element")
    if of_nodes and numbers.size and (numbers.min() < 1 or numbers.max() > len(zone.points)):
        raise FileError(condition.path, f"boundary condition {name!r} names nodes that there are not", DAMAGED)
    if members[0].name.endswith("Range"):
        if numbers.size != 2 or numbers[1] < numbers[0]:
            raise FileError(condition.path, f"boundary condition {name!r} has the range {numbers.tolist()}", DAMAGED)
        told = [np.arange(one.first, one.last + 1) for one in sections if one.parents is not None]
        known = (
            np.arange(1, len(zone.points) + 1) if of_nodes else np.concatenate([np.empty(0, int), *numbers_of, *told])
        )
        numbers = known[(known >= numbers[0]) & (known <= numbers[1])]
    if of_nodes:
        add(zone.node_sets, name, numbers - 1)
        return
    for block, own in zip(zone.blocks, numbers_of, strict=True):
        inside = np.flatnonzero(np.isin(own, numbers))
        if inside.size and (block.kind in HEX_KINDS or CELL_KINDS[block.kind].dimension < 3):
            block.sets[name] = np.union1d(block.sets[name], inside) if name in block.sets else inside
    for section in sections:
        if section.parents is not None and section.name != name:
            which = np.unique(numbers[(numbers >= section.first) & (numbers <= section.last)]) - section.first
            add(zone.side_sets, name, _sides(section, which, hexes))


def _add_interface(zone: Zone, node: CGNSNode) -> None:
    kind = node.child("GridConnectivityType_t")
    own, donor = node.named("PointList"), node.named("PointListDonor")
    if kind is None or kind.text() != "Abutting1to1" or own is None or donor is None or location_of(node) != "Vertex":
        return
    own, donor = own.numbers().ravel() - 1, donor.numbers().ravel() - 1
    if own.size == donor.size and zone.numbers(own) is not None:
        zone.interfaces.append((node.text(), own, donor))


def _add_cell_data(zone: Zone, numbers_of: list[np.ndarray], data: dict[str, np.ndarray], n_cells: int) -> None:
    """Give the blocks of cells that fill space their part of arrays over all of these, which come by their numbers."""
    solid = [block.kind in HEX_KINDS or CELL_KINDS[block.kind].dimension == 3 for block in zone.blocks]
    numbers = np.sort(
        np.concatenate([own for own, is_solid in zip(numbers_of, solid, strict=True) if is_solid] or [[]])
    )
    if len(numbers) != n_cells:
        zone.notes += ["Results of cells are left out, as some of the cells are."] if data else []
        return
    for block, own, is_solid in zip(zone.blocks, numbers_of, solid, strict=True):
        if is_solid:
            block.data.update({name: values[np.searchsorted(numbers, own)] for name, values in data.items()})
