"""A surface that nodes slide on: each is put back on the closest point of its own curve or patch."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from hexmend.errors import MeshError
from hexmend.kernels import closest
from hexmend.surface.boundary import Boundary, Kind


@dataclass(frozen=True, eq=False)
class Closest:
    """Closest points of a surface.

    Parameters
    ----------
    places : (k, 3) float64
    pieces : (k,) int32
        The triangle or segment that each lies on; as `near` of the next search it makes that faster.
    weights : (k, 3) float64
        Of the piece's corners at each place.
    """

    places: np.ndarray
    pieces: np.ndarray
    weights: np.ndarray


class Surface:
    """The surface that a boundary is: triangles in patches and segments in curves.

    A quad is four triangles around the mean of its corners, so that no diagonal is preferred. Between the vertices of a
    patch its normal is interpolated, as the tangent is between those of a curve; the places are those of the triangles
    and segments as they are.

    Parameters
    ----------
    points : (n, 3) float64
        Where the nodes of the boundary are.
    boundary : Boundary
        Of quads, or of triangles as a file of a surface holds them.

    Attributes
    ----------
    kind, part
        Those of the nodes that slide on it, as in `Boundary`: of its own boundary, or of those of `attached`.

    Examples
    --------
    >>> from hexmend.gallery import make
    >>> from hexmend.surface import boundary_of
    >>> cube = make("cube", size=27)
    >>> boundary = boundary_of(cube)
    >>> surface = Surface(cube.points, boundary)
    >>> on_patch = np.flatnonzero(boundary.kind == Kind.PATCH).astype(np.int32)
    >>> places, normals = surface.project(cube.points[on_patch] + 0.1, on_patch)
    >>> bool(np.isclose(np.abs(normals).max(axis=1), 1).all())
    True
    """

    def __init__(self, points: np.ndarray, boundary: Boundary):
        self.kind, self.part = boundary.kind, boundary.part
        self.n_patches, self.n_curves = boundary.n_patches, boundary.n_curves
        triangles, face, vertices = triangulated(points, boundary.faces)
        patch = boundary.patch_of_face[face]
        segments = boundary.segments[:, [0, 1, 1]]
        piece = np.concatenate([triangles, segments]).astype(np.int32)
        tree = np.concatenate([patch, self.n_patches + boundary.curve_of_segment])
        order = np.argsort(tree, kind="stable")
        start = np.searchsorted(tree[order], np.arange(self.n_patches + self.n_curves + 1)).astype(np.int32)
        piece = np.ascontiguousarray(piece[order])
        within, self._boxes, self._links, self._roots = closest.trees(vertices, piece, start)
        order = order[within]
        self._vertices, self._pieces = vertices, np.ascontiguousarray(piece[within])
        self._plain = np.concatenate([triangle_normals(vertices, triangles), directions_of(vertices, segments)])[order]
        smooth = vertex_normals(vertices, triangles, patch), vertex_tangents(points, boundary)
        self._smooth = np.concatenate(smooth)[order]

    def closest(self, x: np.ndarray, tree: np.ndarray, near: np.ndarray | None = None) -> Closest:
        """The closest points on chosen patches (numbered from 0) or curves (from `n_patches`).

        Parameters
        ----------
        x : (k, 3) float64
        tree : (k,) int
        near : (k,) int32, optional
            Pieces to begin with, -1 for none: those of the last search, while a tree stays the same.
        """
        x = np.ascontiguousarray(x, dtype=np.float64)
        piece = np.full(len(x), -1, dtype=np.int32) if near is None else np.array(near, dtype=np.int32)
        places, weights = np.empty_like(x), np.empty_like(x)
        closest.closest(
            self._vertices, self._pieces, self._boxes, self._links, x, self._roots[tree], piece, places, weights
        )
        return Closest(places, piece, weights)

    def tree_of(self, nodes: np.ndarray) -> np.ndarray:
        """The patch or curve, as `closest` numbers them, that each of some nodes slides on, (k,) int32.

        Raises
        ------
        MeshError
            For a node that slides on nothing: one of the inside, or a corner.
        """
        kind = self.kind[nodes]
        stays = kind < Kind.CURVE
        if stays.any():
            node = int(np.asarray(nodes)[stays][0])
            raise MeshError(
                f"node {node} (counted from 0) is no node of a curve or patch: expected such as slide on the surface"
            )
        return self.part[nodes] + np.where(kind == Kind.CURVE, np.int32(self.n_patches), np.int32(0))

    def project(self, x: np.ndarray, nodes: np.ndarray, smooth: bool = True) -> tuple[np.ndarray, np.ndarray]:
        """Put nodes back on their own curves and patches.

        Parameters
        ----------
        x : (k, 3) float64
            Where they are now.
        nodes : (k,) int
            Which they are: of kind `Kind.CURVE` or `Kind.PATCH`.
        smooth : bool
            Interpolate directions between vertices; else they are those of the triangle or segment.

        Returns
        -------
        places : (k, 3) float64
            The closest points.
        directions : (k, 3) float64
            There, of length 1: a patch's normal, to the outside; a curve's tangent, of either sense. 0 on a piece that
            has none.
        """
        found = self.closest(x, self.tree_of(nodes))
        return found.places, self.directions(found, smooth)

    def directions(self, found: Closest, smooth: bool = True) -> np.ndarray:
        """Normals of patches and tangents of curves at places that `closest` found; see `project`."""
        plain = self._plain[found.pieces]
        if not smooth:
            return plain
        mean = np.einsum("ki,kij->kj", found.weights, self._smooth[found.pieces])
        size = np.linalg.norm(mean, axis=1, keepdims=True)
        return np.where(size > 1e-6, mean / np.maximum(size, 1e-6), plain)


def triangulated(points: np.ndarray, faces: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Faces as triangles (t, 3) int32, the face of each (t,), and their vertices: the points, then middles of quads."""
    if faces.shape[1] == 3:
        return faces, np.arange(len(faces)), np.ascontiguousarray(points)
    middle = len(points) + np.arange(len(faces), dtype=np.int32)
    around = np.stack([faces, np.roll(faces, -1, axis=1), np.repeat(middle[:, None], 4, axis=1)], axis=-1)
    vertices = np.concatenate([points, points[faces].mean(axis=1)])
    return around.reshape(-1, 3).astype(np.int32), np.repeat(np.arange(len(faces)), 4), vertices


