"""Content of a CGNS file on HDF5: the zones of all bases, merged at their interfaces."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from hexmend.errors import FileError
from hexmend.io.base import hdf5
from hexmend.io.base.content import HEX_KINDS, Block, Content, concatenate_data
from hexmend.io.formats.cgns.structured import read_structured
from hexmend.io.formats.cgns.unstructured import read_unstructured
from hexmend.io.formats.cgns.zone import CGNSNode, Zone
from hexmend.mesh.materials import STRUCTURED_BLOCKS
from hexmend.mesh.topology.components import components
from hexmend.terminal_text import count_phrase

#: Greatest distance between matching nodes of an interface, relative to the diagonal of the bounding box.
_MATCH_TOLERANCE = 1e-5

#: Hint for zones without interfaces between them.
JOIN_HINT = "hexmend repair --only coincident-nodes joins them where their faces lie on one another."


def content(path: Path) -> Content:
    """Read the content of a CGNS file.

    Raises
    ------
    FileError
        For a file that is damaged or has no zone of three dimensions.
    """
    with hdf5.open_file(path) as file:
        zones, notes = _zones(path, CGNSNode(path, file))
    lengths = [len(zone.points) for zone in zones]
    first = np.concatenate([[0], np.cumsum(lengths)])
    points = np.concatenate([zone.points for zone in zones])
    number, kept, n_pairs = _merge_nodes(zones, points, first)
    notes += [note for zone in zones for note in zone.notes]
    if len(zones) > 1:
        joined = f", joined at {count_phrase(len(points) - len(kept), 'node')}."
        contact = joined if n_pairs else f"; the file does not say where they meet. {JOIN_HINT}"
        notes.append(f"{len(zones)} zones are read as one mesh{contact}")
    blocks, node_sets, side_sets, n_hexes = [], {}, {}, 0
    grids = [zone.name for zone in zones if zone.shape is not None and not zone.family] if len(zones) > 1 else []
    for k, zone in enumerate(zones):
        for block in zone.blocks:
            sets = dict(block.sets)
            if zone.family or len(zones) > 1:
                sets.setdefault(zone.family or zone.name, np.arange(len(block)))
            blocks.append(Block(block.kind, number[block.nodes + first[k]], block.data, sets))
        for name, members in zone.node_sets.items():
            node_sets.setdefault(name, []).append(number[members + first[k]])
        for name, rows in zone.side_sets.items():
            side_sets.setdefault(name, []).append(rows + [n_hexes, 0])
        n_hexes += sum(len(block) for block in zone.blocks if block.kind in HEX_KINDS)
    node_data = concatenate_data([zone.node_data for zone in zones], lengths)
    node_data = {name: values[kept] for name, values in node_data.items()}
    node_sets = {name: np.unique(np.concatenate(parts)) for name, parts in node_sets.items()}
    side_sets = {name: np.concatenate(parts) for name, parts in side_sets.items()}
    # Structured zones without a family are blocks of a grid: where they meet is no interface between materials.
    fields = {STRUCTURED_BLOCKS: grids} if grids else {}
    return Content(points[kept], tuple(blocks), node_data, node_sets, side_sets, field_data=fields, notes=tuple(notes))


def _zones(path: Path, root: CGNSNode) -> tuple[list[Zone], list[str]]:
    """Zones of three dimensions, and notes on the others."""
    zones, notes, n_flat = [], [], 0
    bases = root.children("CGNSBase_t")
    if not bases:
        raise FileError(path, "is HDF5, but holds no CGNSBase_t, as CGNS has", "Choose a CGNS file.")
    for base in bases:
        sizes = base.integers().ravel()
        for node in base.children("Zone_t"):
            if len(sizes) < 2 or sizes[0] != 3:
                n_flat += 1
                continue
            zone = (read_unstructured if node.text_of("ZoneType_t") == "Unstructured" else read_structured)(node)
            zone.key = (base.name, node.name)
            zones.append(zone)
    if n_flat:
        notes.append(f"{n_flat} zones of surfaces or lines are left out.")
    if not zones:
        raise FileError(path, "holds no zone of three dimensions", "Hexmend works on hexahedral meshes only.")
    return zones, notes


def _merge_nodes(zones: list[Zone], points: np.ndarray, first: np.ndarray) -> tuple[np.ndarray, np.ndarray, int]:
    """Merge the matching nodes of all interfaces; `first` is the number of the first node of each zone.

    Returns the number of each node after merging, (n,) int64; the first of each group of merged nodes, (m,) int64
    ascending; and the number of matching pairs in all interfaces.
    """
    index = {zone.key: k for k, zone in enumerate(zones)}
    ends = []
    for k, zone in enumerate(zones):
        for interface in zone.interfaces:
            base, _, name = interface.donor.rpartition("/")
            other = index.get((base or zone.key[0], name))
            numbers = None if other is None else zones[other].node_numbers(interface.donor_nodes)
            if numbers is not None and len(numbers) == len(interface.nodes):
                ends.append(np.column_stack([interface.nodes + first[k], numbers + first[other]]))
    if not ends:
        return np.arange(len(points)), np.arange(len(points)), 0
    pairs = np.concatenate(ends)
    finite = points[np.isfinite(points).all(axis=1)]
    with np.errstate(all="ignore"):  # very large coordinates overflow
        tolerance = _MATCH_TOLERANCE * float(np.linalg.norm(np.ptp(finite, axis=0))) if len(finite) else 0.0
        distance = np.linalg.norm(points[pairs[:, 0]] - points[pairs[:, 1]], axis=1)
    pairs = pairs[distance <= tolerance]  # others are periodic
    label = components(len(points), pairs)
    kept = np.unique(label, return_index=True)[1]
    order = np.argsort(kept)  # the order of the file
    return np.argsort(order)[label], kept[order], len(pairs)
