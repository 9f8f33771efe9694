"""The nodes of a mesh that slide on its boundary: which they are, where they may go, and how they are put back."""

from __future__ import annotations

from collections.abc import Callable
from functools import cached_property

import numpy as np

from hexmend.boundary.band import NOBODY, Band
from hexmend.boundary.classification import NodeClass, classify
from hexmend.boundary.closest_point import FARTHEST, ClosestPoints, triangulated
from hexmend.boundary.comparison import NEAR
from hexmend.boundary.corner_detection import sliding_boundary
from hexmend.boundary.features import DEGREES, given_corners
from hexmend.boundary.normals import unit, vertex_normals
from hexmend.boundary.surface import Surface
from hexmend.errors import MeshError
from hexmend.kernels import sliding_surface as kernels
from hexmend.mesh.mesh import Mesh
from hexmend.mesh.topology import CSR
from hexmend.mesh.validation import as_points, points_like

#: Least weight of the corners of a triangle, or segment, at a place that counts as inside of it: there its own plane
#: is the tangent, at its edges the mean of those around.
_INNER = 1e-3


class SlidingBoundary(Band):
    """A mesh whose boundary nodes slide: those of curves along them, those of patches on them; corners stay.

    Parameters
    ----------
    mesh : Mesh
        Its `target`, or else its `surface`, is what nodes of its boundary slide on.
    degrees : float
        Dihedral angle beyond which an edge is a feature; see `boundary_of`.
    room : float
        How far, in the mesh's unit, the middles of the boundary's edges and faces may leave the surface: nodes are on
        it, but what lies between them cuts off its bends.

    Attributes
    ----------
    boundary : Boundary
    surface : Surface
    kind : (n,) uint8
        What each node is to the surface that it slides on, one of `NodeClass`.
    mesh : Mesh
        The same, of whose nodes only corners, pinned ones and those that no hex uses are fixed; on a target those that
        slide have been put on it.
    nodes : (k,) int64
        Those that slide, ascending.
    """

    def __init__(self, mesh: Mesh, degrees: float = DEGREES, room: float = np.inf):
        self.boundary = sliding_boundary(mesh, degrees)
        target = mesh.target
        if target is None:
            self.surface = Surface(mesh.surface_points, self.boundary)
        else:
            whole = Surface(target.points, classify(target.points, target.faces, degrees))
            self.surface = whole.attached(mesh.surface_points, self.boundary, NEAR * mesh.mean_edge_length)
        self.kind = self.surface.kind
        slides = self.kind >= NodeClass.CURVE
        self.nodes = np.flatnonzero(slides)
        self.yields = self.boundary.kind == NodeClass.CORNER
        self.yields[given_corners(mesh)] = False
        self._group = self.surface.group_of(self.nodes)
        self._number = np.full(mesh.n_nodes, -1, dtype=np.int64)
        self._number[self.nodes] = np.arange(self.nodes.size)
        start = mesh.surface_points
        if target is not None:
            start, mesh = self._put_on(start), mesh.with_points(self._put_on(mesh.points))
        super().__init__(mesh.surface_points, self.boundary.faces, start, target, room)
        self.mesh = mesh.with_fixed(mesh.fixed & ~slides)

    def slides(self, nodes: np.ndarray) -> np.ndarray:
        """Which of some nodes (k,) slide, (k,) bool."""
        return self._number[nodes] >= 0

    def put_back(self, x: np.ndarray, nodes: np.ndarray | None = None) -> np.ndarray:
        """The closest places of sliding nodes on their own curves and patches, (k, 3).

        Parameters
        ----------
        x : (k, 3) float64
            Where they have been moved to, in the mesh's unit of length.
        nodes : (k,) int, optional
            Which they are; all that slide, if None.
        """
        return self._closest(x, nodes).places

    def bases(self, x: np.ndarray, nodes: np.ndarray | None = None) -> np.ndarray:
        """Directions in which sliding nodes may move, the columns of (k, 3, 3): 0 beyond the node's degrees of freedom.

        Parameters
        ----------
        x : (k, 3) float64
            Where they are, on the surface.
        nodes : (k,) int, optional
            Which they are; all that slide, if None.
        """
        of, found = self.nodes if nodes is None else nodes, self._closest(x, nodes)
        weights = found.weights.copy()
        weights[self.kind[of] == NodeClass.CURVE, 2] = 1.0  # a segment has two
        inner = weights.min(axis=1, keepdims=True) > _INNER
        along = np.where(inner, self.surface.directions(found, smooth=False), self.surface.directions(found))
        bases = np.zeros((len(of), 3, 3))
        curve = self.kind[of] == NodeClass.CURVE
        bases[curve, :, 0] = along[curve]
        bases[~curve, :, :2] = _across(along[~curve])
        return bases

    def tangents(self, points: np.ndarray) -> np.ndarray:
        """The directions of `bases` for all that slide, nodes being at points (n, 3): one after the other, (k, 6)."""
        return np.ascontiguousarray(self.bases(points[self.nodes])[:, :, :2].transpose(0, 2, 1)).reshape(-1, 6)

    @cached_property
    def sliding_surface(self) -> kernels.SlidingSurface:
        """The curves, patches and boundary quads as the kernels of methods take them."""
        trees, faces = self.surface.trees, self.boundary.faces
        slots = self._number.astype(np.int32)
        at = slots[faces.ravel()]
        order = np.argsort(at, kind="stable")
        quads_at = order[np.searchsorted(at[order], 0) :].astype(np.int32)
        start = np.searchsorted(at[quads_at], np.arange(self.nodes.size + 1)).astype(np.int32)
        quads = kernels.BoundaryQuads(start, quads_at, faces, self.outward)
        return kernels.SlidingSurface(slots, trees.roots[self._group], trees.box_trees, quads)

    @cached_property
    def outward(self) -> np.ndarray:
        """The normal of the boundary at each of its faces as it was, that of the faces around it too, (k, 3)."""
        faces = self.boundary.faces
        vertices, triangles, face = triangulated(self.points, faces)
        normals = vertex_normals(vertices, triangles, self.boundary.patch_of_face[face])
        return unit(normals[:, :2].mean(axis=1).reshape(len(faces), 4, 3).mean(axis=1))

    @cached_property
    def rings(self) -> CSR:
        """Edge neighbours of each node, of those that slide only the ones on their own curve or patch, and its ends."""
        kind, whole = self.kind, self.mesh.topology.rings
        node = np.repeat(np.arange(self.mesh.n_nodes), np.diff(whole.start))
        ways = [np.stack([node, whole.items], axis=1)[self._number[node] < 0]]
        for of, along in (NodeClass.CURVE, self.boundary.segments), (NodeClass.PATCH, self.skin.edges.nodes):
            both = np.concatenate([along, along[:, ::-1]])
            ways.append(both[kind[both[:, 0]] == of])
        ways = np.concatenate(ways)
        ways = ways[np.lexsort((ways[:, 1], ways[:, 0]))]
        start = np.searchsorted(ways[:, 0], np.arange(self.mesh.n_nodes + 1))
        return CSR(start.astype(np.int32), np.ascontiguousarray(ways[:, 1], dtype=np.int32))

    def turned(self, before: np.ndarray, after: np.ndarray) -> np.ndarray:
        """Faces of the boundary that are turned over after a step and were not before, (k,) int.

        A quad is turned over if its normal is against that of the boundary there as it was, or it is flat.

        Parameters
        ----------
        before, after : (n, 3) float64
        """
        before, after = (points_like(points, self.mesh.points.shape) for points in (before, after))
        found = np.empty(len(self.boundary.faces), dtype=bool)
        kernels.newly_inverted(before, after, self.boundary.faces, self.outward, found)
        return np.flatnonzero(found)

    def unturned(self, before: np.ndarray, after: np.ndarray, may: np.ndarray | None = None) -> np.ndarray:
        """The points after a step, of which those nodes stay whose quads it would turn over, until none is.

        Parameters
        ----------
        before, after : (n, 3) float64
        may : (n,) bool, optional
            Nodes whose quads may be turned over.
        """
        while True:
            quads = self.boundary.faces[self.turned(before, after)]
            if may is not None:
                quads = quads[~may[quads].any(axis=1)]
            if not quads.size:
                return after
            nodes = np.unique(quads)
            after = after.copy()
            after[nodes] = before[nodes]

    def refused(self, before: np.ndarray, after: np.ndarray) -> np.ndarray:
        """Nodes that a step must not take where it does, (k,) int: it would turn a quad over, or leave the room."""
        turned = self.boundary.faces[self.turned(before, after)].ravel()
        return np.union1d(turned, self.beyond(after))

    def held(
        self, before: np.ndarray, after: np.ndarray, harmed: Callable[[np.ndarray], np.ndarray] = lambda after: NOBODY
    ) -> np.ndarray:
        """The points after a step, of which those nodes stay that are refused to go, until none is.

        Parameters
        ----------
        before, after : (n, 3) float64
        harmed : callable
            From points (n, 3) to more nodes, (k,) int, that are refused to be there.
        """
        while True:
            nodes = np.union1d(self.refused(before, after), harmed(after))
            nodes = nodes[(after[nodes] != before[nodes]).any(axis=1)]
            if not nodes.size:
                return after
            after = after.copy()
            after[nodes] = before[nodes]

    def _put_on(self, points: np.ndarray) -> np.ndarray:
        points = points.copy()
        points[self.nodes] = self.put_back(points[self.nodes])
        return points

    def _closest(self, x: np.ndarray, nodes: np.ndarray | None) -> ClosestPoints:
        x = as_points(x, "places of sliding nodes")
        try:
            return self.surface.trees.closest(x, self._group if nodes is None else self._group[self._number[nodes]])
        except MeshError:
            far = np.flatnonzero(~(np.abs(x) < FARTHEST).all(axis=1))
            if not far.size:
                raise
            row = far[0]
            node = int((self.nodes if nodes is None else nodes)[row])
            raise MeshError(
                f"node {node} cannot slide: no place of the surface is closest to {x[row].tolist()}; expected finite "
                f"coordinates below {FARTHEST:g}. Correct its place, or pin it."
            ) from None


def _across(normals: np.ndarray) -> np.ndarray:
    """Two unit vectors at right angles to each other and to each normal, the columns of (k, 3, 2); 0 where it is 0."""
    least = np.abs(normals).argmin(axis=1)
    one = np.cross(normals, np.eye(3)[least])
    one /= np.maximum(np.linalg.norm(one, axis=1, keepdims=True), np.finfo(float).tiny)
    return np.stack([one, np.cross(normals, one)], axis=-1)
