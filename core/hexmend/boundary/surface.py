"""Surface on which nodes slide: curves and patches with trees for closest points, normals and tangents."""

from __future__ import annotations

import copy
from functools import cached_property

import numpy as np

from hexmend.boundary.classification import Boundary, NodeClass
from hexmend.boundary.closest_point import ClosestPoints, ClosestPointTrees, triangulate
from hexmend.boundary.normals import PieceDirections, directions_of_means
from hexmend.errors import MeshError
from hexmend.kernels import sliding_surface

#: A point is inside a triangle or segment if all its weights there exceed this; its tangent is then that of the
#: triangle or segment, else one interpolated between vertices. Methods take more steps if only points on the rim count
#: as outside.
_INTERIOR_WEIGHT = 1e-3


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
    whole : ClosestPointTrees, optional
        Trees of all faces as one group, as `triangulate` divides them, where they are built already.

    Attributes
    ----------
    node_class, part
        Class and part, as in `Boundary`, of the nodes that slide on the surface; see `attached`.
    trees : ClosestPointTrees
        Patch i is group i, curve i is group `n_patches` + i.

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

    def __init__(self, points: np.ndarray, boundary: Boundary, whole: ClosestPointTrees | None = None):
        self.node_class, self.component = boundary.node_class, boundary.component
        self.n_patches, self.n_curves = boundary.n_patches, boundary.n_curves
        vertices, triangles, face = triangulate(points, boundary.faces)
        patch, segments = boundary.patch_of_face[face], boundary.segments
        pieces = np.concatenate([triangles, segments[:, [0, 1, 1]]])
        self._group_of_given = np.concatenate([patch, self.n_patches + boundary.curve_of_segment])
        # One patch without a curve is the whole surface.
        is_whole = whole is not None and self.n_patches == 1 and not len(segments)
        self.trees = whole if is_whole else ClosestPointTrees(vertices, pieces, self._group_of_given)
        self._given = self.trees.order  # number of each piece among the triangles and segments as given
        self._directions = PieceDirections(vertices, triangles, patch, points, boundary)
        self._whole = whole

    @property
    def _group(self) -> np.ndarray:
        """Curve or patch of each piece, as a group of `trees`, (k,) int."""
        return self._group_of_given[self._given]

    @cached_property
    def _all_patches(self) -> tuple[ClosestPointTrees, np.ndarray]:
        """Trees of all patches as one group, and the group in `trees` of each of their pieces."""
        triangles = self._directions.triangles
        whole = self._whole or ClosestPointTrees(self.trees.points, triangles, np.zeros(len(triangles), np.int64))
        return whole, self._group_of_given[whole.order]

    @cached_property
    def _all_curves(self) -> tuple[ClosestPointTrees, np.ndarray]:
        """Trees of all curves as one group, and the group in `trees` of each of their pieces."""
        curves = np.flatnonzero(self._group >= self.n_patches)
        trees = ClosestPointTrees(self.trees.points, self.trees.pieces[curves], np.zeros(curves.size, np.int64))
        return trees, self._group[curves[trees.order]]

    def trees_with_union(self, unit: float) -> ClosestPointTrees:
        """Return trees of the patches, the curves, and as one more group all patches, for points in another unit."""
        own = self._group
        again = np.flatnonzero(own < self.n_patches)
        group = np.concatenate([own, np.full(again.size, self.n_patches + self.n_curves, dtype=own.dtype)])
        pieces = np.concatenate([self.trees.pieces, self.trees.pieces[again]])
        return ClosestPointTrees(self.trees.points / unit, pieces, group)

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
        given = self._given[found.pieces]
        flat = self._directions.flat[given]
        if not smooth:
            return flat
        mean = np.einsum("ki,kij->kj", found.weights, self._directions.smooth[given])
        return directions_of_means(mean, flat)

    def tangent_bases(self, found: ClosestPoints, of_curve: np.ndarray) -> np.ndarray:
        """Compute orthonormal directions at closest points in which nodes may move.

        Parameters
        ----------
        found : ClosestPoints
            Points found by `trees`.
        of_curve : (k,) bool
            True for a point on a curve, which has one direction; one on a patch has two.

        Returns
        -------
        (k, 3, 3) float64
            Directions in columns; the others are 0.
        """
        bases, directions = np.empty((len(of_curve), 9)), self._directions
        corners = directions.smooth.reshape(-1, 9)
        where = found.pieces, found.weights, of_curve, _INTERIOR_WEIGHT
        sliding_surface.tangent_bases(self._given, directions.flat, corners, *where, bases)
        return bases.reshape(-1, 3, 3)

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
        if not self.n_curves:
            node_class[node_class == NodeClass.CURVE] = NodeClass.PATCH
        steps = (NodeClass.CURVE, NodeClass.PATCH, reach / 4), (NodeClass.PATCH, NodeClass.CORNER, reach)
        for of, other, most in steps:
            nodes = np.flatnonzero(node_class == of)
            if not nodes.size:
                continue
            trees, group = self._all_curves if of == NodeClass.CURVE else self._all_patches
            found = trees.closest(points[nodes], np.zeros(nodes.size, np.int64))
            near = np.linalg.norm(found.points - points[nodes], axis=1) <= most
            node_class[nodes[~near]] = other
            part[nodes[near]] = group[found.pieces[near]] - (self.n_patches if of == NodeClass.CURVE else 0)
        other = copy.copy(self)
        other.node_class, other.component = node_class, part
        return other
