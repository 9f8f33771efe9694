"""Surface of triangles or quads as a whole: what a mesh is compared with, and what its boundary may slide on."""

from __future__ import annotations

import copy
from functools import cached_property

import numpy as np

from hexmend.arrays import index_of, mask, row_norms
from hexmend.boundary.closest_point import ClosestPoints, ClosestPointTrees, triangulate, vertices_of
from hexmend.boundary.edges import SurfaceEdges
from hexmend.boundary.surface import PartitionedSurface
from hexmend.errors import MeshError
from hexmend.mesh.mesh import Mesh
from hexmend.mesh.validation import as_faces, as_points, points_like

#: A boundary lies near a surface if 90 % of its nodes are within this many mean edge lengths of it.
MAX_TARGET_DISTANCE = 2.0
#: Edges and faces of a surface that was read are sampled where they are longer than this many mean edge lengths.
SAMPLE_DISTANCE = 0.5


class SkinSurface:
    """Surface of triangles or quads as a whole, without patches, for comparison with others.

    Parameters
    ----------
    points : (n, 3) float64
    faces : (k, 4) or (k, 3) int32
    name : str
        Name in messages; the file's name if it was read.
    group : (k,) int, optional
        Group of each face, from 0, none empty: only one is searched for each point. One group by default.

    Attributes
    ----------
    nodes : (b,) int64
        Nodes of the faces, ascending.
    edges : SurfaceEdges
    trees : ClosestPointTrees
        The groups of faces, divided by `triangulate`.
    faces_of_pieces : (p,) int64
        Number of the face on which each piece of the trees lies.
    derived : dict
        Curves and patches by feature angle, for those who slide on the surface.

    Raises
    ------
    MeshError
        For arrays of another shape or type, and for a node that does not exist.
    """

    def __init__(self, points: np.ndarray, faces: np.ndarray, name: str = "", group: np.ndarray | None = None):
        points = as_points(points)
        faces = as_faces(faces, len(points))
        if group is not None and len(group) != len(faces):
            raise MeshError(f"there are {len(group)} groups: expected one for each of {len(faces)} faces")
        self.points, self.faces, self.name = points, faces, name
        self.derived: dict[float | str, PartitionedSurface] = {}
        self.nodes, self.edges = np.flatnonzero(mask(faces, len(points))), SurfaceEdges(faces, len(points))
        vertices, triangles, face = triangulate(points, faces)
        of_piece = np.zeros(len(triangles), dtype=np.int64) if group is None else group[face]
        self.trees = ClosestPointTrees(vertices, triangles, of_piece)
        self.faces_of_pieces = face[self.trees.order]

    def with_points(self, points: np.ndarray) -> SkinSurface:
        """Return a surface of the same faces with other node positions (n, 3) float64."""
        other, points = copy.copy(self), points_like(points, self.points.shape)
        other.points, other.trees = points, self.trees.with_points(vertices_of(points, self.faces))
        other.derived = {}
        vars(other).pop("_edge_lengths", None)
        return other

    def samples(self, spacing: float = 0.0) -> np.ndarray:
        """Return the positions of `nodes`, of edge midpoints and of face midpoints, in this order, (s, 3).

        Midpoints of edges that are no longer than `spacing` and of faces without a longer edge are left out.
        """
        edges, faces = self.edges.nodes, self.faces
        if spacing > 0:
            longer = self._edge_lengths > spacing
            edges, faces = edges[longer], faces[mask(self.edges.neighbours[longer].ravel(), len(faces))]
        return np.concatenate([self.points[self.nodes], _middles(self.points, edges), _middles(self.points, faces)])

    @cached_property
    def _edge_lengths(self) -> np.ndarray:
        """Length of each edge, (e,); kept, as a run and its report both need it."""
        one, other = (self.points.take(self.edges.nodes[:, end], axis=0) for end in range(2))
        return row_norms(other - one)

    @cached_property
    def pieces_of_samples(self) -> np.ndarray:
        """A piece of the trees of each of `samples`, without spacing, (s,) int32; for quads."""
        sides = np.arange(self.faces.size)  # piece 4 i + k as given is that at side k of face i
        at_node = np.empty(len(self.points), dtype=np.int64)
        at_node[self.faces.ravel()] = sides
        given = np.concatenate([at_node[self.nodes], self.edges.first_sides, sides[::4]])
        return index_of(self.trees.order, sides.size)[given]

    def distances(self, x: np.ndarray, stop_distance: float = 0.0, known: np.ndarray | None = None) -> np.ndarray:
        """Return the distance of each point x (k, 3) from the surface, (k,), in the mesh's unit; see `find`."""
        return np.linalg.norm(self.closest(x, stop_distance, known) - x, axis=1)

    def find(
        self,
        x: np.ndarray,
        stop_distance: float = 0.0,
        known: np.ndarray | None = None,
        group: np.ndarray | None = None,
    ) -> ClosestPoints:
        """Find the points of the surface closest to x (k, 3), or any within `stop_distance`.

        Parameters
        ----------
        x : (k, 3) float64
        stop_distance : float
            The search ends at any point within this distance.
        known : (k,) int32, optional
            See `ClosestPointTrees.closest`.
        group : (k,) int, optional
            Group that is searched for each point; the first by default.
        """
        return self.trees.closest(x, np.zeros(len(x), dtype=np.int64) if group is None else group, stop_distance, known)

    def closest(self, x: np.ndarray, stop_distance: float = 0.0, known: np.ndarray | None = None) -> np.ndarray:
        """Return the positions that `find` finds, (k, 3)."""
        return self.find(x, stop_distance, known).points

    def weights_of_nodes(self, found: ClosestPoints) -> tuple[np.ndarray, np.ndarray]:
        """Describe points that `find` has found by the nodes of their faces.

        Returns
        -------
        nodes : (k, 4) or (k, 3) int
            Nodes of the face on which each point lies.
        weights : (k, 4) or (k, 3) float64
            Weights of these nodes, whose mean is the point.
        """
        pieces, width = self.trees.pieces[found.pieces], self.faces.shape[1]
        if width == 3:
            return pieces, found.weights
        nodes = self.faces[pieces[:, 2] - len(self.points)]
        weights = np.repeat(found.weights[:, 2:] / width, width, axis=1)
        for end in range(2):
            here = nodes == pieces[:, end, None]
            shares = found.weights[:, end] / np.maximum(here.sum(axis=1), 1)  # a triangle has its last node twice
            weights += np.where(here, shares[:, None], 0.0)
        return nodes, weights

    def nodes_of_pieces(self, pieces: np.ndarray) -> np.ndarray:
        """Return the nodes of the faces on which pieces (k,), such as `NearPoints.pieces`, lie, (k, 4) or (k, 3)."""
        return self.faces[self.faces_of_pieces[pieces]]

    def check_near(self, mesh: Mesh) -> None:
        """Raise `MeshError` unless the boundary of a mesh lies near the surface."""
        on = np.flatnonzero(mesh.topology.boundary)
        far = float(np.quantile(self.distances(mesh.surface_points[on]), 0.9)) / (mesh.mean_edge_length or 1.0)
        if far <= MAX_TARGET_DISTANCE:
            return
        both = self.points[self.nodes], mesh.surface_points[on]
        boxes = (" x ".join(f"{side:.3g}" for side in np.ptp(x, axis=0)) for x in both)
        raise MeshError(
            f"{self.name or 'the surface'}: one in ten nodes of the mesh's boundary is {far:.3g} mean edge lengths "
            f"or more from it: expected at most {MAX_TARGET_DISTANCE:g}. It measures {next(boxes)}, the boundary "
            f"{next(boxes)}: scale or move it if its unit or position differs, or choose the surface of this mesh."
        )

    def volume(self) -> float:
        """Return the enclosed volume of a closed surface."""
        x, triangles = self.trees.points - self.points[self.nodes].mean(axis=0), self.trees.pieces
        a, b, c = (x.take(triangles[:, k], axis=0) for k in range(3))
        return float(np.einsum("ij,ij->i", a, np.cross(b, c)).sum() / 6)


def _middles(points: np.ndarray, rows: np.ndarray) -> np.ndarray:
    """Return the mean of the points (n, 3) of each row (k, w) of nodes, (k, 3)."""
    return sum(points.take(rows[:, column], axis=0) for column in range(rows.shape[1])) / rows.shape[1]
