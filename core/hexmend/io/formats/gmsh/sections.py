"""Sections of a Gmsh file as its readers fill them, the same for all versions of the format."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field

import numpy as np

from hexmend.io.storage.binary_rows import gather_integers


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
