"""Writes Gmsh's format, version 4.1: every combination of sets becomes an entity, every set a physical group."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import BinaryIO

import numpy as np

from hexmend.io.base.capabilities import rounded_integers
from hexmend.io.base.content import ID, Block, from_mesh, unused_name
from hexmend.io.base.fixed_marks import with_marks
from hexmend.io.base.numbering import element_ids, node_ids, runs, set_combinations, unsupported_ids
from hexmend.io.base.unique_names import altered_names, make_unique
from hexmend.io.formats.gmsh.content import NUMBERS, ORDER, PHYSICAL, dimension_of, numbers_of, unnamed
from hexmend.io.formats.gmsh.data import DataWriter, data_title, width_of_row, write_data, written_width
from hexmend.mesh.mesh import Mesh


def write(path: Path, mesh: Mesh, encoding: str) -> None:
    """Write version 4.1; elements stay in their order, so that an entity's may stand in several blocks."""
    content = from_mesh(mesh)
    tags = node_ids(dict(content.node_data), len(content.points))
    entities, groups, of_block = _entities(content.blocks, mesh.field_data.get(PHYSICAL))
    with open(path, "wb") as file:
        out = DataWriter(file, encoding == "binary")
        file.write(b"$MeshFormat\n4.1 %d 8\n" % out.binary)
        if out.binary:
            file.write(np.array([1], "<i4").tobytes() + b"\n")
        file.write(b"$EndMeshFormat\n")
        _write_names(file, groups)
        _write_entities(out, entities, content.points)
        _write_nodes(out, content.points, tags, next(tag for dimension, tag in entities if dimension == 3))
        numbers = element_ids(content.blocks)
        _write_elements(out, content.blocks, of_block, numbers, tags)
        of_nodes, of_cells = with_marks(mesh), _alike(content.blocks)
        titles = make_unique(of_nodes, data_title)
        for name, values in of_nodes.items():
            if name != ID:
                write_data(out, "$NodeData", titles[name], [tags], [np.asarray(values)])
        titles = make_unique(of_cells, data_title)
        for name, parts in of_cells.items():
            if name != ID:
                write_data(out, "$ElementData", titles[name], [numbers[k] for k in parts], list(parts.values()))


def limitations(mesh: Mesh) -> list[str]:
    """Ids and names of sets that the format cannot have, and data of other widths than its own, in words."""
    content = from_mesh(mesh)
    left = unsupported_ids(mesh) + altered_names(_titles(content.blocks)) + rounded_integers(mesh)
    for what, data in (("point data", [with_marks(mesh)]), ("cell data", [block.data for block in content.blocks])):
        arrays = [(name, np.asarray(values)) for part in data for name, values in part.items() if name != ID]
        lost = {name for name, values in arrays if written_width(values) is None}
        wider = {name for name, values in arrays if written_width(values) not in (None, width_of_row(values))}
        left += [f"{what} of more than 9 columns, or no numbers ({', '.join(sorted(lost))})"] if lost else []
        titles = make_unique((name for name, _ in arrays), data_title)
        for name, title in titles.items():
            if len({values.shape[1:] for other, values in arrays if other == name}) > 1:
                titles[name] = f"{title}_2"  # as those of another width are called
        left += altered_names(titles, what)
        left += [f"the width of {what}, filled up to 3 or 9 columns ({', '.join(sorted(wider))})"] if wider else []
    return left


def _titles(blocks: tuple[Block, ...]) -> dict[str, str]:
    """Names of sets as groups can have them: with single spaces, and some letters."""

    def form(name: str, end: str) -> str:
        return (" ".join(name.split()) or "unnamed") + end

    return make_unique((name for block in blocks for name in block.sets), form)


def _alike(blocks: tuple[Block, ...]) -> dict[str, dict[int, np.ndarray]]:
    """Arrays by name and block; those of one name but other widths go by that name and a number."""
    answer: dict[str, dict[int, np.ndarray]] = {}
    names = dict.fromkeys(name for block in blocks for name in block.data)
    for name in names:
        titles: dict[tuple[int, ...], str] = {}
        for k, block in enumerate(blocks):
            if name in block.data:
                values = np.asarray(block.data[name])
                if values.shape[1:] not in titles:
                    titles[values.shape[1:]] = unused_name(name, {*names, *answer}) if titles else name
                answer.setdefault(titles[values.shape[1:]], {})[k] = values
    return answer


