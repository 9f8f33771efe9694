"""Content of a Gmsh file: blocks of cells with their physical groups as sets, and data by tags."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np

from hexmend.errors import FileError
from hexmend.io.base.content import HEX_KINDS, ID, Block, Content, dimension, to_vtk_order, unused_name
from hexmend.io.base.content import to_mesh as mesh_of
from hexmend.io.base.cursor import quoted
from hexmend.io.base.numbering import find_ids, lookup
from hexmend.io.base.remedies import MemoryBudget, some_names, unread_note
from hexmend.io.formats.gmsh.sections import (
    KIND_OF_TYPE,
    NAMES,
    ORDER,
    PHYSICAL_NAMES,
    DataSection,
    ElementBlock,
    Sections,
    group_numbers,
    joined,
    unnamed_group,
)
from hexmend.mesh.mesh import Mesh

#: Name of the cell data that hold partitions, unless the file has data of that name.
PARTITION = "partition"


def to_mesh(path: Path, sections: Sections) -> Mesh:
    """Make the mesh of a file's sections, whose elements and data are released.

    Raises
    ------
    FileError
        For a missing section, or a tag that does not exist.
    MeshError
        From `Mesh`.
    """
    content = _content(path, sections)
    sections.elements, sections.data = [], []
    return mesh_of(path, content)


def _content(path: Path, sections: Sections) -> Content:
    """Make the content; elements are released as soon as they are in a block."""
    for name, values in (("$Nodes", sections.points), ("$Elements", sections.elements)):
        if values is None:
            raise FileError(path, f"has no section {name}", "Write the file again with the program that made it.")
    notes, blocks, budget = list(sections.notes), [], MemoryBudget(path, path.stat().st_size)
    unread = Counter()
    for part in sections.elements:
        if part.type not in KIND_OF_TYPE:
            unread[NAMES.get(part.type, f"type {part.type}")] += len(part.tags)
    if unread:
        notes.append(unread_note(f"{unread.total():,} elements of types that are not kept ({some_names(unread)})"))
    partitioned = any(part.partitions is not None and part.partitions.any() for part in sections.elements)
    cell_data = {data.name for data in sections.data if not data.of_nodes}
    partition = unused_name(PARTITION, cell_data) if PARTITION in cell_data else PARTITION
    if partitioned:
        notes.append(f"The mesh is partitioned: the cell data {partition!r} hold the partition of each cell.")
    for type in dict.fromkeys(part.type for part in sections.elements):
        parts = [part for part in sections.elements if part.type == type and len(part.tags)]
        if parts and type in KIND_OF_TYPE:
            block, partitions = _block(path, KIND_OF_TYPE[type], parts, sections, notes)
            data = _data(sections.data, False, block.data[ID], budget)
            data |= {partition: partitions} if partitioned else {}
            blocks.append(replace(block, data=data | block.data))
            sections.elements = [part for part in sections.elements if part.type != type]
            del parts, block
    blocks.sort(key=lambda block: block.kind not in HEX_KINDS)
    field_data = {PHYSICAL_NAMES: sections.names} if sections.names else {}
    node_data = {**_data(sections.data, True, sections.tags, budget), ID: sections.tags}
    return Content(sections.points, tuple(blocks), node_data, field_data=field_data, notes=tuple(notes), unread=unread)


def _block(
    path: Path, kind: str, parts: list[ElementBlock], sections: Sections, notes: list[str]
) -> tuple[Block, np.ndarray]:
    """Block of all elements of a kind, and the partition of each, (k,) int64."""
    nodes = parts[0].nodes if len(parts) == 1 else np.concatenate([part.nodes for part in parts])
    tags = joined([part.tags for part in parts], np.int64)
    partitions = np.broadcast_to(np.int64(0), len(tags))
    if any(part.partitions is not None for part in parts):
        rows = [np.broadcast_to(0 if part.partitions is None else part.partitions, len(part.tags)) for part in parts]
        partitions = np.concatenate(rows)
    groups, row = _groups(parts), None
    # versions 1 and 2 repeat an element for each of its groups
    if len(groups) > 1 and any(isinstance(part.groups, np.ndarray) for part in parts):
        first, row = _unique_rows(nodes)
        if len(first) < len(nodes):
            repeated = f"{len(nodes) - len(first):,} {kind} elements repeat others of the file"
            notes.append(f"{repeated} in another physical group: each element is read once.")
            nodes, tags, partitions = nodes[first], tags[first], partitions[first]
        else:
            row = None
    sets, names = {}, {(dim, number): name for (dim, name), number in group_numbers(sections.names).items()}
    for number, members in groups.items():
        name = names.get((dimension(kind), number)) or unnamed_group(number)
        sets[name] = members if row is None else np.unique(row[members])
    nodes = find_ids(path, sections.tags, nodes, "node")
    return Block(kind, to_vtk_order(nodes, kind, ORDER), {ID: tags}, sets), partitions


def _groups(parts: list[ElementBlock]) -> dict[int, np.ndarray]:
    """Members of each physical group, as indices into all parts."""
    members: dict[int, list[np.ndarray]] = {}
    first = 0
    for part in parts:
        if isinstance(part.groups, np.ndarray):
            for number in np.unique(part.groups).tolist():
                if number:
                    members.setdefault(number, []).append(np.flatnonzero(part.groups == number) + first)
        else:
            for number in part.groups:  # negative where the entity is reversed
                members.setdefault(abs(number), []).append(np.arange(first, first + len(part.tags)))
        first += len(part.tags)
    return {number: np.concatenate(rows) for number, rows in members.items()}


def _data(
    sections: Sequence[DataSection], of_nodes: bool, tags: np.ndarray, budget: MemoryBudget
) -> dict[str, np.ndarray]:
    """Values by name of the nodes or elements of these tags; NaN where the file has none."""
    found = {}
    for section in sections:
        if section.of_nodes != of_nodes or not len(section.tags):
            continue
        if np.array_equal(section.tags, tags):
            found[section.name] = section.values
            continue
        at, known = lookup(section.tags, tags)
        if known.any():
            size = len(tags) * section.values[:1].nbytes
            budget.charge(size, f"the data {quoted(section.name)} of all nodes or elements")
            found[section.name] = section.values[at]
            found[section.name][~known] = np.nan
    return found


def _unique_rows(nodes: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Index of the first of each set of equal rows, in order, and the index among these of every row."""
    weights = np.random.default_rng(0).integers(1, 2**62, nodes.shape[1]) | 1
    hashes = (nodes * weights).sum(axis=1)  # overflow does no harm
    if len(np.unique(hashes)) == len(hashes):  # sorting rows takes far longer
        return np.arange(len(nodes)), np.arange(len(nodes))
    _, first, row = np.unique(nodes, axis=0, return_index=True, return_inverse=True)
    order = np.argsort(first)
    return first[order], np.argsort(order)[row.ravel()]


def with_periodic_surfaces(path: Path, mesh: Mesh, sections: Sections) -> Mesh:
    """Add the nodes of periodic surfaces as node sets such as "surface 3", and their names as periodic pairs.

    Links of points and curves, and surfaces whose nodes no hex uses, are left out: those of surfaces have them all.
    """
    sets, pairs = dict(mesh.node_sets), []
    for link in sections.periodic:
        nodes = find_ids(path, sections.tags, link.nodes, "node") if link.dimension == 2 else np.empty((0, 2), int)
        nodes = nodes[mesh.topology.boundary[nodes].all(axis=1)]
        if not len(nodes):
            continue
        pair = tuple(f"surface {tag}" for tag in (link.master, link.entity))
        for name, members in zip(pair, nodes.T[::-1], strict=True):
            sets[name] = np.union1d(sets.get(name, []), members).astype(np.int64)
        pairs.append(pair)
    return mesh.replace(node_sets=sets, periodic_pairs=(*mesh.periodic_pairs, *pairs)) if pairs else mesh
