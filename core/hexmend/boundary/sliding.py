"""Sliding of boundary nodes on a surface: projection, tangents, and rejection of moves that harm the boundary."""

from __future__ import annotations

import copy
from collections.abc import Callable
from functools import cached_property

import numpy as np

from hexmend.aliases import reads_old_names
from hexmend.arrays import differing_rows, index_of, mask
from hexmend.boundary.band import NO_NODES, Band
from hexmend.boundary.classification import NodeClass, classify
from hexmend.boundary.closest_point import MAX_CLOSEST_COORDINATE, ClosestPoints, triangulate
from hexmend.boundary.edges import SurfaceEdges
from hexmend.boundary.feature_edges.corner_detection import boundary_with_kept_corners
from hexmend.boundary.feature_edges.features import FEATURE_ANGLE, FeatureAngle, marked_corners, marked_edges, ridges
from hexmend.boundary.flat_parts import flat_motion
from hexmend.boundary.normals import unit_vectors, vertex_normals
from hexmend.boundary.restrictions import fixed_on_surface, freed_by_rules, interface_nodes, moving_with_surface
from hexmend.boundary.skin_surface import MAX_TARGET_DISTANCE, SkinSurface
from hexmend.boundary.surface import PartitionedSurface
from hexmend.errors import MeshError
from hexmend.kernels import sliding_surface as kernels
from hexmend.mesh.linear_motion import LinearMotion
from hexmend.mesh.mesh import Mesh
from hexmend.mesh.topology import CSR
from hexmend.mesh.validation import as_points, points_like

#: A point is inside a triangle or segment if all its weights there exceed this; its tangent is then that of the
#: triangle or segment, else one interpolated between vertices.
_INTERIOR_WEIGHT = 1e-3
#: Cached properties that depend on which nodes slide.
_OF_SLIDING_NODES = ("sliding_surface", "curved_nodes", "linear_mesh", "_flat", "rings")


