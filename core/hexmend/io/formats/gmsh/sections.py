"""Sections of a Gmsh file as its readers fill them, the same for all versions of the format.

Physical groups of Gmsh's format: their numbers, by dimension and name.

Gmsh's element types: their kinds, numbers of nodes and node order (*Gmsh Reference Manual*, "Node ordering").
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from hexmend.errors import FileError
from hexmend.io.base.content import node_count
from hexmend.io.storage.binary_rows import gather_integers

#: Kind of cell of every element type that is read.
KIND_OF_TYPE = {
    15: "vertex", 1: "line", 8: "line3", 2: "triangle", 9: "triangle6", 3: "quad", 16: "quad8", 10: "quad9",
    4: "tetra", 11: "tetra10", 6: "wedge", 18: "wedge15", 7: "pyramid", 19: "pyramid13",
    5: "hex", 17: "hex20", 12: "hex27",
}  # fmt: skip
TYPE_OF_KIND = {kind: type for type, kind in KIND_OF_TYPE.items()}

#: Number of nodes of the element types that are left out.
_OTHER_NODE_COUNTS = {13: 18, 14: 14, 20: 9, 21: 10, 22: 12, 23: 15, 24: 15, 25: 21, 26: 4, 27: 5, 28: 6}
_OTHER_NODE_COUNTS |= {29: 20, 30: 35, 31: 56, 36: 16, 37: 25, 38: 36, 90: 40, 91: 75, 92: 64, 93: 125}
#: Names of some types that are left out.
NAMES = {
    13: "type PRISM18", 36: "type QUAD of order 3", 37: "type QUAD of order 4", 29: "type TETRA of order 3",
    92: "type HEXA of order 3", 93: "type HEXA of order 4",
}  # fmt: skip

#: VTK's node order: vtk = gmsh[ORDER[kind]]. Gmsh orders edges by their lower corner, and the faces of a hex as z-, y-,
#: x-, x+, y+, z+.
ORDER = {
    "hex20": [*range(8), 8, 11, 13, 9, 16, 18, 19, 17, 10, 12, 14, 15],
    "hex27": [*range(8), 8, 11, 13, 9, 16, 18, 19, 17, 10, 12, 14, 15, 22, 23, 21, 24, 20, 25, 26],
    "tetra10": [0, 1, 2, 3, 4, 5, 6, 7, 9, 8],
    "wedge15": [0, 1, 2, 3, 4, 5, 6, 9, 7, 12, 14, 13, 8, 10, 11],
    "pyramid13": [0, 1, 2, 3, 4, 5, 8, 10, 6, 7, 9, 11, 12],
}


def nodes_per_element(path: Path, type: int) -> int:
    """Number of nodes of an element type.

    Raises
    ------
    FileError
        For a type that Gmsh does not have.
    """
    if type in KIND_OF_TYPE:
        return node_count(KIND_OF_TYPE[type])
    if type not in _OTHER_NODE_COUNTS:
        problem = f"has elements of the type {type}, which is unknown"
        raise FileError(path, problem, "Write it with elements of order 1 or 2.")
    return _OTHER_NODE_COUNTS[type]


@dataclass(frozen=True, eq=False)
class ElementBlock:
    """Elements of one type.

    Parameters
    ----------
    type : int
        Gmsh's element type.
    tags : (k,) int64
    nodes : (k, width) int
        Node tags, in Gmsh's order.
    groups : (k,) int64, or sequence of int
        Physical group of each element, 0 for none; or the groups that all elements are in.
    partitions : (k,) int64, optional
        Partition of each element, 0 for none.
    """

    type: int
    tags: np.ndarray
    nodes: np.ndarray
    groups: np.ndarray | Sequence[int]
    partitions: np.ndarray | None = None


@dataclass(frozen=True, eq=False)
class DataSection:
    """Values of $NodeData or $ElementData.

    Parameters
    ----------
    of_nodes : bool
    name : str
    tags : (k,) int64
        Tags of the nodes or elements.
    values : (k,) or (k, width) float64
    """

    of_nodes: bool
    name: str
    tags: np.ndarray
    values: np.ndarray


@dataclass(frozen=True, eq=False)
class PeriodicLink:
    """Nodes of an entity that follow those of another.

    Parameters
    ----------
    dimension, entity, master : int
        Dimension, tag of the entity, and tag of the one that it follows.
    nodes : (k, 2) int64
        Tag of a node, and of its partner in the master.
    """

    dimension: int
    entity: int
    master: int
    nodes: np.ndarray


@dataclass(eq=False)
class Sections:
    """Content of the sections read so far."""

    #: Node tags, (n,) int64, and coordinates, (n, 3) float64.
    tags: np.ndarray | None = None
    points: np.ndarray | None = None
    #: Place of the first coordinate, number of nodes, and distance of the next node, for each of their blocks: in bytes
    #: of the file, or in words of $Nodes in a text.
    places: list[tuple[int, int, int]] = field(default_factory=list)
    elements: list[ElementBlock] | None = None
    #: Lines of $PhysicalNames.
    names: list[str] = field(default_factory=list)
    #: Physical groups of each entity by (dimension, tag).
    entities: dict[tuple[int, int], list[int]] = field(default_factory=dict)
    #: Partition of each partitioned entity by (dimension, tag).
    partitions: dict[tuple[int, int], int] = field(default_factory=dict)
    data: list[DataSection] = field(default_factory=list)
    periodic: list[PeriodicLink] = field(default_factory=list)
    notes: list[str] = field(default_factory=list)


def split_tags(blocks: Iterable[tuple[slice, np.ndarray]], count: int, width: int) -> tuple[np.ndarray, np.ndarray]:
    """Split blocks of rows in the tags of elements and their nodes.

    Parameters
    ----------
    blocks : iterable of (slice, (k, 1 + width) int array)
        As of `hexmend.io.storage.binary_rows.read_blocks`.
    count, width : int
        Number of elements, and nodes of each.

    Returns
    -------
    tags : (count,) int64
    nodes : (count, width) int32, or int64 where a number needs it
    """
    tags = np.empty(count, np.int64)

    def nodes() -> Iterable[tuple[slice, np.ndarray]]:
        for part, rows in blocks:
            tags[part] = rows[:, 0]
            yield part, rows[:, 1:]

    return tags, gather_integers((count, width), nodes())


def joined(parts: Sequence[np.ndarray], dtype: type, *shape: int) -> np.ndarray:
    """Concatenate arrays of rows, or none, of a type and shape; a single array is not copied."""
    if len(parts) == 1:
        return parts[0].astype(dtype, copy=False)
    return np.concatenate([np.zeros((0, *shape), dtype), *parts])


#: Name of the field data that hold the lines of $PhysicalNames, so that groups keep their numbers.
PHYSICAL_NAMES = "gmsh:physical"
_LINE = re.compile(r'\s*(\d+)\s+(-?\d+)\s+"?(.*?)"?\s*\Z')
_UNNAMED = re.compile(r"physical (\d+)\Z")


def group_numbers(lines: object) -> dict[tuple[int, str], int]:
    """Number of each group by dimension and name.

    Parameters
    ----------
    lines : list of str
        Lines of $PhysicalNames, such as '2 1 "inlet"'; anything else gives no groups.
    """
    found = [_LINE.match(line) for line in lines if isinstance(line, str)] if isinstance(lines, list | tuple) else []
    return {(int(match[1]), match[3]): int(match[2]) for match in found if match}


def unnamed_group(number: int) -> str:
    """Name of the set that a group without a name becomes."""
    return f"physical {number}"


def unnamed_group_number(name: str) -> int | None:
    """Number of the group without a name that a set stands for; None for other sets."""
    found = _UNNAMED.match(name)
    return int(found[1]) if found else None
