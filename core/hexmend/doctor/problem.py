"""Problems of meshes: their base class, their findings, and the registry of problems."""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass, field
from typing import Any, ClassVar

import numpy as np

from hexmend.mesh.mesh import Mesh
from hexmend.quality.file_ids import hex_ids, node_ids, with_ids
from hexmend.registry import Registry

#: Empty array of hexes or nodes.
NONE_FOUND = np.empty(0, np.int64)


@dataclass(frozen=True, eq=False)
class Finding:
    """Occurrence of a problem in a mesh.

    Parameters
    ----------
    kind : str
        Name of the problem.
    count : int
        Number of hexes, nodes, faces or parts that the message counts.
    message : str
        Description as a sentence.
    remedy : str
        Advice as a sentence.
    mendable : bool
        True if `hexmend.doctor.repair` repairs it.
    hexes, nodes : (k,) int
        Hexes or nodes that have the problem.
    """

    kind: str
    count: int
    message: str
    remedy: str = ""
    mendable: bool = False
    hexes: np.ndarray = field(default_factory=lambda: NONE_FOUND)
    nodes: np.ndarray = field(default_factory=lambda: NONE_FOUND)

    def to_dict(self, most: int = 10) -> dict[str, Any]:
        """Return the finding as plain data, with its first `most` hexes and nodes."""
        return {**vars(self), "hexes": self.hexes[:most].tolist(), "nodes": self.nodes[:most].tolist()}

    def location_text(self, most: int = 5, mesh: Mesh | None = None) -> str:
        """Name the first hexes or nodes that have the problem, also by the numbers of the file of `mesh`.

        >>> Finding("unused-nodes", 7, "", nodes=np.arange(7)).location_text(3)
        'nodes 0, 1, 2, ...'
        >>> Finding("degenerate-hexes", 1, "", hexes=np.array([12])).location_text()
        'hex 12'
        """
        numbers, one, several = (self.hexes, "hex", "hexes") if len(self.hexes) else (self.nodes, "node", "nodes")
        if not len(numbers):
            return ""
        ids = None if mesh is None else hex_ids(mesh) if len(self.hexes) else node_ids(mesh)
        text, more = with_ids(numbers[:most], ids), ", ..." if len(numbers) > most else ""
        text = text.replace(")", f"{more})") if ids is not None else text + more
        return f"{several if len(numbers) > 1 else one} {text}"


class Problem(ABC):
    """Kind of problem of a mesh: its search, description and, where possible, repair."""

    #: Key in PROBLEMS, and title in the viewer.
    name: ClassVar[str]
    title: ClassVar[str]
    #: Position in the order of search and repair.
    rank: ClassVar[int]
    #: Advice of its findings, as sentences.
    remedy: ClassVar[str]
    #: Action of `repair`, as words after "to"; "" if there is none.
    action: ClassVar[str] = ""
    #: Kind of numbers that `locate` returns, "hexes" or "nodes".
    items: ClassVar[str] = "hexes"

    def find(self, mesh: Mesh, quick: bool = False) -> Finding | None:
        """Find the problem in a mesh; None if it does not occur. `quick` leaves out searches in space."""
        where = self.locate(mesh, quick)
        return self.describe(mesh, where) if where.size else None

    @abstractmethod
    def locate(self, mesh: Mesh, quick: bool = False) -> np.ndarray:
        """Return the hexes or nodes that have the problem, ascending, (k,) int64."""

    @abstractmethod
    def describe(self, mesh: Mesh, where: np.ndarray) -> Finding:
        """Describe the problem; `where` is the result of `locate` and not empty."""

    def finding(
        self, where: np.ndarray, message: str, *, count: int | None = None, mendable: bool | None = None
    ) -> Finding:
        """Make the finding of this problem.

        Parameters
        ----------
        where : (k,) int
            Hexes or nodes that have the problem.
        message : str
            Description as a sentence.
        count : int, optional
            Number that the message names; that of `where` by default.
        mendable : bool, optional
            True if `mend` repairs it; by default if there is an `action`.
        """
        count = where.size if count is None else count
        mendable = bool(self.action) if mendable is None else mendable
        return Finding(self.name, count, message, self.remedy, mendable, **{self.items: where})

    def mend(self, mesh: Mesh) -> Mesh:
        """Return the mesh with the problem repaired as far as possible."""
        return mesh


PROBLEMS: Registry[Problem] = Registry("problem")
"""Kinds of problems by name."""


def register_problem(cls: type[Problem]) -> type[Problem]:
    """Register a problem under its name; a class decorator."""
    PROBLEMS.add(cls.name, cls())
    return cls
