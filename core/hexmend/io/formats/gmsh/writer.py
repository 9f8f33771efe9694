"""Writer of Gmsh's format, version 4.1: sets become physical groups, every combination of them an entity."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import BinaryIO

import numpy as np

from hexmend.io.base.capabilities import altered_names, make_unique, rounded_integers
from hexmend.io.base.content import ID, Block, dimension, from_mesh, from_vtk_order, unused_name
from hexmend.io.base.fixed_marks import with_marks
from hexmend.io.base.numbering import element_ids, node_ids, runs, set_combinations, unsupported_ids
from hexmend.io.formats.gmsh.data import SectionWriter, data_title, width_of_row, write_data, written_width
from hexmend.io.formats.gmsh.sections import ORDER, PHYSICAL_NAMES, TYPE_OF_KIND, group_numbers, unnamed_group_number
from hexmend.mesh.mesh import Mesh

#: Tags of the elements of each block, or of their entities, (k,) int64 each.
_Tags = list[np.ndarray]
_Groups = dict[tuple[int, int], list[int]]


def write(path: Path, mesh: Mesh, encoding: str) -> None:
    """Write version 4.1; elements keep their order, so that an entity may have several blocks.

    Parameters
    ----------
    path : Path
    mesh : Mesh
    encoding : str
        "binary" or "ascii".
    """
    content = from_mesh(mesh)
    node_tags = node_ids(dict(content.node_data), len(content.points))
    element_tags = element_ids(content.blocks)
    entities, names, of_block = _entities(content.blocks, mesh.field_data.get(PHYSICAL_NAMES))
    with open(path, "wb") as file:
        total = content.points.size + sum(block.nodes.size for block in content.blocks)
        out = SectionWriter(file, encoding == "binary", total)
        file.write(b"$MeshFormat\n4.1 %d 8\n" % out.binary)
        if out.binary:
            file.write(np.array([1], "<i4").tobytes() + b"\n")
        file.write(b"$EndMeshFormat\n")
        _write_physical_names(file, names)
        _write_entities(out, entities, content.points)
        _write_nodes(out, content.points, node_tags, next(tag for dim, tag in entities if dim == 3))
        _write_elements(out, content.blocks, of_block, element_tags, node_tags)
        node_data, cell_data = with_marks(mesh), _arrays_by_shape(content.blocks)
        titles = make_unique(node_data, data_title)
        for name, values in node_data.items():
            if name != ID:
                write_data(out, "$NodeData", titles[name], [node_tags], [np.asarray(values)])
        titles = make_unique(cell_data, data_title)
        for name, arrays in cell_data.items():
            if name != ID:
                tags = [element_tags[k] for k in arrays]
                write_data(out, "$ElementData", titles[name], tags, list(arrays.values()))


def limitations(mesh: Mesh) -> list[str]:
    """List the ids, names and data of a mesh that a file cannot hold as they are, in words."""
    content = from_mesh(mesh)
    left = unsupported_ids(mesh) + altered_names(_titles(content.blocks)) + rounded_integers(mesh)
    for label, data in (("point data", [with_marks(mesh)]), ("cell data", [block.data for block in content.blocks])):
        arrays = [(name, np.asarray(values)) for part in data for name, values in part.items() if name != ID]
        lost = {name for name, values in arrays if written_width(values) is None}
        wider = {name for name, values in arrays if written_width(values) not in (None, width_of_row(values))}
        left += [f"{label} of more than 9 columns, or no numbers ({', '.join(sorted(lost))})"] if lost else []
        titles = make_unique((name for name, _ in arrays), data_title)
        for name, title in titles.items():
            if len({values.shape[1:] for other, values in arrays if other == name}) > 1:
                titles[name] = f"{title}_2"  # the title of arrays of another width
        left += altered_names(titles, label)
        left += [f"the width of {label}, filled up to 3 or 9 columns ({', '.join(sorted(wider))})"] if wider else []
    return left


def _titles(blocks: tuple[Block, ...]) -> dict[str, str]:
    """Names of sets that groups can have: single spaces, and not empty."""

    def clean(name: str, end: str) -> str:
        return (" ".join(name.split()) or "unnamed") + end

    return make_unique((name for block in blocks for name in block.sets), clean)


def _arrays_by_shape(blocks: tuple[Block, ...]) -> dict[str, dict[int, np.ndarray]]:
    """Cell data by name and index of the block; arrays of one name but another width get a number after it."""
    found: dict[str, dict[int, np.ndarray]] = {}
    names = dict.fromkeys(name for block in blocks for name in block.data)
    for name in names:
        titles: dict[tuple[int, ...], str] = {}  # by the shape of a row
        for k, block in enumerate(blocks):
            if name in block.data:
                values = np.asarray(block.data[name])
                shape = values.shape[1:]
                if shape not in titles:
                    titles[shape] = unused_name(name, {*names, *found}) if titles else name
                found.setdefault(titles[shape], {})[k] = values
    return found


def _entities(blocks: tuple[Block, ...], physical_names: object) -> tuple[_Groups, dict[tuple[int, int], str], _Tags]:
    """Entities of blocks, one for each combination of sets; groups keep the numbers of the lines of $PhysicalNames.

    Returns
    -------
    entities : dict of (dimension, tag) to list of int
        Physical groups of each entity.
    names : dict of (dimension, number) to str
        Names of the physical groups.
    of_block : list of (k,) int64
        Tag of the entity of each element, for each block.
    """
    numbers = _group_numbers(blocks, physical_names)
    entities: _Groups = {}
    tags: dict[tuple[int, tuple[int, ...]], int] = {}
    of_block = []
    for block in blocks:
        dim = dimension(block.kind)
        found, which = set_combinations(block.sets, len(block))
        block_tags = []
        for names in found:
            groups = tuple(sorted(numbers[dim, name] for name in names))
            if (dim, groups) not in tags:
                tags[dim, groups] = 1 + sum(other == dim for other, _ in tags)
                entities[dim, tags[dim, groups]] = list(groups)
            block_tags.append(tags[dim, groups])
        of_block.append(np.array(block_tags, np.int64)[which])
    titles = _titles(blocks)
    names = {
        (dim, number): titles[name] for (dim, name), number in numbers.items() if unnamed_group_number(name) != number
    }
    return entities, names, of_block


def _group_numbers(blocks: tuple[Block, ...], physical_names: object) -> dict[tuple[int, str], int]:
    """Number of the physical group of each set, by dimension and name: as in the file it came from, else unused."""
    known = group_numbers(physical_names)
    keys = dict.fromkeys((dimension(block.kind), name) for block in blocks for name in block.sets)
    numbers = {key: number for key in keys if (number := known.get(key, unnamed_group_number(key[1]) or 0))}
    for key in keys:
        if key not in numbers:
            used = [number for (dim, _), number in numbers.items() if dim == key[0]]
            numbers[key] = max(used, default=0) + 1
    return numbers


def _write_physical_names(file: BinaryIO, names: Mapping[tuple[int, int], str]) -> None:
    if not names:
        return
    file.write(b"$PhysicalNames\n%d\n" % len(names))
    for (dim, number), name in names.items():
        file.write(f'{dim} {number} "{name}"\n'.encode())
    file.write(b"$EndPhysicalNames\n")


def _write_entities(out: SectionWriter, entities: _Groups, points: np.ndarray) -> None:
    low, high = points.min(axis=0), points.max(axis=0)
    out.file.write(b"$Entities\n")
    out.integers(([sum(dim == d for dim, _ in entities) for d in range(4)], "u8"))
    for (dim, tag), groups in sorted(entities.items()):
        box = np.concatenate([low, high]) if dim else low
        boundary = ([0], "u8") if dim else ([], "u8")  # no bounding entities
        if out.binary:
            out.integers(([tag], "i4"))
            out.rows(box)
            out.integers(([len(groups)], "u8"), (groups, "i4"), boundary)
        else:
            text = " ".join(repr(value) for value in box.tolist())
            words = [str(number) for number in (len(groups), *groups, *boundary[0])]
            out.file.write(f"{tag} {text} {' '.join(words)}\n".encode())
    out.end(b"Entities")


def _write_nodes(out: SectionWriter, points: np.ndarray, node_tags: np.ndarray, volume: int) -> None:
    """Write $Nodes; all nodes belong to the entity with the tag `volume`."""
    out.file.write(b"$Nodes\n")
    out.integers(([1, len(points), node_tags.min(), node_tags.max()], "u8"))
    out.integers(([3, volume, 0], "i4"), ([len(points)], "u8"))
    out.rows(node_tags)
    out.rows(points)
    out.end(b"Nodes")


def _write_elements(
    out: SectionWriter, blocks: tuple[Block, ...], entities: _Tags, element_tags: _Tags, node_tags: np.ndarray
) -> None:
    """Write $Elements, a block for each run of elements of one entity."""
    runs_of = [runs(entity) for entity in entities]
    tags = np.concatenate(element_tags)
    out.file.write(b"$Elements\n")
    out.integers(([sum(map(len, runs_of)), len(tags), tags.min(), tags.max()], "u8"))
    for block, entity, own, block_runs in zip(blocks, entities, element_tags, runs_of, strict=True):
        rows = np.column_stack([own, from_vtk_order(node_tags[block.nodes], block.kind, ORDER)])
        for run in block_runs:
            head = [dimension(block.kind), entity[run.start], TYPE_OF_KIND[block.kind]]
            out.integers((head, "i4"), ([run.stop - run.start], "u8"))
            out.rows(rows[run])
    out.end(b"Elements")
