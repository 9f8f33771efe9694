"""A mesh whose boundary nodes slide on a surface, and what of them may leave it.

Nodes of a surface that do not slide on it: the rules of the mesh let them stay, or move freely.

Locked hexes that sliding of the boundary can free.
"""

from __future__ import annotations

from functools import cached_property

import numpy as np

from hexmend.arrays import mask, row_norms
from hexmend.boundary.classification import NodeClass, classify
from hexmend.boundary.edges import SurfaceEdges
from hexmend.boundary.feature_edges.corner_detection import boundary_with_kept_corners
from hexmend.boundary.feature_edges.features import FEATURE_ANGLE, FeatureAngle, marked_corners, marked_edges
from hexmend.boundary.marking import marked_segments
from hexmend.boundary.skin_surface import MAX_TARGET_DISTANCE, SkinSurface
from hexmend.boundary.sliding.curved_faces import flat_motion, flat_parts, surface_of_boundary
from hexmend.boundary.sliding.sliding_nodes import SlidingNodes
from hexmend.boundary.surface import PartitionedSurface
from hexmend.boundary.tolerances import FLAT_DISTANCE
from hexmend.mesh.linear_motion import LinearMotion
from hexmend.mesh.mesh import Mesh
from hexmend.mesh.rules.two_dimensional import flat_sides
from hexmend.mesh.solid_cells import corner_tetrahedra
from hexmend.mesh.topology import CSR
from hexmend.quality import corner_determinants


class SlidingBoundary(SlidingNodes):
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
        boundary = whole.with_corners(np.flatnonzero(stays)).without_nodes(freed_by_rules(mesh))
        target, start = mesh.target, mesh.surface_points
        if target is None:
            surface = surface_of_boundary(mesh, start, boundary)
        else:
            given = _partitioned(target, feature_angle)
            surface = given.attached(start, boundary, MAX_TARGET_DISTANCE * mesh.mean_edge_length)
        moves_with = moving_with_surface(mesh, whole.faces)
        slides = surface.node_class >= NodeClass.CURVE
        if mesh.linear_motion is not None:
            slides &= ~mesh.linear_motion.marks(mesh.n_nodes)
        nodes = np.flatnonzero(slides)
        inner = np.arange(len(whole.faces))[moves_with] >= len(mesh.topology.boundary_faces)
        super().__init__(boundary.with_faces(moves_with), surface, nodes, start, target, max_deviation, inner)
        if target is not None:
            at_start = np.array_equal(mesh.points, start)
            mesh = mesh.with_points(self._start if at_start else self.projected(mesh.points))
            self.points = mesh.surface_points
        self.mesh = mesh.with_free(slides)
        self._left_faces = whole.faces[~moves_with]
        self.releasable = self.boundary.node_class == NodeClass.CORNER
        self.releasable[marked_corners(mesh)] = False
        self._of_interfaces = mask(whole.patch_of_face[len(mesh.topology.boundary_faces) :], whole.n_patches)
        self.confined = interface_nodes(mesh).copy()
        self.confined[marked_edges(mesh) if sets_hold else marked_segments(mesh)] = True
        self.releasable &= ~(stays | self.confined)

    @property
    def surface_is_own(self) -> bool:
        """True if nodes slide on the boundary's own surface, on which each node lies exactly."""
        return self._given is None

    @property
    def start(self) -> np.ndarray:
        """Positions of all nodes before sliding, (n, 3); nodes of the boundary are on the surface."""
        return self._start

    @property
    def leavable(self) -> np.ndarray:
        """Nodes of the boundary that may leave the surface where it holds the hexes down, (n,) bool."""
        leavable = self.releasable & self.mesh.fixed
        leavable[self.nodes] = True
        return leavable & ~self.confined

    @cached_property
    def curved_nodes(self) -> np.ndarray:
        """Sliding nodes that are neither on a flat patch nor on a straight curve, ascending, (k,) int64."""
        return self.nodes[~self._flat.marks(self.mesh.n_nodes)[self.nodes]]

    def rejected(self, before: np.ndarray, after: np.ndarray, changed: np.ndarray | None = None) -> np.ndarray | None:
        """See `SlidingNodes.rejected`; nodes that leave their flat patch or straight curve are marked too.

        The band alone would let them go across its rim: they are in the plane or on the line still, and near the
        surface. A node that was outside may come nearer.
        """
        marks, nodes = super().rejected(before, after, changed), self._flat_nodes
        nodes = nodes if changed is None else nodes[changed[nodes]]
        away = self._distances(after, nodes)
        outside = away > FLAT_DISTANCE * (self.mesh.mean_edge_length or 1.0)
        nodes, away = nodes[outside], away[outside]
        if not nodes.size:
            return marks
        nodes = nodes[away > self._distances(before, nodes)]
        if nodes.size:
            marks = mask(nodes, len(after)) if marks is None else marks | mask(nodes, len(after))
        return marks

    @cached_property
    def _flat_nodes(self) -> np.ndarray:
        """Sliding nodes on flat patches and straight curves, ascending, (k,) int64."""
        return np.setdiff1d(self.nodes, self.curved_nodes, assume_unique=True)

    def _distances(self, points: np.ndarray, nodes: np.ndarray) -> np.ndarray:
        """Distances of sliding nodes (k,) from their curves and patches, (k,)."""
        return row_norms(self.project(points[nodes], nodes) - points[nodes])

    @cached_property
    def linear_mesh(self) -> Mesh:
        """`mesh`, in which nodes of flat patches and straight curves have a linear motion, in plane and along line."""
        return self.linear_mesh_without(np.zeros(self.mesh.n_nodes, dtype=bool))

    def linear_mesh_without(self, leaving: np.ndarray) -> Mesh:
        """Return `linear_mesh` with some nodes (n,) bool free: they move in all directions, off the surface too."""
        mesh = self.mesh.with_free(leaving)
        if not self._flat:
            return mesh
        flat = self._flat.renumbered(np.where(leaving, -1, np.arange(leaving.size)))
        if not flat:
            return mesh
        start, given = mesh.motion_start.copy(), mesh.linear_motion
        start[flat.nodes] = self.points[flat.nodes]
        motion = flat if given is None else given.merge(flat)
        return mesh.with_linear_motion(motion, start).with_fixed(mesh.fixed)

    @cached_property
    def _flat(self) -> LinearMotion:
        """Motion of the nodes on flat patches and straight curves of the boundary; none on a surface of its own."""
        if self._given is not None:
            return LinearMotion()
        return flat_motion(self.points, self.boundary, self.nodes, self.mesh.mean_edge_length)

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