@reads_old_names
class SlidingBoundary(Band):
    """A mesh whose boundary nodes slide on a surface: nodes of curves along curves, nodes of patches on patches.

    Interfaces between materials are patches of the surface too, and nodes on them slide as the rules of the mesh say.
    Corners and pinned nodes stay. On a target surface interfaces stay. Nodes with a linear motion do not slide: they
    move as that says.

    Parameters
    ----------
    mesh : Mesh
        Nodes slide on its `target`, or else on the boundary that its `surface_points` define.
    feature_angle : float or "auto"
        Dihedral angle beyond which an edge is a feature; see `boundary_of`.
    max_deviation : float
        Largest distance of the boundary's edge and face midpoints from the surface, in the mesh's unit.
    outer : bool
        Let the nodes of the boundary slide; else only those do for which the rules of the mesh say so.
    sets_hold : bool
        Nodes at edges between two sets never leave the surface, as those at marked edges.

    Attributes
    ----------
    boundary : Boundary
        With nodes that stay as corners, and without the faces of interfaces that freed nodes take off the surface.
    surface : Surface
    node_class : (n,) uint8
        `NodeClass` of each node with respect to the surface.
    releasable : (n,) bool
        True for corners found by angle, which may be made to slide; false for those that are marked or pinned.
    confined : (n,) bool
        True for nodes that never leave the surface: those of interfaces and of edges that are marked or, with
        `sets_hold`, lie between sets.
    mesh : Mesh
        The given mesh with only corners, pinned nodes and unused nodes fixed; its sliding nodes lie on the target.
    nodes : (k,) int64
        Sliding nodes, ascending.
    """

    def __init__(
        self,
        mesh: Mesh,
        feature_angle: FeatureAngle = FEATURE_ANGLE,
        max_deviation: float = np.inf,
        outer: bool = True,
        sets_hold: bool = True,
    ):
        whole = boundary_with_kept_corners(mesh, feature_angle)
        stays = fixed_on_surface(mesh, outer)
        self.boundary = whole.with_corners(np.flatnonzero(stays)).without_nodes(freed_by_rules(mesh))
        target, start = mesh.target, mesh.surface_points
        if target is None:
            self.surface = PartitionedSurface(start, self.boundary)
        else:
            given = _partitioned(target, feature_angle)
            self.surface = given.attached(start, self.boundary, MAX_TARGET_DISTANCE * mesh.mean_edge_length)
        self.node_class = self.surface.node_class
        moves_with = moving_with_surface(mesh, whole.faces)
        self.boundary = self.boundary.with_faces(moves_with)
        self._left_faces = whole.faces[~moves_with]
        slides = self.node_class >= NodeClass.CURVE
        if mesh.linear_motion is not None:
            slides &= ~mesh.linear_motion.marks(mesh.n_nodes)
        self.nodes = np.flatnonzero(slides)
        self.releasable = self.boundary.node_class == NodeClass.CORNER
        self.releasable[marked_corners(mesh)] = False
        self._of_interfaces = mask(whole.patch_of_face[len(mesh.topology.boundary_faces) :], whole.n_patches)
        self.confined = interface_nodes(mesh).copy()
        self.confined[marked_edges(mesh) if sets_hold else ridges(mesh)] = True
        self.releasable &= ~(stays | self.confined)
        self._group = self.surface.group_of(self.nodes)
        self._number = index_of(self.nodes, mesh.n_nodes)
        self._known = np.full(self.nodes.size, -1, dtype=np.int32)  # piece on which each of them was last
        if target is not None:
            start, mesh = self.projected(start), mesh.with_points(self.projected(mesh.points))
        super().__init__(mesh.surface_points, self.boundary.faces, start, target, max_deviation)
        self.mesh = mesh.with_fixed(mesh.fixed & ~slides)

    @property
    def leavable(self) -> np.ndarray:
        """Nodes of the boundary that may leave the surface where it holds the hexes down, (n,) bool."""
        leavable = self.releasable & self.mesh.fixed
        leavable[self.nodes] = True
        return leavable & ~self.confined

    def without_nodes(self, nodes: np.ndarray, max_deviation: float) -> SlidingBoundary:
        """Return the sliding boundary with some nodes (k,) free: they move in all directions, off the surface too.

        The band is `max_deviation` wide, in the mesh's unit, and quads at these nodes may be turned over.
        """
        other, freed = copy.copy(self), mask(nodes, self.mesh.n_nodes)
        for name in _OF_SLIDING_NODES:
            vars(other).pop(name, None)
        judged = ~freed[self.boundary.faces].any(axis=1)
        other.boundary, other.node_class = self.boundary.without_nodes(nodes).with_faces(judged), self.node_class.copy()
        vars(other)["outward"], other.max_deviation = self.outward[judged], max_deviation
        other.node_class[nodes] = NodeClass.INSIDE
        stays = ~freed[self.nodes]
        other.nodes, other._group, other._known = self.nodes[stays], self._group[stays], self._known[stays]
        other._number = index_of(other.nodes, self.mesh.n_nodes)
        other.mesh = self.mesh.with_fixed(self.mesh.fixed & ~freed)
        return other

    def with_nodes_on_patches(self, nodes: np.ndarray) -> SlidingBoundary:
        """Return the sliding boundary with nodes (k,) of curves on all its patches but those of interfaces."""
        other = copy.copy(self)
        for name in _OF_SLIDING_NODES:
            vars(other).pop(name, None)
        other.surface, at = self._surface_with_union, self._number[nodes]
        other.node_class, other._group = self.node_class.copy(), self._group.copy()
        other.node_class[nodes], other._group[at] = NodeClass.PATCH, self._union
        other._known = np.full(self.nodes.size, -1, dtype=np.int32)
        return other

    @property
    def _union(self) -> int:
        """Number of the group of all patches in a surface that has it."""
        return self.surface.n_patches + self.surface.n_curves

    @cached_property
    def _surface_with_union(self) -> PartitionedSurface:
        surface = self.surface
        if surface.trees.roots.size > self._union:
            return surface
        # a target has no interfaces
        return surface.with_union(~self._of_interfaces if self._given is None else np.ones(surface.n_patches, bool))

    def on_several_patches(self, nodes: np.ndarray) -> np.ndarray:
        """Mark those of some sliding nodes (k,) that slide on all patches, (k,) bool."""
        return self._group[self._number[nodes]] == self._union

    def with_band(self, max_deviation: float) -> SlidingBoundary:
        """Return the sliding boundary with another width of the band, in the mesh's unit."""
        other = copy.copy(self)
        other.max_deviation = max_deviation
        return other

    def slides(self, nodes: np.ndarray) -> np.ndarray:
        """Return True for each of some nodes (k,) that slides, (k,) bool."""
        return self._number[nodes] >= 0

    def project(self, x: np.ndarray, nodes: np.ndarray | None = None) -> np.ndarray:
        """Project positions of sliding nodes onto the closest points of their own curves and patches.

        Parameters
        ----------
        x : (k, 3) float64
            Positions in the mesh's unit of length.
        nodes : (k,) int, optional
            Numbers of these nodes; all sliding nodes by default.

        Returns
        -------
        (k, 3) float64

        Raises
        ------
        MeshError
            For coordinates that are not finite or are too large.
        """
        return self._closest(x, nodes).points

    def projected(self, points: np.ndarray) -> np.ndarray:
        """Return a copy of the points of all nodes, (n, 3), with the sliding nodes projected as by `project`."""
        points = points.copy()
        points[self.nodes] = self.project(points[self.nodes])
        return points

    def tangent_bases(self, x: np.ndarray, nodes: np.ndarray | None = None) -> np.ndarray:
        """Compute orthonormal directions in which sliding nodes may move.

        Parameters
        ----------
        x : (k, 3) float64
            Positions on the surface, in the mesh's unit of length.
        nodes : (k,) int, optional
            Numbers of these nodes; all sliding nodes by default.

        Returns
        -------
        (k, 3, 3) float64
            Directions in columns: one for a node of a curve, two for one of a patch; the other columns are 0.
        """
        of, found = self.nodes if nodes is None else nodes, self._closest(x, nodes)
        curve = self.node_class[of] == NodeClass.CURVE
        weights = found.weights.copy()
        weights[curve, 2] = 1.0  # a segment has two
        inner = weights.min(axis=1, keepdims=True) > _INTERIOR_WEIGHT
        along = np.where(inner, self.surface.directions(found, smooth=False), self.surface.directions(found))
        bases = np.zeros((len(of), 3, 3))
        bases[curve, :, 0] = along[curve]
        bases[~curve, :, :2] = _tangent_basis(along[~curve])
        return bases

    def tangents(self, points: np.ndarray) -> np.ndarray:
        """Return the first two directions of `tangent_bases` of all sliding nodes, each as a row (k, 6).

        Parameters
        ----------
        points : (n, 3) float64
            Positions of all nodes of the mesh.
        """
        return np.ascontiguousarray(self.tangent_bases(points[self.nodes])[:, :, :2].transpose(0, 2, 1)).reshape(-1, 6)

    @cached_property
    def sliding_surface(self) -> kernels.SlidingSurface:
        """The curves, patches and boundary quads as the kernels of methods take them."""
        trees, faces = self.surface.trees, self.boundary.faces
        at = self._number[faces.ravel()]
        order = np.argsort(at, kind="stable")
        quads_at = order[np.searchsorted(at[order], 0) :].astype(np.int32)
        start = np.searchsorted(at[quads_at], np.arange(self.nodes.size + 1)).astype(np.int32)
        quads = kernels.BoundaryQuads(start, quads_at, faces, self.outward)
        return kernels.SlidingSurface(self._number, trees.roots[self._group], trees.box_trees, quads, self._known)

    @cached_property
    def curved_nodes(self) -> np.ndarray:
        """Sliding nodes that are neither on a flat patch nor on a straight curve, ascending, (k,) int64."""
        if self._given is not None:  # a surface of its own
            return self.nodes
        return self.nodes[~self._flat.marks(self.mesh.n_nodes)[self.nodes]]

    @cached_property
    def linear_mesh(self) -> Mesh:
        """`mesh`, in which nodes of flat patches and straight curves have a linear motion, in plane and along line."""
        mesh = self.mesh
        if self._given is not None or not self._flat:
            return mesh
        flat, start, given = self._flat, mesh.motion_start.copy(), mesh.linear_motion
        start[flat.nodes] = self.points[flat.nodes]
        motion = flat if given is None else given.merge(flat)
        return mesh.with_points(start).with_linear_motion(motion).with_points(mesh.points).with_fixed(mesh.fixed)

    @cached_property
    def _flat(self) -> LinearMotion:
        return flat_motion(self.points, self.boundary, self.nodes, self.mesh.mean_edge_length)

    @cached_property
    def outward(self) -> np.ndarray:
        """Outward normals of the original boundary faces, averaged with those of the faces around, (k, 3)."""
        faces = self.boundary.faces
        vertices, triangles, face = triangulate(self.points, faces)
        normals = vertex_normals(vertices, triangles, self.boundary.patch_of_face[face])
        return unit_vectors(normals[:, :2].mean(axis=1).reshape(len(faces), 4, 3).mean(axis=1))

    @cached_property
    def rings(self) -> CSR:
        """Edge neighbours of each node; of a sliding node only those on its own curve or patch and on its ends."""
        node_class, whole = self.node_class, self.mesh.topology.rings
        node = np.repeat(np.arange(self.mesh.n_nodes), np.diff(whole.start))
        edges = [np.stack([node, whole.items], axis=1)[self._number[node] < 0]]
        across = np.concatenate([self.skin.edges.nodes, SurfaceEdges(self._left_faces, self.mesh.n_nodes).nodes])
        across = np.unique(across, axis=0) if len(self._left_faces) else across
        for of, along in (NodeClass.CURVE, self.boundary.segments), (NodeClass.PATCH, across):
            both = np.concatenate([along, along[:, ::-1]])
            edges.append(both[node_class[both[:, 0]] == of])
        edges = np.concatenate(edges)
        edges = edges[np.lexsort((edges[:, 1], edges[:, 0]))]
        start = np.searchsorted(edges[:, 0], np.arange(self.mesh.n_nodes + 1))
        return CSR(start.astype(np.int32), np.ascontiguousarray(edges[:, 1], dtype=np.int32))

    def flipped_quads(self, before: np.ndarray, after: np.ndarray) -> np.ndarray:
        """Find boundary faces that are flipped after a step and were not before.

        A quad is flipped if its normal points against that of the original boundary there, or if it is flat.

        Parameters
        ----------
        before, after : (n, 3) float64
            Node positions.

        Returns
        -------
        (k,) int
            Numbers of faces of `boundary`.
        """
        before, after = (points_like(points, self.mesh.points.shape) for points in (before, after))
        found = np.empty(len(self.boundary.faces), dtype=bool)
        kernels.flipped_quads(before, after, self.boundary.faces, self.outward, found)
        return np.flatnonzero(found)

    def rejected_nodes(self, before: np.ndarray, after: np.ndarray, changed: np.ndarray | None = None) -> np.ndarray:
        """Find nodes whose moves flip a quad or take the boundary out of its band, (k,) int.

        Parameters
        ----------
        before, after : (n, 3) float64
            Node positions.
        changed : (n,) bool, optional
            Nodes at which the band is examined; all by default.
        """
        flipped = self.boundary.faces[self.flipped_quads(before, after)].ravel()
        return np.union1d(flipped, self.nodes_outside_band(after, changed))

    def reject_flips(self, before: np.ndarray, after: np.ndarray, exempt: np.ndarray | None = None) -> np.ndarray:
        """Undo the moves of nodes whose quads a step flips, until none is flipped.

        Parameters
        ----------
        before, after : (n, 3) float64
            Node positions.
        exempt : (n,) bool, optional
            Nodes whose quads may be flipped.

        Returns
        -------
        (n, 3) float64
            `after`, or a copy of it.
        """

        def rejected(points: np.ndarray) -> np.ndarray:
            quads = self.boundary.faces[self.flipped_quads(before, points)]
            return np.unique(quads if exempt is None else quads[~exempt[quads].any(axis=1)])

        return _undone(before, after, rejected)

    def reject_moves(
        self, before: np.ndarray, after: np.ndarray, harmed: Callable[[np.ndarray], np.ndarray] = lambda after: NO_NODES
    ) -> np.ndarray:
        """Undo the moves of `rejected_nodes` and of others that a function names, until none is left.

        Parameters
        ----------
        before, after : (n, 3) float64
            Node positions.
        harmed : callable
            Maps node positions (n, 3) to more nodes whose moves are rejected, (k,) int.

        Returns
        -------
        (n, 3) float64
            `after`, or a copy of it.
        """
        return _undone(before, after, lambda points: np.union1d(self.rejected_nodes(before, points), harmed(points)))

    def _closest(self, x: np.ndarray, nodes: np.ndarray | None) -> ClosestPoints:
        x = as_points(x, "places of sliding nodes")
        slots = slice(None) if nodes is None else self._number[nodes]
        try:
            found = self.surface.trees.closest(x, self._group[slots], known=self._known[slots])
            self._known[slots] = found.pieces  # the next place of a node is near this one
            return found
        except MeshError:
            far = np.flatnonzero(~(np.abs(x) < MAX_CLOSEST_COORDINATE).all(axis=1))
            if not far.size:
                raise
            row = far[0]
            node = int((self.nodes if nodes is None else nodes)[row])
            raise MeshError(
                f"node {node} cannot slide: no place of the surface is closest to {x[row].tolist()}; expected finite "
                f"coordinates below {MAX_CLOSEST_COORDINATE:g}. Correct its place, or pin it."
            ) from None


