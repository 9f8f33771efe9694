"""A surface that nodes slide on: each is put back on the closest point of its own curve or patch."""

from __future__ import annotations

import copy

import numpy as np

from hexmend.boundary.classification import Boundary, NodeClass
from hexmend.boundary.closest_point import ClosestPoints, ClosestPointTrees, triangulated
from hexmend.boundary.normals import curve_tangents, segment_tangents, triangle_normals, vertex_normals
from hexmend.errors import MeshError

#: Vertex normals whose mean is shorter say nothing: they stand against each other.
_OPPOSED = 1e-6


class Surface:
    """The surface that a boundary is: triangles in patches and segments in curves.

    A quad is four triangles around the mean of its corners. Between the vertices of a patch its normal is interpolated,
    as the tangent is between those of a curve; the places are those of the triangles and segments as they are.

    Parameters
    ----------
    points : (n, 3) float64
        Where the nodes of the boundary are.
    boundary : Boundary
        Of quads, or of triangles as a file of a surface holds them.

    Attributes
    ----------
    kind, part
        Those of the nodes that slide on it, as in `Boundary`: of its own boundary, or as `attached` says.
    trees : ClosestPointTrees
        Patch i is group i, curve i is group `n_patches` + i.

    Examples
    --------
    >>> from hexmend.gallery import make
    >>> from hexmend.boundary import boundary_of
    >>> cube = make("cube", size=27)
    >>> boundary = boundary_of(cube)
    >>> surface = Surface(cube.points, boundary)
    >>> sliding = np.flatnonzero(boundary.kind == NodeClass.PATCH)
    >>> found = surface.trees.closest(cube.points[sliding] + 0.1, surface.group_of(sliding))
    >>> sorted(set(np.abs(surface.directions(found)).sum(axis=1).tolist()))
    [1.0]
    """

    def __init__(self, points: np.ndarray, boundary: Boundary):
        self.kind, self.part = boundary.kind, boundary.part
        self.n_patches, self.n_curves = boundary.n_patches, boundary.n_curves
        vertices, triangles, face = triangulated(points, boundary.faces)
        patch, segments = boundary.patch_of_face[face], boundary.segments
        self.trees = ClosestPointTrees(
            vertices,
            np.concatenate([triangles, segments[:, [0, 1, 1]]]),
            np.concatenate([patch, self.n_patches + boundary.curve_of_segment]),
        )
        plain = triangle_normals(vertices, triangles), segment_tangents(points, segments)
        smooth = vertex_normals(vertices, triangles, patch), curve_tangents(points, boundary)[:, [0, 1, 1]]
        self._plain, self._smooth = (np.concatenate(both)[self.trees.order] for both in (plain, smooth))
        self._group = np.concatenate([patch, self.n_patches + boundary.curve_of_segment])[self.trees.order]

    def group_of(self, nodes: np.ndarray) -> np.ndarray:
        """The group of `trees` that each of some nodes slides on, (k,) int32.

        Raises
        ------
        MeshError
            For a node that slides on nothing: one of the inside, or a corner.
        """
        kind = self.kind[nodes]
        stays = np.flatnonzero(kind < NodeClass.CURVE)
        if len(stays):
            node, name = int(np.asarray(nodes)[stays[0]]), NodeClass(kind[stays[0]]).name
            raise MeshError(f"node {node} (counted from 0) is of kind {name}: expected CURVE or PATCH, which slide")
        return self.part[nodes] + np.where(kind == NodeClass.CURVE, np.int32(self.n_patches), np.int32(0))

    def directions(self, found: ClosestPoints, smooth: bool = True) -> np.ndarray:
        """Normals of patches and tangents of curves at places that `trees` found, (k, 3) float64.

        They are of length 1, normals to the outside, tangents of either sense; 0 on a triangle or segment that has no
        direction.

        Parameters
        ----------
        found : ClosestPoints
        smooth : bool
            Interpolate between vertices; else they are those of the triangle or segment.
        """
        plain = self._plain[found.pieces]
        if not smooth:
            return plain
        mean = np.einsum("ki,kij->kj", found.weights, self._smooth[found.pieces])
        size = np.linalg.norm(mean, axis=1, keepdims=True)
        return np.where(size > _OPPOSED, mean / np.maximum(size, _OPPOSED), plain)

    def attached(self, points: np.ndarray, boundary: Boundary, reach: float = np.inf) -> Surface:
        """This surface for the nodes of another boundary: each slides on the nearest patch or curve of this one.

        Curve nodes are given to curves that are within a quarter of the reach, else to patches. Corners stay what they
        are, and what is out of reach of all patches is a corner.

        Parameters
        ----------
        points : (n, 3) float64
        boundary : Boundary
        reach : float
            In the unit of the points.
        """
        kind, part = boundary.kind.copy(), np.full(len(boundary.kind), -1, dtype=np.int32)
        curve = self._group >= self.n_patches
        nearest = ClosestPointTrees(self.trees.points, self.trees.pieces, curve.astype(np.int32))
        if not self.n_curves:
            kind[kind == NodeClass.CURVE] = NodeClass.PATCH
        for of, other, most in (
            (NodeClass.CURVE, NodeClass.PATCH, reach / 4),
            (NodeClass.PATCH, NodeClass.CORNER, reach),
        ):
            nodes = np.flatnonzero(kind == of)
            if not nodes.size:
                continue
            found = nearest.closest(points[nodes], np.full(len(nodes), int(of == NodeClass.CURVE)))
            near = np.linalg.norm(found.places - points[nodes], axis=1) <= most
            kind[nodes[~near]] = other
            group = self._group[nearest.order[found.pieces[near]]]
            part[nodes[near]] = group - (self.n_patches if of == NodeClass.CURVE else 0)
        other = copy.copy(self)
        other.kind, other.part = kind, part
        return other
