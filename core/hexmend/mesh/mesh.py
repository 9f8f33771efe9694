"""Hexahedral mesh: points, hexes, fixed nodes, and the sets and data of its file."""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property
from typing import Protocol

import numpy as np

from hexmend.arrays import as_immutable
from hexmend.errors import MeshError
from hexmend.hooks import hook
from hexmend.mesh.cells import Cells
from hexmend.mesh.edge_length import mean_edge_length
from hexmend.mesh.element_target import Target
from hexmend.mesh.fields import check_field
from hexmend.mesh.linear_motion import LinearMotion
from hexmend.mesh.linear_motion.constrained_points import constrained_points, with_ties_fixed
from hexmend.mesh.materials import STRUCTURED_BLOCKS, Materials, find_materials
from hexmend.mesh.rules.motion_rules import MotionRules, NodeRules
from hexmend.mesh.second_order import move_mid_nodes
from hexmend.mesh.size_limits import check_size
from hexmend.mesh.topology import Topology
from hexmend.mesh.validation import as_bools, as_hexes, as_points, check_finite, points_like

#: Attributes that are no fields, but kept by derived meshes: surfaces for sliding, target, rules, linear motion.
_DERIVED = ("_surface", "_target", "_element_target", "_rules", "_motion", "_motion_start")


class TargetSurface(Protocol):
    """Surface on which the boundary of a mesh can slide, such as `hexmend.boundary.SkinSurface`."""

    points: np.ndarray
    faces: np.ndarray
    name: str

    def check_near(self, mesh: Mesh) -> None:
        """Raise `MeshError` unless the boundary of a mesh lies near the surface."""


#: Cached properties that do not depend on the points.
_SHARED = ("fixed", "free", "immovable", "materials")
#: Fields from which the materials follow.
_OF_MATERIALS = {"hex_sets", "hex_data", "field_data"}