def _entities(
    blocks: tuple[Block, ...], lines_of_names: object
) -> tuple[dict[tuple[int, int], list[int]], dict[tuple[int, int], str], list[np.ndarray]]:
    """Entities (dimension, tag) with their groups' numbers; groups' names by (dimension, number); elements' tags."""
    known = numbers_of(lines_of_names)
    numbers: dict[tuple[int, str], int] = {}
    for block in blocks:
        for name in block.sets:
            key = (dimension_of(block.kind), name)
            number = known.get(key, unnamed(name) or 0)
            if number and key not in numbers:
                numbers[key] = number
    for block in blocks:
        for name in block.sets:
            key = (dimension_of(block.kind), name)
            if key not in numbers:
                taken = [number for (dimension, _), number in numbers.items() if dimension == key[0]]
                numbers[key] = max(taken, default=0) + 1
    entities: dict[tuple[int, int], list[int]] = {}
    tags: dict[tuple[int, tuple[int, ...]], int] = {}
    of_block = []
    for block in blocks:
        dimension = dimension_of(block.kind)
        found, which = set_combinations(block.sets, len(block))
        own = []
        for names in found:
            groups = tuple(sorted(numbers[dimension, name] for name in names))
            if (dimension, groups) not in tags:
                tags[dimension, groups] = 1 + sum(other == dimension for other, _ in tags)
                entities[dimension, tags[dimension, groups]] = list(groups)
            own.append(tags[dimension, groups])
        of_block.append(np.array(own, np.int64)[which])
    titles = _titles(blocks)
    named = {
        (dimension, number): titles[name] for (dimension, name), number in numbers.items() if unnamed(name) != number
    }
    return entities, named, of_block


def _write_names(file: BinaryIO, groups: Mapping[tuple[int, int], str]) -> None:
    if not groups:
        return
    file.write(b"$PhysicalNames\n%d\n" % len(groups))
    for (dimension, number), name in groups.items():
        file.write(f'{dimension} {number} "{name}"\n'.encode())
    file.write(b"$EndPhysicalNames\n")


def _write_entities(out: DataWriter, entities: Mapping[tuple[int, int], list[int]], points: np.ndarray) -> None:
    low, high = points.min(axis=0), points.max(axis=0)
    out.file.write(b"$Entities\n")
    out.whole(([sum(dimension == d for dimension, _ in entities) for d in range(4)], "u8"))
    for (dimension, tag), groups in sorted(entities.items()):
        box = low if dimension == 0 else np.concatenate([low, high])
        behind = ([0], "u8") if dimension else ([], "u8")  # what bounds it
        if out.binary:
            out.whole(([tag], "i4"))
            out.rows(box)
            out.whole(([len(groups)], "u8"), (groups, "i4"), behind)
        else:
            text = " ".join(repr(value) for value in box.tolist())
            words = [str(number) for number in (len(groups), *groups, *behind[0])]
            out.file.write(f"{tag} {text} {' '.join(words)}\n".encode())
    out.end(b"Entities")


def _write_nodes(out: DataWriter, points: np.ndarray, tags: np.ndarray, volume: int) -> None:
    out.file.write(b"$Nodes\n")
    out.whole(([1, len(points), tags.min(), tags.max()], "u8"))
    out.whole(([3, volume, 0], "i4"), ([len(points)], "u8"))
    out.rows(tags)
    out.rows(points)
    out.end(b"Nodes")


def _write_elements(
    out: DataWriter, blocks: tuple[Block, ...], of_block: list[np.ndarray], numbers: list[np.ndarray], tags: np.ndarray
) -> None:
    together = [runs(entity) for entity in of_block]
    every = np.concatenate(numbers)
    out.file.write(b"$Elements\n")
    out.whole(([sum(map(len, together)), len(every), every.min(), every.max()], "u8"))
    for block, entity, own, stretches in zip(blocks, of_block, numbers, together, strict=True):
        nodes = tags[block.nodes]
        if block.kind in ORDER:
            nodes = nodes[:, np.argsort(ORDER[block.kind])]
        rows = np.column_stack([own, nodes])
        for stretch in stretches:
            head = [dimension_of(block.kind), entity[stretch.start], NUMBERS[block.kind]]
            out.whole((head, "i4"), ([stretch.stop - stretch.start], "u8"))
            out.rows(rows[stretch])
    out.end(b"Elements")
