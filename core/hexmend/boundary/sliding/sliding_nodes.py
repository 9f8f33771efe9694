"""Nodes that slide on curves and patches: projection, tangents, and rejection of moves that harm the boundary."""

from __future__ import annotations

import copy
from collections.abc import Callable
from functools import cached_property
from typing import Self

import numpy as np

from hexmend.arrays import differing_rows, index_of, mask
from hexmend.boundary.band import NO_NODES, Band
from hexmend.boundary.classification import Boundary, NodeClass
from hexmend.boundary.closest_point import ClosestPointCache, ClosestPoints, triangulate
from hexmend.boundary.normals import unit_vectors, vertex_normals
from hexmend.boundary.skin_surface import SkinSurface
from hexmend.boundary.surface import PartitionedSurface
from hexmend.errors import MeshError
from hexmend.kernels import sliding_surface as kernels
from hexmend.mesh.size_limits import MAX_COORDINATE
from hexmend.mesh.validation import as_points, points_like


class SlidingNodes(Band):
    """Nodes of a boundary that slide on a surface: those of curves along curves, those of patches on patches.

    Parameters
    ----------
    boundary : Boundary
        Its faces are those whose flips are rejected, and which stay in the band.
    surface : PartitionedSurface
    nodes : (k,) int64
        Sliding nodes, ascending.
    points : (n, 3) float64
        Original node positions of the boundary.
    target : SkinSurface or None
        The surface; None if it is the original boundary.
    max_deviation : float
        Largest distance of the boundary's edge and face midpoints from the surface, in the mesh's unit.
    inner : (f,) bool, optional
        Faces of interfaces; see `Band`.

    Attributes
    ----------
    node_class : (n,) uint8
        `NodeClass` of each node with respect to the surface.
    """

    def __init__(
        self,
        boundary: Boundary,
        surface: PartitionedSurface,
        nodes: np.ndarray,
        points: np.ndarray,
        target: SkinSurface | None = None,
        max_deviation: float = np.inf,
        inner: np.ndarray | None = None,
    ):
        self.boundary, self.surface, self.nodes, self.node_class = boundary, surface, nodes, surface.node_class
        self._group = surface.group_of(nodes)
        self._number = index_of(nodes, len(points))
        self._cache = ClosestPointCache(surface.trees, self._group)
        start = points if target is None else self.projected(points)
        super().__init__(points, boundary.faces, start, target, max_deviation, inner)
        self._inner_of_boundary = inner  # of those of its faces that are left, see `SlidingBoundary.without_nodes`

    def on_boundary(self) -> tuple[SlidingNodes, np.ndarray]:
        """Return the sliding nodes of the boundary alone, and the numbers (b,) int64 of all its nodes, ascending."""
        has = mask(self.boundary.faces, len(self.points))
        has[self.boundary.segments] = True
        has[self.nodes] = True
        at = np.flatnonzero(has)
        number = index_of(at, has.size)
        boundary, surface = self.boundary.on_nodes(at), self.surface.on_nodes(at)
        nodes, points = number[self.nodes].astype(np.int64), self.points[at]
        options = self._given, self.max_deviation, self._inner_of_boundary
        return SlidingNodes(boundary, surface, nodes, points, *options), at

    def with_band(self, max_deviation: float) -> Self:
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
        return self.surface.tangent_bases(found, self.node_class[of] == NodeClass.CURVE)

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
        faces = self.boundary.faces
        at = self._number[faces.ravel()]
        order = np.argsort(at, kind="stable")
        quads_at = order[np.searchsorted(at[order], 0) :].astype(np.int32)
        start = np.searchsorted(at[quads_at], np.arange(self.nodes.size + 1)).astype(np.int32)
        quads = kernels.BoundaryQuads(start, quads_at, faces, self.outward)
        return kernels.SlidingSurface(self._number, self._cache.kernel, quads)

    @cached_property
    def outward(self) -> np.ndarray:
        """Outward normals of the original boundary faces, averaged over the faces around each, (k, 3)."""
        faces = self.boundary.faces
        vertices, triangles, face = triangulate(self.points, faces)
        normals = vertex_normals(vertices, triangles, self.boundary.patch_of_face[face])
        return unit_vectors(normals[:, :2].mean(axis=1).reshape(len(faces), 4, 3).mean(axis=1))

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
        before, after = (points_like(points, self.points.shape) for points in (before, after))
        found = np.empty(len(self.boundary.faces), dtype=bool)
        kernels.flipped_quads(before, after, self.boundary.faces, self.outward, found)
        return np.flatnonzero(found)

    def rejected_nodes(self, before: np.ndarray, after: np.ndarray, changed: np.ndarray | None = None) -> np.ndarray:
        """Find nodes whose moves flip a quad or take the boundary out of its band, (k,) int.

        Where none of the nodes outside the band has moved, all that slide are named.

        Parameters
        ----------
        before, after : (n, 3) float64
            Node positions.
        changed : (n,) bool, optional
            Nodes at which the band is examined; all by default.
        """
        flipped, outside = self.flipped_quads(before, after), self.nodes_outside_band(after, changed)
        if outside.size and not differing_rows(before[outside], after[outside]).any():
            # Other faces were closer to the surface before, and have moved away.
            outside = outside if self.nodes_outside_band(before).size else self.nodes
        if not flipped.size:
            return outside
        found = mask(self.boundary.faces[flipped], len(after))
        found[outside] = True
        return np.flatnonzero(found)

    def rejected(self, before: np.ndarray, after: np.ndarray, changed: np.ndarray | None = None) -> np.ndarray | None:
        """Mark those of `rejected_nodes` that move, (n,) bool; None if there are none."""
        nodes = self.rejected_nodes(before, after, changed)
        nodes = nodes[differing_rows(before[nodes], after[nodes])]
        return mask(nodes, len(after)) if nodes.size else None

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
        try:
            return self._cache.closest(x, None if nodes is None else self._number[nodes])
        except MeshError:
            far = np.flatnonzero(~(np.abs(x) < MAX_COORDINATE).all(axis=1))
            if not far.size:
                raise
            row = far[0]
            node = int((self.nodes if nodes is None else nodes)[row])
            raise MeshError(
                f"node {node} cannot slide: no place of the surface is closest to {x[row].tolist()}; expected finite "
                f"coordinates below {MAX_COORDINATE:g}. Correct its place, or pin it."
            ) from None


def _undone(before: np.ndarray, after: np.ndarray, rejected: Callable[[np.ndarray], np.ndarray]) -> np.ndarray:
    """Move rejected nodes back to their positions before a step, until no moved node is rejected."""
    while True:
        nodes = rejected(after)
        nodes = nodes[differing_rows(after[nodes], before[nodes])]
        if not nodes.size:
            return after
        after = after.copy()
        after[nodes] = before[nodes]
