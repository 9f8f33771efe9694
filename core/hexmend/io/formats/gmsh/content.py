"""What a Gmsh file holds, of whichever version: its types of elements, its groups, and the mesh they make."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path

import numpy as np

from hexmend.errors import FileError
from hexmend.io.base.content import HEX_KINDS, ID, Block, Content, unused_name
from hexmend.io.base.content import to_mesh as mesh_of
from hexmend.io.base.cursor import quoted
from hexmend.io.base.memory_budget import MemoryBudget
from hexmend.io.base.numbering import find_ids
from hexmend.mesh.cells import CELL_KINDS
from hexmend.mesh.mesh import Mesh

#: Gmsh's number of every kind of cell that is read.
KINDS = {
    15: "vertex", 1: "line", 8: "line3", 2: "triangle", 9: "triangle6", 3: "quad", 16: "quad8", 10: "quad9",
    4: "tetra", 11: "tetra10", 6: "wedge", 18: "wedge15", 7: "pyramid", 19: "pyramid13",
    5: "hex", 17: "hex20", 12: "hex27",
}  # fmt: skip
NUMBERS = {kind: number for number, kind in KINDS.items()}

#: Nodes of types that are left out.
_OTHER_WIDTHS = {13: 18, 14: 14, 20: 9, 21: 10, 22: 12, 23: 15, 24: 15, 25: 21, 26: 4, 27: 5, 28: 6}
_OTHER_WIDTHS |= {29: 20, 30: 35, 31: 56, 36: 16, 37: 25, 38: 36, 90: 40, 91: 75, 92: 64, 93: 125}

#: VTK's order of nodes: nodes[ORDER[kind]] of Gmsh's. Gmsh goes through the edges by their lower corner, and through a
#: hex's faces z-, y-, x-, x+, y+, z+.
ORDER = {
    "hex20": [*range(8), 8, 11, 13, 9, 16, 18, 19, 17, 10, 12, 14, 15],
    "hex27": [*range(8), 8, 11, 13, 9, 16, 18, 19, 17, 10, 12, 14, 15, 22, 23, 21, 24, 20, 25, 26],
    "tetra10": [0, 1, 2, 3, 4, 5, 6, 7, 9, 8],
    "wedge15": [0, 1, 2, 3, 4, 5, 6, 9, 7, 12, 14, 13, 8, 10, 11],
    "pyramid13": [0, 1, 2, 3, 4, 5, 8, 10, 6, 7, 9, 11, 12],
}

#: Name of the data of cells that hold their partition, unless the file has data of that name.
PARTITION = "partition"

#: Name of field data that holds the lines of $PhysicalNames, so that groups keep their numbers.
PHYSICAL = "gmsh:physical"
_LINE = re.compile(r'\s*(\d+)\s+(-?\d+)\s+"?(.*?)"?\s*\Z')
_UNNAMED = re.compile(r"physical (\d+)\Z")


@dataclass(frozen=True, eq=False)
class Elements:
    """Elements of one type that stand together.

    Parameters
    ----------
    type : int
        Gmsh's number.
    tags : (k,) int64
    nodes : (k, width) int64
        Tags of nodes, in Gmsh's order.
    groups : (k,) int64, or sequence of int
        The physical group of each element, 0 for none; or the groups of all.
    partitions : (k,) int64, optional
        The partition of each element, 0 for none.
    """

    type: int
    tags: np.ndarray
    nodes: np.ndarray
    groups: np.ndarray | Sequence[int]
    partitions: np.ndarray | None = None


@dataclass(frozen=True, eq=False)
class Data:
    """Values of nodes or elements, by their tags.

    Parameters
    ----------
    of_nodes : bool
    name : str
    tags : (k,) int64
    values : (k,) or (k, width) float64
    """

    of_nodes: bool
    name: str
    tags: np.ndarray
    values: np.ndarray


@dataclass(eq=False)
class Read:
    """What was read of a file, section by section."""

    tags: np.ndarray | None = None
    points: np.ndarray | None = None
    elements: list[Elements] | None = None
    names: list[str] = field(default_factory=list)
    #: Physical groups of the entities of the file, (dimension, tag) to numbers.
    entities: dict[tuple[int, int], list[int]] = field(default_factory=dict)
    #: Partition of the entities that belong to one, by (dimension, tag).
    partitions: dict[tuple[int, int], int] = field(default_factory=dict)
    data: list[Data] = field(default_factory=list)
    notes: list[str] = field(default_factory=list)


def dimension_of(kind: str) -> int:
    """0 for points up to 3 for cells that fill space."""
    return 3 if kind in HEX_KINDS else CELL_KINDS[kind].dimension


def width_of(path: Path, number: int) -> int:
    """How many nodes elements of a type have; FileError for a type that Gmsh has not."""
    kind = KINDS.get(number)
    if kind is not None:
        return HEX_KINDS[kind] if kind in HEX_KINDS else CELL_KINDS[kind].nodes
    if number not in _OTHER_WIDTHS:
        raise FileError(
            path, f"has elements of the type {number}, which is unknown", "Write it with elements of order 1 or 2."
        )
    return _OTHER_WIDTHS[number]


def numbers_of(lines: object) -> dict[tuple[int, str], int]:
    """The number of each group by dimension and name, of lines such as '2 1 "inlet"'."""
    found = [_LINE.match(line) for line in lines if isinstance(line, str)] if isinstance(lines, list | tuple) else []
    return {(int(one[1]), one[3]): int(one[2]) for one in found if one}


def unnamed(name: str) -> int | None:
    """The number of a group that has but a number, of the name that it is given here."""
    found = _UNNAMED.match(name)
    return int(found[1]) if found else None


def to_mesh(path: Path, read: Read) -> Mesh:
    """The mesh that a file's sections make."""
    if read.points is None:
        raise FileError(path, "has no section $Nodes", "Write the file again with the program that made it.")
    if read.elements is None:
        raise FileError(path, "has no section $Elements", "Write the file again with the program that made it.")
    titles = {(dimension, number): name for (dimension, name), number in numbers_of(read.names).items()}
    notes, blocks, allowance = list(read.notes), [], MemoryBudget(path, path.stat().st_size)
    left = sum(len(part.tags) for part in read.elements if part.type not in KINDS)
    if left:
        notes.append(
            f"{left:,} elements of types that Hexmend does not keep (orders above 2, prisms of 18 nodes) are left out."
        )
    partitioned = any(part.partitions is not None and part.partitions.any() for part in read.elements)
    own = {one.name for one in read.data if not one.of_nodes}
    partition = unused_name(PARTITION, own) if PARTITION in own else PARTITION
    if partitioned:
        notes.append(
            f"The mesh is in parts for several processors: the data {partition!r} says which cell is in which."
        )
    for number in dict.fromkeys(part.type for part in read.elements):
        parts = [part for part in read.elements if part.type == number and len(part.tags)]
        if parts and number in KINDS:
            block, partitions = _block(path, KINDS[number], parts, read.tags, titles, notes)
            data = _data(read.data, False, block.data[ID], allowance) | ({partition: partitions} if partitioned else {})
            blocks.append(replace(block, data=data | block.data))
    blocks.sort(key=lambda block: block.kind not in HEX_KINDS)
    field_data = {PHYSICAL: read.names} if read.names else {}
    node_data = {**_data(read.data, True, read.tags, allowance), ID: read.tags}
    content = Content(read.points, tuple(blocks), node_data, field_data=field_data, notes=tuple(notes))
    return mesh_of(path, content)