def triangle_normals(vertices: np.ndarray, triangles: np.ndarray) -> np.ndarray:
    """Unit normals (t, 3), 0 of a triangle without an area."""
    a, b, c = (vertices[triangles[:, k]] for k in range(3))
    return unit(np.cross(b - a, c - a))


def directions_of(vertices: np.ndarray, segments: np.ndarray) -> np.ndarray:
    """Unit vectors along segments (s, 2 or more) from their first to their second node."""
    return unit(vertices[segments[:, 1]] - vertices[segments[:, 0]])


def vertex_normals(vertices: np.ndarray, triangles: np.ndarray, patch: np.ndarray) -> np.ndarray:
    """Normals of a patch at the corners of its triangles, weighted by angles, (t, 3 corners, 3).

    After Thürmer and Wüthrich, "Computing vertex normals from polygonal facets" (1998): they do not depend on how a
    flat part is cut into triangles. A vertex of several patches has a normal in each.
    """
    corners = vertices[triangles]
    one, other = (np.roll(corners, -k, axis=1) - corners for k in (1, 2))
    sine = np.linalg.norm(np.cross(one, other), axis=2)
    angle = np.arctan2(sine, np.einsum("tij,tij->ti", one, other))
    key = patch[:, None].astype(np.int64) * len(vertices) + triangles
    _, vertex = np.unique(key, return_inverse=True)
    share = angle[:, :, None] * triangle_normals(vertices, triangles)[:, None, :]
    sums = np.column_stack([np.bincount(vertex.ravel(), share[:, :, k].ravel()) for k in range(3)])
    return unit(sums)[vertex.reshape(triangles.shape)]


def vertex_tangents(points: np.ndarray, boundary: Boundary) -> np.ndarray:
    """Tangents of curves at the nodes of their segments, in the sense of the segment, (s, 3, 3); see `Surface`.

    At a node inside a curve along the line from the node before to the node after; at a corner along the segment.
    """
    segments = boundary.segments
    own = directions_of(points, segments)
    tangents = np.repeat(own[:, None], 2, axis=1)
    ends = segments.ravel()
    at = np.flatnonzero(boundary.kind[ends] == Kind.CURVE)
    at = at[np.argsort(ends[at], kind="stable")].reshape(-1, 2)
    chord = unit(points[ends[at[:, 1] ^ 1]] - points[ends[at[:, 0] ^ 1]])
    for side in range(2):
        sense = np.where(np.einsum("ij,ij->i", chord, own[at[:, side] // 2]) < 0, -1.0, 1.0)
        tangents[at[:, side] // 2, at[:, side] % 2] = sense[:, None] * chord
    return tangents[:, [0, 1, 1]]


def unit(vectors: np.ndarray) -> np.ndarray:
    """Vectors (..., 3) with length 1, or 0 where they are 0."""
    size = np.linalg.norm(vectors, axis=-1, keepdims=True)
    return vectors / np.where(size > 0, size, 1.0)