def _partitioned(target: SkinSurface, feature_angle: FeatureAngle) -> PartitionedSurface:
    """Curves and patches of a surface, which keeps them: a run and its report need those of a large one again."""
    known = target.derived.get(feature_angle)
    if known is None:
        boundary = classify(target.points, target.faces, feature_angle, edges=target.edges)
        known = target.derived[feature_angle] = PartitionedSurface(target.points, boundary)
    return known


def _undone(before: np.ndarray, after: np.ndarray, rejected: Callable[[np.ndarray], np.ndarray]) -> np.ndarray:
    """Move rejected nodes back to their positions before a step, until none of those that have moved is rejected."""
    while True:
        nodes = rejected(after)
        nodes = nodes[differing_rows(after[nodes], before[nodes])]
        if not nodes.size:
            return after
        after = after.copy()
        after[nodes] = before[nodes]


def _tangent_basis(normals: np.ndarray) -> np.ndarray:
    """Two unit vectors at right angles to each other and to each normal, the columns of (k, 3, 2); 0 where it is 0."""
    axis = np.abs(normals).argmin(axis=1)
    first = np.cross(normals, np.eye(3)[axis])
    first /= np.maximum(np.linalg.norm(first, axis=1, keepdims=True), np.finfo(float).tiny)
    return np.stack([first, np.cross(normals, first)], axis=-1)
