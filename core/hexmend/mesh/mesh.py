"""The mesh: points, hexahedra, which nodes are fixed, and what the file said besides, carried through."""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property
from typing import Protocol

import numpy as np

from hexmend.arrays import as_immutable
from hexmend.errors import MeshError
from hexmend.hooks import provided
from hexmend.html_repr import html_of
from hexmend.mesh.cells import Cells
from hexmend.mesh.edge_length import mean_edge_length
from hexmend.mesh.fields import check_field
from hexmend.mesh.second_order import move_mid_nodes
from hexmend.mesh.size_limits import check_size
from hexmend.mesh.topology import Topology
from hexmend.mesh.validation import as_bools, as_hexes, as_points, check_finite, points_like


class TargetSurface(Protocol):
    """A surface that the boundary of a mesh can slide on; `hexmend.boundary.Skin` is one."""

    points: np.ndarray
    faces: np.ndarray
    name: str

    def check_near(self, mesh: Mesh) -> None:
        """Raise `MeshError` unless the boundary of a mesh lies near the surface."""


@dataclass(frozen=True, eq=False)
class Mesh:
    """A hexahedral mesh. Immutable: `with_points` returns a copy that shares everything else.

    Arrays are copied unless nobody can change them, so that the caller's own stay writable, and what becomes of them
    later does not change the mesh.

    Parameters
    ----------
    points : (n, 3) float64
        Coordinates in any unit of length; kept read-only.
    hexes : (m, 8) int32
        Corner nodes from 0, numbered as in `hexmend.mesh.hexahedron`; kept read-only.
    pinned : (n,) bool, optional
        Nodes to be kept fixed besides those of the boundary.
    node_data, hex_data : mapping of name to (n, ...) or (m, ...) array
        Ids, references and other values of the file.
    node_sets, hex_sets : mapping of name to (k,) int array
        Named groups.
    cells : tuple of Cells
        Cells of other kinds: boundary quads with references, feature edges, tetrahedra beside the hexes...
    name : str
        What to call the mesh; the file's stem.
    side_sets : mapping of name to (k, 2) int array
        Named groups of faces: the hex, and which of `hexmend.mesh.hexahedron.FACES` it is.
    mid_nodes : (m, 19) int32, optional
        Further nodes of hexes of second order, -1 where there is none: see `hexmend.mesh.second_order`. They follow the
        corners.
    field_data : mapping of name to array or list of str
        What belongs to the mesh as a whole.
    notes : tuple of str
        What was done to the mesh on reading, in sentences.

    Raises
    ------
    MeshError
        Where a coordinate is no finite number, a node number is not whole or out of range, a set names what does not
        exist, or an array has the wrong shape or type. Numbers that are booleans, complex or text are refused.

    Examples
    --------
    >>> from hexmend.mesh.hexahedron import UNIT_CUBE
    >>> mesh = Mesh(UNIT_CUBE, [[0, 1, 2, 3, 4, 5, 6, 7]])
    >>> mesh.n_hexes, mesh.n_nodes, int(mesh.free.sum())
    (1, 8, 0)
    """

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
    topology: Topology = field(init=False, repr=False)

    def __post_init__(self) -> None:
        points = as_points(self.points)
        check_finite(points)
        check_size(points)
        hexes = as_hexes(self.hexes, len(points))
        if not len(hexes):
            raise MeshError("hexes have shape (0, 8): expected (m, 8) with at least one hex")
        # A view: meshes share one array of hexes only where one was made of the other and has its topology.
        self._set(points=as_immutable(points), hexes=as_immutable(hexes).view())
        self._carry({one.name: getattr(self, one.name) for one in dataclasses.fields(self) if one.init})
        self._set(topology=Topology(self.hexes, len(points)))

    def __deepcopy__(self, memo: dict[int, object]) -> Mesh:
        return self  # it is immutable

    def __setstate__(self, state: Mapping[str, object]) -> None:
        """Take over the state of a pickle, whose arrays are writable: they are made immutable again."""
        self._set(**state)
        self._set(**{name: as_immutable(array) for name, array in state.items() if isinstance(array, np.ndarray)})
        self._set(hexes=self.topology.hexes)  # which meshes of one lineage share
        self._carry({one.name: getattr(self, one.name) for one in dataclasses.fields(self) if one.init})

    def _carry(self, values: Mapping[str, object]) -> None:
        """Check the values of some fields and keep them; points and hexes stay."""
        for name, value in values.items():
            if name not in ("points", "hexes"):
                self._set(**{name: check_field(name, value, self.n_nodes, self.n_hexes)})

    def _set(self, **values: object) -> None:
        for name, value in values.items():
            object.__setattr__(self, name, value)

    @property
    def n_nodes(self) -> int:
        """Number of nodes, used by a hex or not."""
        return len(self.points)

    @property
    def n_hexes(self) -> int:
        """Number of hexes."""
        return len(self.hexes)

    @cached_property
    def fixed(self) -> np.ndarray:
        """True for each node that no method moves: boundary, pinned, and nodes that no hex uses; (n,) bool."""
        fixed = self.topology.boundary | ~self.topology.used
        return as_immutable(fixed if self.pinned is None else fixed | self.pinned)

    @cached_property
    def free(self) -> np.ndarray:
        """True for each node that methods may move, (n,) bool."""
        return as_immutable(~self.fixed)

    @cached_property
    def mean_edge_length(self) -> float:
        """Mean length of the hexes' edges, each counted once a hex; see `hexmend.mesh.edge_length`."""
        return mean_edge_length(self.points, self.hexes)

    def quality(self, metric: str = "q") -> np.ndarray:
        """The values of a metric of `hexmend.METRICS`, (m,) float64: see `hexmend.quality.metric_values`."""
        return provided("quality")(self, metric)

    def worst(self, count: int = 10, metric: str = "q") -> np.ndarray:
        """The numbers of the worst hexes by a metric, the worst first: see `hexmend.quality.worst_hexes`."""
        return provided("worst_hexes")(self, count, metric)

    def _repr_html_(self) -> str:
        """What a notebook shows of it."""
        return html_of(self)

    def with_points(self, points: np.ndarray) -> Mesh:
        """The same mesh with its nodes elsewhere; connectivity, topology, sets and data are shared.

        Nodes of second order go where the corners of their hexes take them, whatever `points` says of them.

        Parameters
        ----------
        points : (n, 3) float64
            Copied, unless nobody can change them, as those of another mesh or of an iteration.

        Raises
        ------
        MeshError
            For another shape or type, or where a coordinate is no finite number.
        """
        points = points_like(points, self.points.shape)
        check_finite(points)
        if self.mid_nodes is not None:
            points = move_mid_nodes(self.points, points, self.hexes, self.mid_nodes)
        mesh = self._copy("fixed", "free")
        mesh._set(points=as_immutable(points))
        return mesh

    @property
    def surface_points(self) -> np.ndarray:
        """Node positions, (n, 3), that define the surface on which the boundary slides; see `keeping_surface`."""
        return self.__dict__.get("_surface", self.points)

    surface = surface_points  # its name in version 0.1

    @property
    def target(self) -> TargetSurface | None:
        """The surface that the boundary slides on where that is not the boundary itself; see `sliding_on`."""
        return self.__dict__.get("_target")

    def sliding_on(self, surface: TargetSurface, *, check: bool = True) -> Mesh:
        """The same mesh, whose boundary slides on another surface, such as `hexmend.read_surface` gives.

        Methods that let the boundary slide put its nodes on that surface first; others do as ever.

        Parameters
        ----------
        surface : hexmend.boundary.Skin
        check : bool
            Whether it has to be near; one that a mesh had before need not be looked at again.

        Raises
        ------
        MeshError
            Where the surface is far from the boundary.
        """
        if check:
            surface.check_near(self)
        copy = self._copy("fixed", "free")
        copy._set(_target=surface)
        return copy

    def keeping_surface(self) -> Mesh:
        """The same mesh, whose boundary slides on the surface of now wherever `with_points` puts its nodes."""
        copy = self._copy("fixed", "free")
        copy._set(_surface=self.surface_points)
        return copy

    def with_fixed(self, fixed: np.ndarray) -> Mesh:
        """The same mesh of which other nodes are fixed, whatever its boundary and pins say; all else is shared.

        Parameters
        ----------
        fixed : (n,) bool

        Raises
        ------
        MeshError
            For another length or type.
        """
        copy = self._copy()
        copy._set(fixed=as_immutable(as_bools(fixed, "fixed", self.n_nodes)), _surface=self.surface_points)
        return copy

    def replace(self, **changes: object) -> Mesh:
        """A copy with other pins, data, sets or name (not points or hexes); all else is shared.

        Raises
        ------
        MeshError
            For points or hexes, and where an array has the wrong length.
        TypeError
            For what a mesh does not have.
        """
        if "points" in changes or "hexes" in changes:
            raise MeshError("replace() changes what is carried; use with_points() or rebuilt()")
        unknown = changes.keys() - {one.name for one in dataclasses.fields(self) if one.init}
        if unknown:
            raise TypeError(f"a mesh has no {', '.join(sorted(unknown))}")
        copy = self._copy()
        copy._carry(changes)
        return copy

    def rebuilt(self, **changes: object) -> Mesh:
        """A mesh of its own with other points, hexes, or whatever else; what is not named is taken over."""
        mesh = Mesh(**{one.name: getattr(self, one.name) for one in dataclasses.fields(self) if one.init} | changes)
        if self.target is not None:
            mesh._set(_target=self.target)
        return mesh

    def _copy(self, *known: str) -> Mesh:
        """A copy that shares everything, and what is known or was told under some names; nothing is checked."""
        copy = object.__new__(Mesh)
        copy._set(**{one.name: getattr(self, one.name) for one in dataclasses.fields(self)})
        names = ("_surface", "_target", *known)
        copy._set(**{name: self.__dict__[name] for name in names if name in self.__dict__})
        return copy