def _partitioned(target: SkinSurface, feature_angle: FeatureAngle) -> PartitionedSurface:
    """Return the curves and patches of a surface; it keeps them, as a run and its report both need them."""
    known = target.derived.get(feature_angle)
    if known is None:
        boundary = classify(target.points, target.faces, feature_angle, edges=target.edges)
        known = target.derived[feature_angle] = PartitionedSurface(target.points, boundary, target.trees)
    return known


def interface_nodes(mesh: Mesh) -> np.ndarray:
    """Mark the nodes between materials that are kept or slide, (n,) bool."""
    materials, free = mesh.interfaces, mesh.node_rules.free
    if materials is None:
        return np.zeros(mesh.n_nodes, dtype=bool)
    return materials.interface_nodes if free is None else materials.interface_nodes & ~free


def fixed_on_surface(mesh: Mesh, outer: bool) -> np.ndarray:
    """Mark the nodes of the boundary and of interfaces that stay, (n,) bool.

    Parameters
    ----------
    mesh : Mesh
    outer : bool
        The boundary slides; interfaces that are kept slide with it.

    Returns
    -------
    (n,) bool
    """
    rules, between = mesh.node_rules, interface_nodes(mesh)
    boundary = mesh.topology.boundary
    stays = np.zeros(mesh.n_nodes, dtype=bool) if outer else boundary.copy()
    slides = rules.interfaces == "slide" or (outer and rules.interfaces == "keep")
    if mesh.target is not None or not slides:  # a target says nothing about interfaces
        stays |= between
    if rules.slides is not None:
        stays &= ~rules.slides
    return stays | mesh.immovable | flat_sides(mesh)  # whose nodes move in their planes, or not at all


def freed_by_rules(mesh: Mesh) -> np.ndarray:
    """Find the nodes of the surface that move otherwise than on it: freed ones, and those with a linear motion."""
    motion, rules = mesh.linear_motion, mesh.node_rules
    moves = np.zeros(mesh.n_nodes, dtype=bool) if motion is None else motion.marks(mesh.n_nodes)
    if rules.free is not None:
        moves |= rules.free & ~mesh.topology.boundary
    return np.flatnonzero(moves & ~mesh.fixed)


def moving_with_surface(mesh: Mesh, faces: np.ndarray) -> np.ndarray:
    """Mark the faces of `hexmend.boundary.skin_faces` that stay on the surface: freed nodes take theirs off interfaces.

    Parameters
    ----------
    mesh : Mesh
    faces : (k, 4) int32
        Those of the boundary first.

    Returns
    -------
    (k,) bool
    """
    free = mesh.node_rules.free
    stays = np.ones(len(faces), dtype=bool)
    first = len(mesh.topology.boundary_faces)
    if free is not None:
        stays[first:] = ~free[faces[first:]].any(axis=1)
    return stays


def freed_by_sliding(mesh: Mesh, locked: np.ndarray, feature_angle: FeatureAngle = FEATURE_ANGLE) -> np.ndarray:
    """Find locked hexes that may become valid once boundary nodes slide.

    A corner tetrahedron with sigma <= 0 stays inverted if its nodes are all fixed, all lie on one flat patch, or three
    of them lie on one straight curve: sliding cannot make sigma positive.

    Parameters
    ----------
    mesh : Mesh
    locked : (m,) bool
        Locked hexes; see `hexmend.quality.locked`.
    feature_angle : float or "auto"
        Dihedral angle beyond which an edge is a feature; see `boundary_of`.

    Returns
    -------
    (m,) bool
    """
    freed, where = locked.copy(), np.flatnonzero(locked)
    if where.size:
        freed[where] = ~_stays_inverted(SlidingBoundary(mesh, feature_angle), mesh.points, where)
    return freed


def _stays_inverted(sliding: SlidingBoundary, points: np.ndarray, hexes: np.ndarray) -> np.ndarray:
    """Find those of some hexes (k,) at points (n, 3) that have a corner which stays inverted wherever nodes slide."""
    mesh = sliding.mesh
    tetrahedra = corner_tetrahedra(mesh.elements[hexes])  # (k, 8, 4)
    blocked = mesh.fixed[tetrahedra].all(axis=2)
    for part in flat_parts(sliding.points, sliding.boundary, mesh.mean_edge_length):
        most = part.directions.shape[1] + 1  # nodes of a valid tetrahedron on a plane, and on a line
        blocked |= mask(part.nodes, mesh.n_nodes)[tetrahedra].sum(axis=2) > most
    inverted = ~(corner_determinants(points, mesh.elements, hexes) > 0)
    return (blocked & inverted).any(axis=1)