@dataclass(frozen=True, eq=False)
class Mesh:
    """Immutable hexahedral mesh; a change returns a copy that shares everything else.

    Arrays are copied unless they are immutable: the caller's stay writable, and changes to them do not change the mesh.

    Parameters
    ----------
    points : (n, 3) float64
        Coordinates in any unit of length; kept read-only.
    hexes : (m, 8) int32
        Corner nodes from 0, numbered as in `hexmend.mesh.hexahedron`; kept read-only.
    pinned : (n,) bool, optional
        Nodes that are fixed in addition to those of the boundary.
    node_data, hex_data : mapping of name to (n, ...) or (m, ...) array
        Ids, references and other values of the file.
    node_sets, hex_sets : mapping of name to (k,) int array
        Named groups of nodes and hexes.
    cells : tuple of Cells
        Cells of other kinds: boundary quads with references, feature edges, tetrahedra.
    name : str
        Name of the mesh; the file's stem.
    side_sets : mapping of name to (k, 2) int array
        Named groups of faces: the hex and the row of `hexmend.mesh.hexahedron.FACES`.
    mid_nodes : (m, 19) int32, optional
        Mid-nodes of second-order hexes, -1 where there is none; see `hexmend.mesh.second_order`. They follow the
        corners.
    field_data : mapping of name to array or list of str
        Values of the mesh as a whole.
    notes : tuple of str
        Changes made to the mesh on reading, as sentences.
    side_set_types : mapping of name to str
        Kinds of boundary that side sets are, by the names of OpenFOAM: wall, patch, symmetryPlane, empty, wedge...
    periodic_pairs : tuple of (str, str)
        Names of side sets of which one is a translated or rotated copy of the other.

    Raises
    ------
    MeshError
        For a coordinate that is not finite, a node number that is not whole or out of range, a set with members that
        do not exist, and an array of another shape or type (numbers that are booleans, complex or text).

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
    side_set_types: Mapping[str, str] = field(default_factory=dict)
    periodic_pairs: tuple[tuple[str, str], ...] = ()
    topology: Topology = field(init=False, repr=False)

    def __post_init__(self) -> None:
        points = as_points(self.points)
        check_finite(points)
        check_size(points)
        hexes = as_hexes(self.hexes, len(points))
        if not len(hexes):
            raise MeshError("hexes have shape (0, 8): expected (m, 8) with at least one hex")
        # A view, so that meshes share an array of hexes only if one was derived from the other and has its topology.
        self._set(points=as_immutable(points), hexes=as_immutable(hexes).view())
        self._set_checked(self._values())
        self._set(topology=Topology(self.hexes, len(points)))

    def __deepcopy__(self, memo: dict[int, object]) -> Mesh:
        return self  # it is immutable

    def __setstate__(self, state: Mapping[str, object]) -> None:
        """Restore a pickled state; its arrays are writable and are made immutable again."""
        self._set(**state)
        self._set(**{name: as_immutable(array) for name, array in state.items() if isinstance(array, np.ndarray)})
        self._set(hexes=self.topology.hexes)  # shared by meshes that are derived from each other
        self._set_checked(self._values())

    def _values(self) -> dict[str, object]:
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
    def n_nodes(self) -> int:
        """Number of nodes, used by a hex or not."""
        return len(self.points)

    @property
    def n_hexes(self) -> int:
        """Number of hexes."""
        return len(self.hexes)

    @cached_property
    def materials(self) -> Materials | None:
        """The partition of the hexes by material; None for one material. See `hexmend.mesh.materials`."""
        blocks = self.field_data.get(STRUCTURED_BLOCKS, ())
        blocks = {str(name) for name in np.ravel(np.asarray(blocks, dtype=object))}
        return find_materials(self.topology, self.hex_sets, self.hex_data, blocks)

    @property
    def node_rules(self) -> NodeRules:
        """Rules of motion of the nodes; see `hexmend.mesh.rules.resolution`."""
        return self.__dict__.get("_rules", NodeRules())

    @property
    def interfaces(self) -> Materials | None:
        """The materials if the nodes on the interfaces between them are kept or slide; None if they move freely."""
        return None if self.node_rules.interfaces == "free" else self.materials

    @property
    def slides_by_rule(self) -> bool:
        """True if nodes slide even where the boundary is fixed: those of interfaces, or of sets that rules name."""
        rules = self.node_rules
        return rules.slides is not None or (rules.interfaces == "slide" and self.materials is not None)

    @property
    def interior(self) -> np.ndarray:
        """True for nodes neither on the boundary nor on an interface that is kept or slides, (n,) bool."""
        inner = ~self.topology.boundary
        return inner if self.interfaces is None else inner & ~self.interfaces.interface_nodes

    @cached_property
    def immovable(self) -> np.ndarray:
        """True for nodes that stay where they are even if the boundary slides: pinned or fixed by a rule; (n,) bool."""
        rules = self.node_rules
        stays = np.zeros(self.n_nodes, dtype=bool) if self.pinned is None else self.pinned.copy()
        if rules.free is not None:
            stays &= ~rules.free
        return as_immutable(stays if rules.fixed is None else stays | rules.fixed)

    @cached_property
    def fixed(self) -> np.ndarray:
        """True for nodes that no method moves, unless they slide; (n,) bool.

        They are those of the boundary and of interfaces between materials, the pinned ones, and those of no hex. Nodes
        of the boundary with a linear motion may move; see `with_linear_motion`.
        """
        fixed, motion = self.topology.boundary | ~self.topology.used, self.linear_motion
        if motion is not None:
            fixed &= ~(motion.marks(self.n_nodes) & self.topology.used)
        fixed |= self.immovable
        materials, free = self.interfaces, self.node_rules.free
        if materials is not None:
            fixed |= materials.interface_nodes if free is None else materials.interface_nodes & ~free
        return as_immutable(fixed if motion is None else with_ties_fixed(motion, fixed))

    @cached_property
    def free(self) -> np.ndarray:
        """True for nodes that methods may move, (n,) bool."""
        return as_immutable(~self.fixed)

    @cached_property
    def mean_edge_length(self) -> float:
        """Mean edge length; see `hexmend.mesh.edge_length.mean_edge_length`."""
        return mean_edge_length(self.points, self.hexes)

    def quality(self, metric: str = "q") -> np.ndarray:
        """Return the values of a metric of `hexmend.METRICS`, (m,) float64; see `hexmend.quality.metric_values`."""
        return hook("quality")(self, metric)

    def worst(self, count: int = 10, metric: str = "q") -> np.ndarray:
        """Return the numbers of the worst hexes by a metric, worst first; see `hexmend.quality.worst_hexes`."""
        return hook("worst_hexes")(self, count, metric)

    def _repr_html_(self) -> str:
        """Return the HTML that a notebook shows."""
        return hook("html")(self)

    def with_points(self, points: np.ndarray) -> Mesh:
        """Return the mesh with other node positions; connectivity, topology, sets and data are shared.

        Mid-nodes of second-order hexes follow the corners; their rows of `points` are not read.

        Parameters
        ----------
        points : (n, 3) float64
            Copied unless immutable, such as those of another mesh or of an iteration.

        Returns
        -------
        Mesh

        Raises
        ------
        MeshError
            For another shape or type, and for a coordinate that is not finite.
        """
        points = points_like(points, self.points.shape)
        check_finite(points)
        if self.mid_nodes is not None:
            points = move_mid_nodes(self.points, points, self.hexes, self.mid_nodes)
        return self._copy(*_SHARED, points=as_immutable(points))

    @property
    def surface_points(self) -> np.ndarray:
        """Node positions, (n, 3), that define the surface on which the boundary slides; see `keeping_surface`."""
        return self.__dict__.get("_surface", self.points)

    surface = surface_points  # its name in version 0.1

    @property
    def target(self) -> TargetSurface | None:
        """Surface on which the boundary slides if that is not the original boundary; see `sliding_on`."""
        return self.__dict__.get("_target")

    def sliding_on(self, surface: TargetSurface, *, check: bool = True) -> Mesh:
        """Return the mesh with a surface on which its boundary slides, such as `hexmend.read_surface` gives.

        Methods that let the boundary slide first project its nodes onto that surface; other methods ignore it.

        Parameters
        ----------
        surface : hexmend.boundary.SkinSurface
        check : bool
            Check that the surface is near the boundary; not needed for one that the mesh had before.

        Returns
        -------
        Mesh

        Raises
        ------
        MeshError
            If the surface is far from the boundary.
        """
        if check:
            surface.check_near(self)
        return self._copy(*_SHARED, _target=surface)

    @property
    def element_target(self) -> Target | None:
        """Lengths that the hexes are to have; None if they are to be cubes. See `with_element_target`."""
        return self.__dict__.get("_element_target")

    def with_element_target(self, target: Target | None) -> Mesh:
        """Return the mesh with a target of its elements, which the energies of optimisers take from it.

        It is kept by meshes that are derived from this one, but not by `rebuilt`, which may have other hexes.

        Parameters
        ----------
        target : hexmend.mesh.element_target.Target or None
            None for cubes.

        Returns
        -------
        Mesh

        Raises
        ------
        MeshError
            For a target of another number of hexes.
        """
        if target is not None and len(target.lengths) != self.n_hexes:
            raise MeshError(f"the target is for {len(target.lengths)} hexes: the mesh has {self.n_hexes}")
        return self._copy(*_SHARED, _element_target=target)

    def keeping_surface(self) -> Mesh:
        """Return the mesh with its present boundary kept as the surface for sliding, whatever points it gets later."""
        return self._copy(*_SHARED, _surface=self.surface_points)

    def moving_from(self, points: np.ndarray) -> Mesh:
        """Return the mesh with other node positions that define its surface for sliding and start its linear motion.

        A mesh that a solver has moved, boundary and all, slides on its boundary of that time, not on an earlier one.

        Parameters
        ----------
        points : (n, 3) float64
            Copied unless immutable.

        Returns
        -------
        Mesh

        Raises
        ------
        MeshError
            For another shape or type, and for a coordinate that is not finite.
        """
        points = points_like(points, self.points.shape)
        check_finite(points)
        given = {"_surface": as_immutable(points)}
        if self.linear_motion is not None:
            given["_motion_start"] = given["_surface"]
        return self._copy(*_SHARED, **given)

    @property
    def linear_motion(self) -> LinearMotion | None:
        """Linear constraints on the displacements of nodes, None if there are none; see `with_linear_motion`."""
        return self.__dict__.get("_motion")

    def with_linear_motion(self, motion: LinearMotion | None) -> Mesh:
        """Return the mesh with linear constraints on the displacements of its nodes from where they are now.

        Nodes that are restricted to a plane or line, tied nodes and those they follow are free to move, also on the
        boundary, unless they are pinned. Nodes that are tied to a fixed node are fixed.

        Parameters
        ----------
        motion : LinearMotion or None
            Constraints that replace those of the mesh; none end them.

        Returns
        -------
        Mesh

        Raises
        ------
        MeshError
            For a node that does not exist.
        """
        if not motion:
            copy = self._copy("materials")
            copy.__dict__.pop("_motion", None)
            copy.__dict__.pop("_motion_start", None)
            return copy
        if motion.largest_node >= self.n_nodes:
            raise MeshError(
                f"the linear motion names node {motion.largest_node}, but the mesh has {self.n_nodes} nodes, counted "
                "from 0: correct the number"
            )
        return self._copy("materials", "immovable", _motion=motion, _motion_start=self.points)

    @property
    def motion_start(self) -> np.ndarray:
        """Node positions, (n, 3), from which the displacements of the linear motion are counted."""
        return self.__dict__.get("_motion_start", self.points)

    def constrained(self, points: np.ndarray) -> np.ndarray:
        """Return node positions, (n, 3), that keep the linear motion of the mesh; see `constrained_points`.

        Parameters
        ----------
        points : (n, 3) float64
            Returned themselves if the mesh has no linear motion; not changed.
        """
        motion = self.linear_motion
        return points if motion is None else constrained_points(motion, self.motion_start, points, self.free)

    def with_fixed(self, fixed: np.ndarray) -> Mesh:
        """Return the mesh with exactly these nodes fixed, whatever its boundary and pins; all else is shared.

        Nodes that are tied to them by a linear motion are fixed too.

        Parameters
        ----------
        fixed : (n,) bool

        Returns
        -------
        Mesh

        Raises
        ------
        MeshError
            For another length or type.
        """
        fixed = as_bools(fixed, "fixed", self.n_nodes)
        if self.linear_motion is not None:
            fixed = with_ties_fixed(self.linear_motion, fixed)
        return self._copy("materials", "immovable", fixed=as_immutable(fixed), _surface=self.surface_points)

    def with_rules(self, **rules: object) -> Mesh:
        """Return the mesh with rules of motion by names of sets: fields of `hexmend.mesh.rules.MotionRules`.

        They hold for runs on this mesh; no file keeps them. See `hexmend.mesh.rules.resolution.with_rules`.

        Parameters
        ----------
        **rules
            Such as `interfaces="slide", fix=["inlet"]`.
        """
        return hook("with_rules")(self, MotionRules(**rules))

    def with_node_rules(self, rules: NodeRules) -> Mesh:
        """Return the mesh with rules of motion of its nodes in place of those it has; all else is shared.

        `hexmend.mesh.rules.resolution.with_rules` makes them of the names of sets.
        """
        return self._copy("materials", _rules=rules)

    def replace(self, **changes: object) -> Mesh:
        """Return a copy with other values of some fields, but not points or hexes; all else is shared.

        Parameters
        ----------
        **changes
            Values of fields by name.

        Returns
        -------
        Mesh

        Raises
        ------
        MeshError
            For points or hexes, and for values that do not fit the mesh.
        TypeError
            For an unknown field.
        """
        if "points" in changes or "hexes" in changes:
            raise MeshError("replace() cannot change points or hexes: use with_points() or rebuilt()")
        unknown = changes.keys() - self._values().keys()
        if unknown:
            raise TypeError(f"a mesh has no {', '.join(sorted(unknown))}")
        copy = self._copy(*(() if changes.keys() & _OF_MATERIALS else ("materials",)))
        copy._set_checked(changes)
        return copy

    def rebuilt(self, **changes: object) -> Mesh:
        """Return a new mesh with other values of any fields, points and hexes included; the rest is taken over.

        Other points may be other nodes: a linear motion is taken over only without them.
        """
        mesh = Mesh(**self._values() | changes)
        if self.target is not None:
            mesh._set(_target=self.target)
        if "_rules" in self.__dict__ and "hexes" not in changes:
            mesh._set(_rules=self.node_rules)
        if self.linear_motion is not None and "points" not in changes:
            mesh._set(_motion=self.linear_motion, _motion_start=self.motion_start)
        return mesh

    def _copy(self, *cached: str, **changes: object) -> Mesh:
        """Return a copy with changes; it shares all fields, surfaces, the target and the named cached properties."""
        copy = object.__new__(Mesh)
        names = (*(one.name for one in dataclasses.fields(self)), *_DERIVED, *cached)
        copy._set(**{name: self.__dict__[name] for name in names if name in self.__dict__} | changes)
        return copy
