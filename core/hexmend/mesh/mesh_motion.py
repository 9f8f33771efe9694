"""Motion of the nodes of a mesh: fixed and free nodes, interfaces, rules, linear motion and surfaces for sliding."""

from __future__ import annotations

from functools import cached_property
from typing import Any, Protocol, TypeVar

import numpy as np

from hexmend.arrays import as_immutable
from hexmend.errors import MeshError
from hexmend.hooks import hook
from hexmend.mesh.hexahedron import FACES
from hexmend.mesh.linear_motion import LinearMotion
from hexmend.mesh.linear_motion.constrained_points import constrained_points, with_ties_fixed
from hexmend.mesh.materials import STRUCTURED_BLOCKS, Materials, find_materials
from hexmend.mesh.mesh_data import MeshData
from hexmend.mesh.rules.motion_rules import MotionRules, NodeRules
from hexmend.mesh.second_order import corners_of_mid_nodes
from hexmend.mesh.validation import as_bools, check_finite, points_like
from hexmend.terminal_text import count_phrase

#: Cached properties that do not depend on the points.
SHARED = ("fixed", "free", "immovable", "embedded", "materials", "middles", "hanging_motion")
#: Those that do not depend on the linear motion.
_OF_RULES = ("materials", "embedded", "immovable", "hanging_motion")
#: The linear motion of meshes that have none.
NO_MOTION = LinearMotion()
#: Corners of cells of dimension 0 to 2; others have four.
_CORNERS = {"vertex": 1, "line": 2, "line3": 2, "triangle": 3, "triangle6": 3}

M = TypeVar("M", bound="MeshMotion")


class TargetSurface(Protocol):
    """Surface on which the boundary of a mesh can slide, such as `hexmend.boundary.SkinSurface`."""

    points: np.ndarray
    faces: np.ndarray
    name: str

    def check_near(self, mesh: MeshMotion) -> None:
        """Raise `MeshError` unless the boundary of a mesh lies near the surface."""


