"""Conversion between the content of a file and meshes of the libraries meshio and meshlane, which have one layout."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from hexmend.io.base.content import HEX_KINDS, Block, Content, concatenate_data, merge_blocks
from hexmend.io.base.remedies import unread_note
from hexmend.mesh.cells import CELL_KINDS
from hexmend.terminal_text import count_phrase

#: Kinds of cells by meshio's names.
KINDS = {"hexahedron": "hex", "hexahedron20": "hex20", "hexahedron27": "hex27", **{kind: kind for kind in CELL_KINDS}}
NAMES = {kind: name for name, kind in KINDS.items()}

#: Permutation of nodes between Hexmend's order, which is VTK's, and meshio's, where they differ; its own inverse.
_ORDER = {"wedge": [0, 2, 1, 3, 5, 4]}

#: Entries of cell sets from meshio's reader of Gmsh that hold no cells.
_NOT_SETS = {"gmsh:bounding_entities"}

#: Cell data of Gmsh that hold the number of a cell's physical group; its name and dimension are field data.
_PHYSICAL = "gmsh:physical"


def meshio_fields(content: Content) -> tuple[np.ndarray, list[tuple[str, np.ndarray]], dict[str, Any]]:
    """Points, cells, and data and sets by the names of meshio's arguments, of a content; copies."""
    lengths = [len(block) for block in content.blocks]
    data = concatenate_data([block.data for block in content.blocks], lengths)
    sets = dict.fromkeys(name for block in content.blocks for name in block.sets)
    fields: dict[str, Any] = {
        "point_data": {name: np.array(values) for name, values in content.node_data.items()},
        "cell_data": {name: np.split(values, np.cumsum(lengths)[:-1]) for name, values in data.items()},
        "field_data": dict(content.field_data),
        "point_sets": {name: np.array(members) for name, members in content.node_sets.items()},
        "cell_sets": {
            name: [np.array(block.sets.get(name, ()), np.int64) for block in content.blocks] for name in sets
        },
    }
    cells = [(NAMES[block.kind], _reordered(block.kind, block.nodes)) for block in content.blocks]
    return np.array(content.points), cells, fields


def content_of(mesh: Any) -> Content:
    """Make the content of a mesh of meshio or meshlane: one block of cells for each kind."""
    sets = _physical_groups(mesh) | {name: parts for name, parts in mesh.cell_sets.items() if name not in _NOT_SETS}
    blocks: dict[str, list[Block]] = {}
    unread: Counter[str] = Counter()
    for index, cells in enumerate(mesh.cells):
        kind = KINDS.get(cells.type)
        if kind is None:
            unread[f"type {cells.type}"] += len(cells)
            continue
        data = {name: np.array(parts[index]) for name, parts in mesh.cell_data.items()}
        members = {name: _members(parts, index) for name, parts in sets.items()}
        blocks.setdefault(kind, []).append(Block(kind, _reordered(kind, cells.data), data, members))
    merged = [merge_blocks(group) for group in blocks.values()]
    merged.sort(key=lambda block: block.kind not in HEX_KINDS)
    notes = []
    if unread:
        kinds = ", ".join(sorted(unread))
        cells = count_phrase(sum(unread.values()), f"cell of another kind ({kinds})", f"cells of other kinds ({kinds})")
        notes.append(unread_note(cells))
    points = np.array(mesh.points)
    node_data = {name: np.array(values) for name, values in mesh.point_data.items()}
    node_sets = {name: np.array(members, np.int64) for name, members in mesh.point_sets.items()}
    content = tuple(_without_empty_sets(merged))
    return Content(points, content, node_data, node_sets, {}, None, dict(mesh.field_data), tuple(notes), unread)


def _physical_groups(mesh: Any) -> dict[str, list[np.ndarray]]:
    """Convert Gmsh's physical groups (field data with number and dimension, for files of version 2) to cell sets."""
    groups = {}
    for name, entry in mesh.field_data.items():
        numbers = np.asarray(entry)
        if _PHYSICAL in mesh.cell_data and numbers.shape == (2,) and numbers.dtype.kind in "iu":
            groups[name] = [
                np.flatnonzero((np.asarray(tags) == numbers[0]) & (cells.dim == numbers[1]))
                for cells, tags in zip(mesh.cells, mesh.cell_data[_PHYSICAL], strict=True)
            ]
    return groups


def _members(parts: Sequence[object], index: int) -> np.ndarray:
    """Members of a cell set in one block; meshio's readers may give None, or too few parts, for empty ones."""
    part = parts[index] if index < len(parts) else None
    return np.array(() if part is None else part, np.int64)


def _without_empty_sets(blocks: Sequence[Block]) -> list[Block]:
    """Drop empty sets of blocks where another block has members; sets without any member stay in the first block."""
    filled = {name for block in blocks for name, members in block.sets.items() if len(members)}
    kept = []
    for block in blocks:
        empty = set() if block is not blocks[0] else block.sets.keys() - filled
        sets = {name: members for name, members in block.sets.items() if len(members) or name in empty}
        kept.append(replace(block, sets=sets))
    return kept


def _reordered(kind: str, nodes: np.ndarray) -> np.ndarray:
    nodes = np.array(nodes, np.int64)
    return nodes[:, _ORDER[kind]] if kind in _ORDER else nodes
