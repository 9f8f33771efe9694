"""The content of a CGNS file on HDF5: zones of all bases, joined where the file says that they meet."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from hexmend.errors import FileError
from hexmend.io.base import hdf5
from hexmend.io.base.content import HEX_KINDS, Block, Content, concatenate_data
from hexmend.io.formats.cgns.structured import structured
from hexmend.io.formats.cgns.tree import CGNSNode
from hexmend.io.formats.cgns.unstructured import unstructured
from hexmend.io.formats.cgns.zone import Zone
from hexmend.mesh.components import components

#: How far apart nodes that are told to be one may lie, of the diagonal of the box around all of them.
MEETING = 1e-5


#: What joins zones of which nothing says where they meet.
JOINED_BY = "hexmend repair --only coincident-nodes joins them where their faces lie on one another."


def content(path: Path) -> Content:
    """What a CGNS file holds."""
    with hdf5.open_file(path) as file:
        zones, notes = _zones(path, CGNSNode(path, file))
    lengths = [len(zone.points) for zone in zones]
    first = np.concatenate([[0], np.cumsum(lengths)])
    points = np.concatenate([zone.points for zone in zones])
    node, kept, pairs = _merged(zones, points, first)
    notes += [note for zone in zones for note in zone.notes]
    if len(zones) > 1:
        notes.append(
            f"{len(zones)} zones are one mesh, joined at {len(points) - len(kept):,} nodes."
            if pairs
            else f"{len(zones)} zones are one mesh; the file does not say where they meet. {JOINED_BY}"
        )
    blocks, node_sets, side_sets, before = [], {}, {}, 0
    for k, zone in enumerate(zones):
        for block in zone.blocks:
            sets = dict(block.sets)
            if zone.family or len(zones) > 1:
                sets.setdefault(zone.family or zone.name, np.arange(len(block)))
            blocks.append(Block(block.kind, node[block.nodes + first[k]], block.data, sets))
        for name, members in zone.node_sets.items():
            node_sets.setdefault(name, []).append(node[members + first[k]])
        for name, rows in zone.side_sets.items():
            side_sets.setdefault(name, []).append(rows + [before, 0])
        before += sum(len(block) for block in zone.blocks if block.kind in HEX_KINDS)
    return Content(
        points[kept],
        tuple(blocks),
        {name: values[kept] for name, values in concatenate_data([zone.node_data for zone in zones], lengths).items()},
        {name: np.unique(np.concatenate(parts)) for name, parts in node_sets.items()},
        {name: np.concatenate(parts) for name, parts in side_sets.items()},
        notes=tuple(notes),
    )


def _zones(path: Path, root: CGNSNode) -> tuple[list[Zone], list[str]]:
    """The zones of three dimensions, and what is said of others."""
    zones, notes, flat = [], [], 0
    bases = root.children("CGNSBase_t")
    if not bases:
        raise FileError(path, "is HDF5, but holds no CGNSBase_t, as CGNS has", "Name a CGNS file.")
    for base in bases:
        sizes = base.numbers().ravel()
        for node in base.children("Zone_t"):
            if len(sizes) < 2 or sizes[0] != 3:
                flat += 1
                continue
            kind = node.child("ZoneType_t")
            zone = unstructured(node) if kind is not None and kind.text() == "Unstructured" else structured(node)
            zone.key = (base.name, node.name)
            zones.append(zone)
    if flat:
        notes.append(f"{flat} zones of surfaces or lines are left out.")
    if not zones:
        raise FileError(path, "holds no zone of three dimensions", "Hexmend works on hexahedral meshes only.")
    return zones, notes


def _merged(zones: list[Zone], points: np.ndarray, first: np.ndarray) -> tuple[np.ndarray, np.ndarray, int]:
    """The node that each node of a zone is, the first of those that are one, and how many pairs were told."""
    place = {zone.key: k for k, zone in enumerate(zones)}
    ends = []
    for k, zone in enumerate(zones):
        for donor, own, others in zone.interfaces:
            base, _, name = donor.rpartition("/")
            other = place.get((base or zone.key[0], name))
            numbers = zones[other].numbers(others) if other is not None else None
            if numbers is not None and len(numbers) == len(own):
                ends.append(np.column_stack([own + first[k], numbers + first[other]]))
    if not ends:
        return np.arange(len(points)), np.arange(len(points)), 0
    pairs = np.concatenate(ends)
    used = points[np.isfinite(points).all(axis=1)]
    with np.errstate(all="ignore"):  # of coordinates that are very large
        near = MEETING * float(np.linalg.norm(np.ptp(used, axis=0))) if len(used) else 0.0
        apart = np.linalg.norm(points[pairs[:, 0]] - points[pairs[:, 1]], axis=1)
    pairs = pairs[apart <= near]  # others are periodic
    label = components(len(points), pairs)
    kept = np.unique(label, return_index=True)[1]
    order = np.argsort(kept)  # as they come in the file
    number = np.empty(len(kept), np.int64)
    number[order] = np.arange(len(kept))
    return number[label], kept[order], len(pairs)
