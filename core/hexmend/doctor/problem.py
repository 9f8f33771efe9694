"""What can be wrong with a mesh that can be read, and the registry in which ailments announce themselves."""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass, field
from typing import Any, ClassVar

import numpy as np

from hexmend.mesh.mesh import Mesh
from hexmend.registry import Registry

#: No hexes, or no nodes.
NONE_FOUND = np.empty(0, np.int64)


@dataclass(frozen=True, eq=False)
class Finding:
    """Something to know of a mesh.

    Parameters
    ----------
    kind : str
        The name of the ailment.
    count : int
        How many there are, of whatever the message counts.
    message : str
        A sentence.
    remedy : str
        What to do about it, as a sentence.
    mendable : bool
        Whether `hexmend.doctor.repair` mends it.
    hexes, nodes : (k,) int
        Where it is.
    """

    kind: str
    count: int
    message: str
    remedy: str = ""
    mendable: bool = False
    hexes: np.ndarray = field(default_factory=lambda: NONE_FOUND)
    nodes: np.ndarray = field(default_factory=lambda: NONE_FOUND)

    def to_dict(self, most: int = 10) -> dict[str, Any]:
        """The finding for other programs, with its first places."""
        return {
            "kind": self.kind,
            "count": self.count,
            "message": self.message,
            "remedy": self.remedy,
            "mendable": self.mendable,
            "hexes": self.hexes[:most].tolist(),
            "nodes": self.nodes[:most].tolist(),
        }

    def location_text(self, most: int = 5) -> str:
        """The first places in words.

        >>> Finding("unused-nodes", 7, "", nodes=np.arange(7)).location_text(3)
        'nodes 0, 1, 2, ...'
        >>> Finding("flipped-hexes", 1, "", hexes=np.array([12])).location_text()
        'hex 12'
        """
        name, numbers = ("hex", self.hexes) if len(self.hexes) else ("node", self.nodes)
        if not len(numbers):
            return ""
        plural = {"hex": "hexes", "node": "nodes"}[name] if len(numbers) > 1 else name
        return f"{plural} {', '.join(str(int(k)) for k in numbers[:most])}{', ...' if len(numbers) > most else ''}"


def count_phrase(count: int, one: str, several: str) -> str:
    """
    >>> count_phrase(1, "hex is", "hexes are"), count_phrase(2000, "hex is", "hexes are")
    ('1 hex is', '2,000 hexes are')
    """
    return f"{count:,} {one if count == 1 else several}"


class Problem(ABC):
    """A kind of trouble: how it is found and, if it can be, mended."""

    #: The key in AILMENTS, and what the viewer calls it.
    name: ClassVar[str]
    title: ClassVar[str]
    #: The place in the order in which ailments are looked for and mended.
    rank: ClassVar[int]
    #: What `repair` does about it, as words after "to"; "" where nothing can be done.
    action: ClassVar[str] = ""

    def find(self, mesh: Mesh, quick: bool = False) -> Finding | None:
        """What there is of it; None for nothing. `quick`: only what can be found without a search in space."""
        where = self.locate(mesh, quick)
        return self.describe(mesh, where) if where.size else None

    @abstractmethod
    def locate(self, mesh: Mesh, quick: bool = False) -> np.ndarray:
        """The hexes, or the nodes, that have it, ascending, (k,) int64."""

    @abstractmethod
    def describe(self, mesh: Mesh, where: np.ndarray) -> Finding:
        """What there is of it: `locate` is what the method of that name gives, and not empty."""

    def mend(self, mesh: Mesh) -> Mesh:
        """The mesh without it, as far as that goes."""
        return mesh


#: Every ailment by name.
PROBLEMS: Registry[Problem] = Registry("problem")


def register_problem(cls: type[Problem]) -> type[Problem]:
    """Class decorator: register an ailment under its name."""
    PROBLEMS.add(cls.name, cls())
    return cls