def _block(
    path: Path,
    kind: str,
    parts: list[Elements],
    node_tags: np.ndarray,
    titles: Mapping[tuple[int, int], str],
    notes: list[str],
) -> tuple[Block, np.ndarray]:
    """The elements of one kind, and the partition of each."""
    nodes = np.concatenate([part.nodes for part in parts])
    tags = np.concatenate([part.tags for part in parts])
    partitions = np.concatenate(
        [np.zeros(len(part.tags), np.int64) if part.partitions is None else part.partitions for part in parts]
    )
    members: dict[int, list[np.ndarray]] = {}
    first = 0
    for part in parts:
        if isinstance(part.groups, np.ndarray):
            for number in np.unique(part.groups).tolist():
                if number:
                    members.setdefault(number, []).append(np.flatnonzero(part.groups == number) + first)
        else:
            for number in part.groups:
                members.setdefault(abs(number), []).append(np.arange(first, first + len(part.tags)))
        first += len(part.tags)
    repeated = len(members) > 1 and any(isinstance(part.groups, np.ndarray) for part in parts)
    kept, place = _merged(nodes) if repeated else (None, None)
    if kept is not None:
        notes.append(
            f"{len(nodes) - len(kept):,} {kind} elements stand in the file once for each of their physical groups: "
            "they are read as one each."
        )
        nodes, tags, partitions = nodes[kept], tags[kept], partitions[kept]
    nodes = find_ids(path, node_tags, nodes, "node")
    sets = {}
    for number, rows in members.items():
        chosen = np.concatenate(rows)
        chosen = np.unique(place[chosen]) if place is not None else chosen
        sets[titles.get((dimension_of(kind), number)) or f"physical {number}"] = chosen
    return Block(kind, nodes[:, ORDER[kind]] if kind in ORDER else nodes, {ID: tags}, sets), partitions


def _data(data: Sequence[Data], of_nodes: bool, tags: np.ndarray, allowance: MemoryBudget) -> dict[str, np.ndarray]:
    """Values by name for things of some tags; where the file has none for some of them they are no number."""
    found = {}
    for one in data:
        if one.of_nodes != of_nodes or not len(one.tags):
            continue
        order = np.argsort(one.tags, kind="stable")
        at = np.minimum(np.searchsorted(one.tags[order], tags), len(order) - 1)
        there = one.tags[order[at]] == tags
        if there.any():
            allowance.charge(len(tags) * one.values[:1].nbytes, f"the data {quoted(one.name)} of all nodes or elements")
            found[one.name] = one.values[order[at]]
            found[one.name][~there] = np.nan
    return found


def _merged(nodes: np.ndarray) -> tuple[np.ndarray, np.ndarray] | tuple[None, None]:
    """Rows that are kept where some are there more than once, and the place of every row among them."""
    weights = np.random.default_rng(0).integers(1, 2**62, nodes.shape[1]) | 1
    marks = (nodes * weights).sum(axis=1)  # that overflows, which does no harm
    if len(np.unique(marks)) == len(marks):
        return None, None
    _, first, place = np.unique(nodes, axis=0, return_index=True, return_inverse=True)
    order = np.argsort(first)
    rank = np.empty(len(first), np.int64)
    rank[order] = np.arange(len(first))
    return first[order], rank[place.ravel()]
