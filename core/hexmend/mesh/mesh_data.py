"""Fields of a mesh: their values are checked, immutable and shared by copies."""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

import numpy as np

from hexmend.arrays import as_immutable, as_immutable_owned
from hexmend.errors import MeshError
from hexmend.mesh.cells import Cells
from hexmend.mesh.fields import check_field
from hexmend.mesh.second_order import move_mid_nodes
from hexmend.mesh.size_limits import check_size
from hexmend.mesh.solid_cells import middles_of, solid_rows
from hexmend.mesh.topology import Topology
from hexmend.mesh.validation import as_hexes, as_points, check_finite

#: Attributes that are no fields, but kept by derived meshes: surfaces for sliding, target, rules, linear motion, and
#: the linear motion that includes the one of rules.
_DERIVED = ("_surface", "_target", "_element_target", "_rules", "_linear", "_linear_of_rules")


@dataclass(frozen=True, eq=False)
class MeshData:
    """Base of `hexmend.Mesh`, which documents the fields."""

    points: np.ndarray
    hexes: np.ndarray
    pinned: np.ndarray | None = None
    node_data: Mapping[str, np.ndarray] = field(default_factory=dict)
    hex_data: Mapping[str, np.ndarray] = field(default_factory=dict)
    node_sets: Mapping[str, np.ndarray] = field(default_factory=dict)
    hex_sets: Mapping[str, np.ndarray] = field(default_factory=dict)
    cells: tuple[Cells, ...] = ()
    name: str = ""
    side_sets: Mapping[str, np.ndarray] = field(default_factory=dict)
    mid_nodes: np.ndarray | None = None
    field_data: Mapping[str, object] = field(default_factory=dict)
    notes: tuple[str, ...] = ()
    side_set_types: Mapping[str, str] = field(default_factory=dict)
    periodic_pairs: tuple[tuple[str, str], ...] = ()
    renumbered: str = ""
    topology: Topology = field(init=False, repr=False)

    def __post_init__(self) -> None:
        points = as_points(self.points)
        check_finite(points)
        check_size(points)
        hexes = as_hexes(self.hexes, len(points))
        # A view, so that meshes share an array of hexes only if one was derived from the other and has its topology.
        self._set(points=as_immutable(points), hexes=as_immutable(hexes).view())
        self._set_checked(self._values())
        others = solid_rows(self.points, self.cells)
        if not len(hexes) + sum(map(len, others)):
            raise MeshError("hexes have shape (0, 8): expected (m, 8) with at least one hex, or cells that are solid")
        elements = as_immutable_owned(np.concatenate([self.hexes, *others])) if others else self.hexes
        self._set(topology=Topology(elements, len(points), len(hexes)))
        self._set(hexes=self.topology.hexes)

    def __deepcopy__(self, memo: dict[int, object]) -> MeshData:
        return self  # it is immutable

    def __setstate__(self, state: Mapping[str, object]) -> None:
        """Restore a pickled state; its arrays are writable and are made immutable again."""
        self._set(**state)
        self._set(**{name: as_immutable(array) for name, array in state.items() if isinstance(array, np.ndarray)})
        self._set(hexes=self.topology.hexes)  # shared by meshes that are derived from each other
        self._set_checked(self._values())

    def _values(self) -> dict[str, Any]:
        """Values of the fields that the constructor takes."""
        return {one.name: getattr(self, one.name) for one in dataclasses.fields(self) if one.init}

    def _set_checked(self, values: Mapping[str, object]) -> None:
        """Check the values of fields other than points and hexes, and set them."""
        for name, value in values.items():
            if name not in ("points", "hexes"):
                self._set(**{name: check_field(name, value, self.n_nodes, self.n_hexes)})

    def _set(self, **values: object) -> None:
        for name, value in values.items():
            object.__setattr__(self, name, value)

    @property
    def elements(self) -> np.ndarray:
        """All solid cells, (m, 8) int32: `hexes` first, then wedges, pyramids and tetrahedra, block after block.

        See `hexmend.mesh.solid_cells`. Those of the second order are here by their corners. A block whose cells are
        mostly inside out is turned here, not in `cells`.
        """
        return self.topology.elements

    @cached_property
    def middles(self) -> np.ndarray:
        """Mid-nodes of wedges, pyramids and tetrahedra of the second order, with the ends of their edges, (k, 3)."""
        return middles_of(self.cells, self.topology.used)

    @property
    def has_mid_nodes(self) -> bool:
        """True if cells of the second order have mid-nodes, which follow the corners."""
        return self.mid_nodes is not None or len(self.middles) > 0

    def with_mid_nodes_moved(self, points: np.ndarray) -> np.ndarray:
        """Return node positions (n, 3), of which corners are read, with the mid-nodes moved as their corners are."""
        if self.mid_nodes is not None:
            points = move_mid_nodes(self.points, points, self.hexes, self.mid_nodes)
        if len(self.middles):
            points = points.copy()
            middle, one, other = self.middles[::-1].T  # the first cell with a mid-node is written last
            moves = points - self.points
            points[middle] = self.points[middle] + (moves[one] + moves[other]) / 2
        return points

    @property
    def n_elements(self) -> int:
        """Number of all solid cells."""
        return len(self.topology.elements)

    @property
    def n_nodes(self) -> int:
        """Number of nodes, used by a cell or not."""
        return len(self.points)

    @property
    def n_hexes(self) -> int:
        """Number of hexes."""
        return len(self.hexes)

    def _copy(self, *cached: str, **changes: object) -> Any:
        """Return a copy with changes; it shares all fields, surfaces, the target and the named cached properties."""
        copy = object.__new__(type(self))
        names = (*(one.name for one in dataclasses.fields(self)), *_DERIVED, *cached)
        copy._set(**{name: self.__dict__[name] for name in names if name in self.__dict__} | changes)
        return copy