class MeshMotion(MeshData):
    """Base of `hexmend.Mesh`: what holds its nodes, and along what they move."""

    @cached_property
    def materials(self) -> Materials | None:
        """The partition of the hexes by material; None for one material. See `hexmend.mesh.materials`."""
        blocks = self.field_data.get(STRUCTURED_BLOCKS, ())
        blocks = {str(name) for name in np.ravel(np.asarray(blocks, dtype=object))}
        return find_materials(self.topology, self.hex_sets, self.hex_data, blocks, self.cells)

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
    def embedded(self) -> np.ndarray:
        """True for nodes of faces, edges and points of the file inside the mesh, (n,) bool: of baffles, beams, masses.

        Faces are cells and those of side sets. Nodes of the boundary and of interfaces between materials are not among
        them.
        """
        marks = np.zeros(self.n_nodes, dtype=bool)
        for cells in self.cells:
            if cells.dimension < 3:
                marks[cells.nodes[:, : _CORNERS.get(cells.kind, 4)]] = True
        for rows in self.side_sets.values():
            marks[self.hexes[rows[:, :1], FACES[rows[:, 1]]]] = True
        if marks.any():
            marks &= ~self.topology.boundary
        if marks.any() and self.materials is not None:
            marks &= ~self.materials.interface_nodes
        return as_immutable(marks)

    @cached_property
    def immovable(self) -> np.ndarray:
        """True for nodes that stay where they are even if the boundary slides: pinned, embedded or fixed by a rule.

        (n,) bool. So do the nodes with which such a mid-node or hanging node would move.
        """
        rules = self.node_rules
        stays = np.zeros(self.n_nodes, dtype=bool) if self.pinned is None else self.pinned.copy()
        if rules.interfaces != "free":
            stays |= self.embedded
        if rules.free is not None:
            stays &= ~rules.free
        if rules.fixed is not None:
            stays |= rules.fixed
        if self.mid_nodes is not None and stays.any():
            stays |= corners_of_mid_nodes(stays, self.hexes, self.mid_nodes)
        if stays.any():
            hanging = self.topology.hanging
            stays[hanging[stays[hanging[:, 0]], 1:]] = True
        stays[self.middles[stays[self.middles[:, 0]], 1:]] = True
        return as_immutable(stays)

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

    @property
    def surface_points(self) -> np.ndarray:
        """Node positions, (n, 3), that define the surface on which the boundary slides; see `keeping_surface`."""
        return self.__dict__.get("_surface", self.points)

    @property
    def target(self) -> TargetSurface | None:
        """Surface on which the boundary slides if that is not the original boundary; see `sliding_on`."""
        return self.__dict__.get("_target")

    def sliding_on(self: M, surface: TargetSurface | None, *, check: bool = True) -> M:
        """Return the mesh with a surface on which its boundary slides, such as `hexmend.read_surface` gives.

        Methods that let the boundary slide first project its nodes onto that surface; other methods ignore it.

        Parameters
        ----------
        surface : hexmend.boundary.SkinSurface or None
            None for its own boundary.
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
        if surface is None:
            copy = self._copy(*SHARED)
            copy.__dict__.pop("_target", None)
            return copy
        if check:
            surface.check_near(self)
        return self._copy(*SHARED, _target=surface)

    def keeping_surface(self: M) -> M:
        """Return the mesh with its present boundary kept as the surface for sliding, whatever points it gets later."""
        return self._copy(*SHARED, _surface=self.surface_points)

    def moving_from(self: M, points: np.ndarray) -> M:
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
        points = as_immutable(points)
        names = [name for name in ("_linear", "_linear_of_rules") if name in self.__dict__]
        linear = {name: (self.__dict__[name][0], points) for name in names}
        return self._copy(*SHARED, _surface=points, **linear)

    @cached_property
    def hanging_motion(self) -> LinearMotion:
        """The linear motion of the hanging nodes of the topology; empty if there are none."""
        rows = self.topology.hanging
        return LinearMotion.between(rows) if len(rows) else NO_MOTION

    @property
    def _constraints(self) -> tuple[LinearMotion, np.ndarray]:
        """The linear motion, and the positions from which its displacements are counted."""
        given = self.__dict__.get("_linear_of_rules") or self.__dict__.get("_linear")
        return given or (self.hanging_motion, self.points)

    @property
    def linear_motion(self) -> LinearMotion | None:
        """Linear constraints on the displacements of nodes, None if there are none; see `with_linear_motion`.

        Hanging nodes (`Topology.hanging`) move with the nodes between which they hang, whatever is given.
        """
        return self._constraints[0] or None

    @property
    def motion_start(self) -> np.ndarray:
        """Node positions, (n, 3), from which the displacements of the linear motion are counted."""
        return self._constraints[1]

    def with_linear_motion(self: M, motion: LinearMotion | None, start: np.ndarray | None = None) -> M:
        """Return the mesh with linear constraints on the displacements of its nodes.

        Nodes that are restricted to a plane or line, tied nodes and those they follow are free to move, also on the
        boundary, unless they are pinned. Nodes that are tied to a fixed node are fixed.

        Parameters
        ----------
        motion : LinearMotion or None
            Constraints that replace those of the mesh; none end them.
        start : (n, 3) float64, optional
            Positions from which displacements are counted; by default where the nodes are now.

        Returns
        -------
        Mesh

        Raises
        ------
        MeshError
            For a node that does not exist.
        """
        mesh = self.without_motion_of_rules()._copy(*_OF_RULES)
        mesh.__dict__.pop("_linear", None)
        if not motion:
            return mesh
        if motion.largest_node >= self.n_nodes:
            raise MeshError(
                f"the linear motion names node {motion.largest_node}, but the mesh has "
                f"{count_phrase(self.n_nodes, 'node')}, counted from 0: correct the number"
            )
        motion = motion.without_hanging().merge(self.hanging_motion)
        mesh._set(_linear=(motion, self.points if start is None else as_immutable(start)))
        return mesh

    def with_motion_of_rules(self: M, motion: LinearMotion) -> M:
        """Return the mesh with a linear motion that includes that of its rules; see `without_motion_of_rules`."""
        return self._copy(*_OF_RULES, _linear_of_rules=(motion, self.points))

    def without_motion_of_rules(self: M) -> M:
        """Return the mesh with the linear motion that it had before rules added theirs."""
        if "_linear_of_rules" not in self.__dict__:
            return self
        mesh = self._copy(*_OF_RULES)
        del mesh.__dict__["_linear_of_rules"]
        return mesh

    def constrained(self, points: np.ndarray) -> np.ndarray:
        """Return node positions, (n, 3), that keep the linear motion of the mesh; see `constrained_points`.

        Parameters
        ----------
        points : (n, 3) float64
            Returned themselves if the mesh has no linear motion; not changed.
        """
        motion, start = self._constraints
        return constrained_points(motion, start, points, self.free) if motion else points

    def with_fixed(self: M, fixed: np.ndarray) -> M:
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
        return self._copy(*_OF_RULES, fixed=as_immutable(fixed), _surface=self.surface_points)

    def with_free(self: M, nodes: np.ndarray) -> M:
        """Return the mesh with some nodes (n,) bool free, and those that hang on them; see `with_fixed`."""
        motion = self.linear_motion
        if motion is not None:
            nodes = nodes.copy()
            nodes[motion.hanging[nodes[motion.anchors]]] = True
        return self.with_fixed(self.fixed & ~nodes)

    def with_rules(self: M, **rules: Any) -> M:
        """Return the mesh with rules of motion by names of sets: fields of `hexmend.mesh.rules.MotionRules`.

        They hold for runs on this mesh; no file keeps them. See `hexmend.mesh.rules.resolution.with_rules`.

        Parameters
        ----------
        **rules
            Such as `interfaces="slide", fix=["inlet"]`.
        """
        return hook("with_rules")(self, MotionRules(**rules))

    def with_node_rules(self: M, rules: NodeRules) -> M:
        """Return the mesh with other rules of motion of its nodes; all else is shared.

        `hexmend.mesh.rules.resolution.with_rules` makes them of the names of sets.
        """
        return self._copy("materials", "embedded", "hanging_motion", _rules=rules)
