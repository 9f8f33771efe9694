"""Surface on which nodes slide: curves and patches with trees for closest points, normals and tangents."""

from __future__ import annotations

import copy
from functools import cached_property

import numpy as np

from hexmend.arrays import mask
from hexmend.boundary.classification import Boundary, NodeClass
from hexmend.boundary.closest_point import ClosestPoints, ClosestPointTrees, triangulate
from hexmend.boundary.normals import curve_tangents, segment_tangents, triangle_normals, vertex_normals
from hexmend.errors import MeshError

#: Interpolated normals shorter than this have no direction: the vertex normals are opposed.
_MIN_MEAN_NORMAL = 1e-6


class PartitionedSurface:
    """Surface of a boundary: triangles in patches and segments in curves.

    Quads are divided into four triangles around their centres. Normals of patches and tangents of curves are
    interpolated between vertices; closest points are those of the flat triangles and straight segments.

    Parameters
    ----------
    points : (n, 3) float64
        Node positions of the boundary.
    boundary : Boundary
        Boundary of quads, or of triangles such as a surface file has.

    Attributes
    ----------
    node_class, part
        Class and part, as in `Boundary`, of the nodes that slide on the surface; see `attached`.
    trees : ClosestPointTrees
        Patch i is group i, curve i is group `n_patches` + i; `with_union` adds a last group.

    Examples
    --------
    >>> from hexmend.gallery import make
    >>> from hexmend.boundary import boundary_of
    >>> cube = make("cube", size=27)
    >>> boundary = boundary_of(cube)
    >>> surface = PartitionedSurface(cube.points, boundary)
    >>> sliding = np.flatnonzero(boundary.node_class == NodeClass.PATCH)
    >>> found = surface.trees.closest(cube.points[sliding] + 0.1, surface.group_of(sliding))
    >>> sorted(set(np.abs(surface.directions(found)).sum(axis=1).tolist()))
    [1.0]
    """

    def __init__(self, points: np.ndarray, boundary: Boundary):
        self.node_class, self.component = boundary.node_class, boundary.component
        self.n_patches, self.n_curves = boundary.n_patches, boundary.n_curves
        vertices, triangles, face = triangulate(points, boundary.faces)
        patch, segments = boundary.patch_of_face[face], boundary.segments
        pieces = np.concatenate([triangles, segments[:, [0, 1, 1]]])
        group = np.concatenate([patch, self.n_patches + boundary.curve_of_segment])
        self.trees = ClosestPointTrees(vertices, pieces, group)
        flat = triangle_normals(vertices, triangles), segment_tangents(points, segments)
        smooth = vertex_normals(vertices, triangles, patch), curve_tangents(points, boundary)[:, [0, 1, 1]]
        self._flat, self._smooth = (np.concatenate(both)[self.trees.order] for both in (flat, smooth))
        self._group = group[self.trees.order]

    @cached_property
    def _patches_and_curves(self) -> ClosestPointTrees:
        """Trees of all patches, group 0, and of all curves, group 1."""
        curve = self._group >= self.n_patches
        return ClosestPointTrees(self.trees.points, self.trees.pieces, curve.astype(np.int32))

    def with_union(self, patches: np.ndarray) -> PartitionedSurface:
        """Return this surface with one more group of `trees`, the last: that of some patches, (n_patches,) bool."""
        other, trees, last = copy.copy(self), self.trees, self.n_patches + self.n_curves
        vars(other).pop("_patches_and_curves", None)
        again = np.flatnonzero(mask(np.flatnonzero(patches), last)[self._group])
        group = np.concatenate([self._group, np.full(again.size, last, dtype=self._group.dtype)])
        other.trees = ClosestPointTrees(trees.points, np.concatenate([trees.pieces, trees.pieces[again]]), group)
        own = np.concatenate([np.arange(len(self._group)), again])[other.trees.order]
        other._flat, other._smooth, other._group = self._flat[own], self._smooth[own], group[other.trees.order]
        return other

    def group_of(self, nodes: np.ndarray) -> np.ndarray:
        """Return the group of `trees` on which each of some nodes slides.

        Parameters
        ----------
        nodes : (k,) int

        Returns
        -------
        (k,) int32

        Raises
        ------
        MeshError
            For a node that does not slide: an interior node or a corner.
        """
        node_class = self.node_class[nodes]
        stays = np.flatnonzero(node_class < NodeClass.CURVE)
        if len(stays):
            node, name = int(np.asarray(nodes)[stays[0]]), NodeClass(node_class[stays[0]]).name
            raise MeshError(f"node {node} (counted from 0) is of kind {name}: expected CURVE or PATCH, which slide")
        return self.component[nodes] + np.where(node_class == NodeClass.CURVE, np.int32(self.n_patches), np.int32(0))

    def on_nodes(self, nodes: np.ndarray) -> PartitionedSurface:
        """Return this surface for nodes that are numbered by their places among some (k,) int."""
        other = copy.copy(self)
        vars(other).pop("_patches_and_curves", None)
        other.node_class, other.component = self.node_class[nodes], self.component[nodes]
        return other

    def directions(self, found: ClosestPoints, smooth: bool = True) -> np.ndarray:
        """Compute normals of patches and tangents of curves at closest points.

        Parameters
        ----------
        found : ClosestPoints
            Points found by `trees`.
        smooth : bool
            Interpolate between vertices; otherwise directions are constant on each triangle and segment.

        Returns
        -------
        (k, 3) float64
            Unit vectors: outward normals, tangents in either direction; 0 on a degenerate triangle or segment.
        """
        flat = self._flat[found.pieces]
        if not smooth:
            return flat
        mean = np.einsum("ki,kij->kj", found.weights, self._smooth[found.pieces])
        size = np.linalg.norm(mean, axis=1, keepdims=True)
        return np.where(size > _MIN_MEAN_NORMAL, mean / np.maximum(size, _MIN_MEAN_NORMAL), flat)

    def attached(self, points: np.ndarray, boundary: Boundary, reach: float = np.inf) -> PartitionedSurface:
        """Return this surface for the nodes of another boundary, which slide on its nearest curves and patches.

        Curve nodes without a curve within a quarter of `reach` slide on patches; nodes without a patch within `reach`
        become corners. Corners stay corners.

        Parameters
        ----------
        points : (n, 3) float64
            Node positions of the other boundary.
        boundary : Boundary
            The other boundary.
        reach : float
            Largest distance, in the unit of the points.

        Returns
        -------
        Surface
        """
        node_class, part = boundary.node_class.copy(), np.full(len(boundary.node_class), -1, dtype=np.int32)
        nearest = self._patches_and_curves
        if not self.n_curves:
            node_class[node_class == NodeClass.CURVE] = NodeClass.PATCH
        steps = (NodeClass.CURVE, NodeClass.PATCH, reach / 4), (NodeClass.PATCH, NodeClass.CORNER, reach)
        for of, other, most in steps:
            nodes = np.flatnonzero(node_class == of)
            if not nodes.size:
                continue
            found = nearest.closest(points[nodes], np.full(len(nodes), int(of == NodeClass.CURVE)))
            near = np.linalg.norm(found.points - points[nodes], axis=1) <= most
            node_class[nodes[~near]] = other
            group = self._group[nearest.order[found.pieces[near]]]
            part[nodes[near]] = group - (self.n_patches if of == NodeClass.CURVE else 0)
        other = copy.copy(self)
        other.node_class, other.component = node_class, part
        return other
