"""Comparison of two surfaces: distances, volume and sharp edges of a boundary before and after smoothing."""

from __future__ import annotations

import copy
from dataclasses import dataclass

import numpy as np

from hexmend.aliases import old_keywords
from hexmend.arrays import mask, row_norms
from hexmend.boundary.classification import boundary_of
from hexmend.boundary.closest_point import ClosestPoints, ClosestPointTrees, NearPoints, triangulate, vertices_of
from hexmend.boundary.edges import SurfaceEdges
from hexmend.boundary.feature_edges.features import FEATURE_ANGLE, FeatureAngle, angle_in_degrees, dihedral_angles
from hexmend.boundary.surface import PartitionedSurface
from hexmend.errors import MeshError
from hexmend.mesh.mesh import Mesh
from hexmend.mesh.validation import as_faces, as_points, points_like
from hexmend.terminal_text import count_phrase

#: Nodes that have moved less, in mean edge lengths, count as unmoved.
_MOVE_TOLERANCE = 1e-9
#: A boundary lies near a surface if 90 % of its nodes are within this many mean edge lengths of it.
MAX_TARGET_DISTANCE = 2.0
#: Edges and faces of a surface that was read are sampled where they are longer than this many mean edge lengths.
SAMPLE_DISTANCE = 0.5


@dataclass(frozen=True)
class SurfaceChange:
    """Change of a mesh's boundary by smoothing.

    Distances are two-sided, between the new boundary and the original one, or the target surface if there is one:
    from the nodes, edge midpoints and face midpoints of each to the other. On a target, edges and faces that are no
    longer than half the mean edge length of the mesh have no midpoints.

    Parameters
    ----------
    max_distance : float
        Largest distance in the mesh's unit.
    mean_distance : float
        Mean distance in the mesh's unit, the larger of the two directions.
    edge_length, diagonal : float
        Mean edge length of the original mesh and diagonal of its bounding box, in its unit.
    volume_change : float
        Relative change of the enclosed volume.
    moved : int
        Number of boundary nodes that have moved.
    features, features_kept : int
        Number of edges at which the boundary was sharp, and of those that still are.
    reference : str
        Name of the surface from which distances are measured; "" for the original boundary.
    """

    max_distance: float
    mean_distance: float
    edge_length: float
    diagonal: float
    volume_change: float
    moved: int
    features: int
    features_kept: int
    reference: str = ""

    @property
    def max(self) -> float:
        """Largest distance in mean edge lengths."""
        return self.max_distance / (self.edge_length or 1.0)

    @property
    def mean(self) -> float:
        """Mean distance in mean edge lengths."""
        return self.mean_distance / (self.edge_length or 1.0)

    @property
    def max_percent_of_diagonal(self) -> float:
        """Largest distance in per cent of the diagonal."""
        return 100 * self.max_distance / (self.diagonal or 1.0)

    @property
    def sentence(self) -> str:
        """Description of the change as a sentence."""
        return (
            f"{self._motion} it is at most {self.max:.2g} mean edge lengths ({self.max_percent_of_diagonal:.2g} % of "
            f"the diagonal) from {self.reference or 'where it was'}, {self.mean:.2g} in the mean; its volume changed "
            f"by {100 * self.volume_change:+.2g} %; {self.features_kept:,} of "
            f"{count_phrase(self.features, 'sharp edge')} {'is' if self.features_kept == 1 else 'are'} kept."
        )

    @property
    def _motion(self) -> str:
        """Beginning of the description: the number of nodes that moved."""
        if not self.moved:
            return "The boundary could slide, but none of its nodes moved:"
        return f"The boundary slid: {self.moved:,} of its nodes moved;"

    def to_dict(self) -> dict[str, float | int]:
        """Return the values by name, lengths in mean edge lengths."""
        names = ("max", "mean", "max_percent_of_diagonal", "volume_change", "moved")
        return {name: getattr(self, name) for name in names}


