"""Sections of a Gmsh file as its readers fill them, the same for all versions of the format."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np


@dataclass(frozen=True, eq=False)
class ElementBlock:
    """Elements of one type.

    Parameters
    ----------
    type : int
        Gmsh's element type.
    tags : (k,) int64
    nodes : (k, width) int64
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