class SkinSurface:
    """Surface of triangles or quads as a whole, without patches, for comparison with others.

    Parameters
    ----------
    points : (n, 3) float64
    faces : (k, 4) or (k, 3) int32
    name : str
        Name in messages; the file's name if it was read.

    Attributes
    ----------
    nodes : (b,) int64
        Nodes of the faces, ascending.
    edges : SurfaceEdges
    derived : dict
        Curves and patches by feature angle, for those who slide on the surface.

    Raises
    ------
    MeshError
        For arrays of another shape or type, and for a node that does not exist.
    """

    def __init__(self, points: np.ndarray, faces: np.ndarray, name: str = ""):
        points = as_points(points)
        faces = as_faces(faces, len(points))
        self.points, self.faces, self.name = points, faces, name
        self.derived: dict[float | str, PartitionedSurface] = {}
        self.nodes, self.edges = np.unique(faces), SurfaceEdges(faces, len(points))
        vertices, triangles, _ = triangulate(points, faces)
        self._trees = ClosestPointTrees(vertices, triangles, np.zeros(len(triangles), dtype=np.int64))

    def with_points(self, points: np.ndarray) -> SkinSurface:
        """Return a surface of the same faces with other node positions (n, 3) float64."""
        other, points = copy.copy(self), points_like(points, self.points.shape)
        other.points, other._trees = points, self._trees.with_points(vertices_of(points, self.faces))
        other.derived = {}
        return other

    def samples(self, spacing: float = 0.0) -> np.ndarray:
        """Return the positions of `nodes`, of edge midpoints and of face midpoints, in this order, (s, 3).

        Midpoints of edges that are no longer than `spacing` and of faces without a longer edge are left out.
        """
        edges, faces = self.edges.nodes, self.faces
        if spacing > 0:
            one, other = (self.points[edges[:, end]] for end in range(2))
            longer = row_norms(other - one) > spacing
            edges, faces = edges[longer], faces[mask(self.edges.neighbours[longer].ravel(), len(faces))]
        return np.concatenate([self.points[self.nodes], _middles(self.points, edges), _middles(self.points, faces)])

    def distances(self, x: np.ndarray) -> np.ndarray:
        """Return the distance of each point x (k, 3) from the surface, (k,), in the mesh's unit."""
        return np.linalg.norm(self.closest(x) - x, axis=1)

    def closest_on(
        self,
        x: np.ndarray,
        stop_distance: float = 0.0,
        near: NearPoints | None = None,
        known: np.ndarray | None = None,
    ) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Find the points of the surface closest to x, with the nodes of their faces.

        Parameters
        ----------
        x : (k, 3) float64
        stop_distance : float
            The search ends at any point within this distance.
        near : NearPoints, optional
            Stores what is found.
        known : (k,) int32, optional
            See `ClosestPointTrees.closest`.

        Returns
        -------
        places : (k, 3) float64
        nodes : (k, 4) or (k, 3) int
            Nodes of the face on which each point lies.
        weights : (k, 4) or (k, 3) float64
            Weights of these nodes, whose mean is the point.
        """
        found = self._found(x, stop_distance, known)
        if near is not None:
            near.store(found)
        pieces, width = self._trees.pieces[found.pieces], self.faces.shape[1]
        if width == 3:
            return found.points, pieces, found.weights
        nodes = self.faces[pieces[:, 2] - len(self.points)]
        weights = np.repeat(found.weights[:, 2:] / width, width, axis=1)
        for end in range(2):
            weights += np.where(nodes == pieces[:, end, None], found.weights[:, end, None], 0.0)
        return found.points, nodes, weights

    def closest(self, x: np.ndarray, stop_distance: float = 0.0, known: np.ndarray | None = None) -> np.ndarray:
        """Return the points of the surface closest to x (k, 3), or any within `stop_distance`, (k, 3)."""
        return self._found(x, stop_distance, known).points

    def beyond(
        self,
        x: np.ndarray,
        near: NearPoints,
        limits: np.ndarray,
        samples: np.ndarray | None = None,
        points: np.ndarray | None = None,
    ) -> np.ndarray:
        """Find points x (k, 3) that are further than limits (k,) from the surface, (k,) bool.

        Parameters
        ----------
        x, near, limits, samples
            See `NearPoints.beyond`.
        points : (n, 3) float64, optional
            Positions of the surface's nodes; its own by default.
        """
        vertices = self._trees.points if points is None else vertices_of(points, self.faces)
        return near.beyond(self._trees, vertices, x, limits, samples)

    def nodes_of_pieces(self, pieces: np.ndarray) -> np.ndarray:
        """Return the nodes of the faces on which pieces (k,), such as `NearPoints.pieces`, lie, (k, 4) or (k, 3)."""
        pieces = self._trees.pieces[pieces]
        return pieces if self.faces.shape[1] == 3 else self.faces[pieces[:, 2] - len(self.points)]

    def _found(self, x: np.ndarray, stop_distance: float, known: np.ndarray | None) -> ClosestPoints:
        return self._trees.closest(x, np.zeros(len(x), dtype=np.int64), stop_distance, known)

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
        x, triangles = self._trees.points - self.points[self.nodes].mean(axis=0), self._trees.pieces
        a, b, c = (x[triangles[:, k]] for k in range(3))
        return float(np.einsum("ij,ij->i", a, np.cross(b, c)).sum() / 6)


def _middles(points: np.ndarray, rows: np.ndarray) -> np.ndarray:
    """Return the mean of the points (n, 3) of each row (k, w) of nodes, (k, 3)."""
    return sum(points[rows[:, column]] for column in range(rows.shape[1])) / rows.shape[1]


def mutual_distances(one: SkinSurface, other: SkinSurface, spacing: float = 0.0) -> tuple[np.ndarray, np.ndarray]:
    """Return the distances of the first surface's samples from the second, (s,), and the reverse, (t,).

    Samples of the first are thinned as by `SkinSurface.samples`.
    """
    return other.distances(one.samples(spacing)), one.distances(other.samples())


@old_keywords("surface_change")
def surface_change(before: Mesh, after: Mesh, feature_angle: FeatureAngle = FEATURE_ANGLE) -> SurfaceChange:
    """Measure the change of a mesh's boundary between two states.

    Parameters
    ----------
    before, after : Mesh
        Meshes with the same hexes. The original boundary is given by `before.surface_points`.
    feature_angle : float or "auto"
        Dihedral angle beyond which an edge is sharp.

    Returns
    -------
    SurfaceChange

    Raises
    ------
    MeshError
        For meshes of different hexes.

    Examples
    --------
    >>> from hexmend.gallery import make
    >>> cube = make("cube", size=27)
    >>> change = surface_change(cube, cube.with_points(1.5 * cube.points))
    >>> round(change.volume_change, 12), change.moved, change.features, change.features_kept
    (2.375, 55, 36, 36)
    """
    if before.n_nodes != after.n_nodes or not np.array_equal(before.hexes, after.hexes):
        raise MeshError(f"{before.n_hexes} and {after.n_hexes} hexes that are not the same: expected one mesh, moved")
    before = before.with_points(before.surface_points)
    old = SkinSurface(before.points, before.topology.boundary_faces)
    new = old.with_points(after.points)
    spacing = SAMPLE_DISTANCE * before.mean_edge_length
    both = mutual_distances(old, new) if after.target is None else mutual_distances(after.target, new, spacing)
    was, now = old.points[old.nodes], new.points[old.nodes]
    sharp = np.isin(old.edges.key, old.edges.keys_of(boundary_of(before, feature_angle).segments))
    least = angle_in_degrees(feature_angle)
    sharp &= dihedral_angles(old.points, old.edges) > least
    volume = old.volume()
    return SurfaceChange(
        max_distance=float(max(one.max() for one in both)),
        mean_distance=float(max(one.mean() for one in both)),
        edge_length=before.mean_edge_length,
        diagonal=float(np.linalg.norm(np.ptp(was, axis=0))),
        volume_change=(new.volume() - volume) / volume if volume else 0.0,
        moved=int(np.count_nonzero(np.linalg.norm(now - was, axis=1) > _MOVE_TOLERANCE * before.mean_edge_length)),
        features=int(np.count_nonzero(sharp)),
        features_kept=int(np.count_nonzero(sharp & (dihedral_angles(new.points, new.edges) > least))),
        reference="" if after.target is None else after.target.name or "the surface",
    )
