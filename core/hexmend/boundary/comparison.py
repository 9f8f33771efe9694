"""How far a boundary has left where it was."""

from __future__ import annotations

import copy
from dataclasses import dataclass

import numpy as np

from hexmend.boundary.classification import boundary_of
from hexmend.boundary.closest_point import ClosestPointTrees, triangulated
from hexmend.boundary.edges import SurfaceEdges
from hexmend.boundary.features import DEGREES, angles
from hexmend.errors import MeshError
from hexmend.mesh.mesh import Mesh
from hexmend.mesh.validation import as_faces, as_points, points_like

#: A node that has moved less, in mean edge lengths, has been put back where it was.
_MOVED = 1e-9
#: A surface lies near a boundary if nine in ten of this one's nodes are within so many mean edge lengths of it.
NEAR = 2.0


@dataclass(frozen=True)
class SurfaceChange:
    """What became of a mesh's boundary.

    Distances are those of the nodes, edge middles and face middles of each surface from the other: of the boundary as
    it is from the boundary as it was, or from the surface that it slides on if that is another.

    Parameters
    ----------
    furthest : float
        The largest distance, both ways, in the mesh's unit.
    average : float
        The mean distance, of the way in which it is larger, in the mesh's unit.
    edge_length, diagonal : float
        Mean length of the mesh's edges and diagonal of its box before, in its unit.
    volume_change : float
        Of the enclosed volume, as a share of what it was.
    moved : int
        Number of boundary nodes that are elsewhere.
    features, features_kept : int
        Number of edges in which the boundary was sharp, and how many of these still are.
    of : str
        What the distances are from: "" of where the boundary was, else the name of another surface.
    """

    furthest: float
    average: float
    edge_length: float
    diagonal: float
    volume_change: float
    moved: int
    features: int
    features_kept: int
    of: str = ""

    @property
    def max(self) -> float:
        """The largest distance in mean edge lengths."""
        return self.furthest / (self.edge_length or 1.0)

    @property
    def mean(self) -> float:
        """The mean distance in mean edge lengths."""
        return self.average / (self.edge_length or 1.0)

    @property
    def max_percent_of_diagonal(self) -> float:
        """The largest distance in per cent of the diagonal."""
        return 100 * self.furthest / (self.diagonal or 1.0)

    @property
    def words(self) -> str:
        """What became of it, in a sentence."""
        return (
            f"The boundary slid: {self.moved:,} of its nodes moved; it is at most {self.max:.2g} mean edge lengths "
            f"({self.max_percent_of_diagonal:.2g} % of the diagonal) from {self.of or 'where it was'}, "
            f"{self.mean:.2g} in the mean; its volume changed by {100 * self.volume_change:+.2g} %; "
            f"{self.features_kept:,} of {self.features:,} sharp edges are kept."
        )

    def to_dict(self) -> dict[str, float | int]:
        """Figures by name, lengths in mean edge lengths."""
        names = ("max", "mean", "max_percent_of_diagonal", "volume_change", "moved")
        return {name: getattr(self, name) for name in names}


class SkinSurface:
    """A boundary as the surface that it is, without patches: what others are compared with.

    Parameters
    ----------
    points : (n, 3) float64
    faces : (k, 4) or (k, 3) int32
    name : str
        What to call it; of one that was read the file's name.

    Attributes
    ----------
    nodes : (b,) int64
        Nodes of the faces, ascending.
    edges : SurfaceEdges

    Raises
    ------
    MeshError
        For arrays of another shape or type, and for a node that does not exist.
    """

    def __init__(self, points: np.ndarray, faces: np.ndarray, name: str = ""):
        points = as_points(points)
        faces = as_faces(faces, len(points))
        self.points, self.faces, self.name = points, faces, name
        self.nodes, self.edges = np.unique(faces), SurfaceEdges(faces, len(points))
        self._trees = _one_tree(points, faces)

    def with_points(self, points: np.ndarray) -> SkinSurface:
        """The same faces with their nodes elsewhere, at points (n, 3) float64."""
        other, points = copy.copy(self), points_like(points, self.points.shape)
        vertices, _, _ = triangulated(points, self.faces)
        other.points, other._trees = points, self._trees.with_points(vertices)
        return other

    def samples(self) -> np.ndarray:
        """Places of `nodes`, middles of `edges.nodes`, middles of `faces`, in this order, (s, 3)."""
        middles = (self.points[of].mean(axis=1) for of in (self.edges.nodes, self.faces))
        return np.concatenate([self.points[self.nodes], *middles])

    def distances(self, x: np.ndarray) -> np.ndarray:
        """How far each of x (k, 3) is from the surface, (k,), in the mesh's unit."""
        return np.linalg.norm(self.closest(x) - x, axis=1)

    def closest_on(self, x: np.ndarray, enough: float = 0.0) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """The places of the surface that are closest to x (k, 3), or within `enough`, by the nodes that make them.

        Returns
        -------
        places : (k, 3)
        nodes : (k, 4) or (k, 3)
            Those of the face that each is on.
        weights : (k, 4) or (k, 3)
            Of these nodes there.
        """
        found = self._trees.closest(x, np.zeros(len(x), dtype=np.int64), enough)
        pieces, width = self._trees.pieces[found.pieces], self.faces.shape[1]
        if width == 3:
            return found.places, pieces, found.weights
        nodes = self.faces[pieces[:, 2] - len(self.points)]
        weights = np.repeat(found.weights[:, 2:] / width, width, axis=1)
        for end in range(2):
            weights += np.where(nodes == pieces[:, end, None], found.weights[:, end, None], 0.0)
        return found.places, nodes, weights

    def closest(self, x: np.ndarray, enough: float = 0.0) -> np.ndarray:
        """The places of the surface that are closest to x (k, 3), or within `enough`, (k, 3)."""
        return self._trees.closest(x, np.zeros(len(x), dtype=np.int64), enough).places

    def check_near(self, mesh: Mesh) -> None:
        """Raise `MeshError` unless the boundary of a mesh lies near the surface."""
        on = np.flatnonzero(mesh.topology.boundary)
        far = float(np.quantile(self.distances(mesh.surface_points[on]), 0.9)) / (mesh.mean_edge_length or 1.0)
        if far <= NEAR:
            return
        boxes = (
            " x ".join(f"{side:.3g}" for side in np.ptp(x, axis=0))
            for x in (self.points[self.nodes], mesh.surface_points[on])
        )
        raise MeshError(
            f"{self.name or 'the surface'}: one in ten nodes of the mesh's boundary is {far:.3g} mean edge lengths "
            f"or more from it: expected at most {NEAR:g}. It measures {next(boxes)}, the boundary {next(boxes)}: scale "
            "or shift it if its unit or place is another, or name the surface of this mesh."
        )

    def volume(self) -> float:
        """What the surface encloses, if it is closed."""
        x, triangles = self._trees.points - self.points[self.nodes].mean(axis=0), self._trees.pieces
        a, b, c = (x[triangles[:, k]] for k in range(3))
        return float(np.einsum("ij,ij->i", a, np.cross(b, c)).sum() / 6)


def _one_tree(points: np.ndarray, faces: np.ndarray) -> ClosestPointTrees:
    vertices, triangles, _ = triangulated(points, faces)
    return ClosestPointTrees(vertices, triangles, np.zeros(len(triangles), dtype=np.int64))


def distances(one: SkinSurface, other: SkinSurface) -> tuple[np.ndarray, np.ndarray]:
    """How far samples of each of two boundaries are from the other, of the first and of the second: (s,), (t,)."""
    return other.distances(one.samples()), one.distances(other.samples())


def surface_change(before: Mesh, after: Mesh, degrees: float = DEGREES) -> SurfaceChange:
    """Compare the surface that a mesh has before its nodes move with its boundary after they have.

    Parameters
    ----------
    before, after : Mesh
        Of the same hexes. Of the first its `Mesh.surface_points` counts: where nothing else is kept, its boundary.
    degrees : float
        Angle beyond which an edge is a feature.

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
    ways = distances(after.target or old, new)
    was, now = old.points[old.nodes], new.points[old.nodes]
    sharp = np.isin(old.edges.key, old.edges.keys_of(boundary_of(before, degrees).segments))
    sharp &= angles(old.points, old.edges) > degrees
    volume = old.volume()
    return SurfaceChange(
        furthest=float(max(way.max() for way in ways)),
        average=float(max(way.mean() for way in ways)),
        edge_length=before.mean_edge_length,
        diagonal=float(np.linalg.norm(np.ptp(was, axis=0))),
        volume_change=(new.volume() - volume) / volume if volume else 0.0,
        moved=int(np.count_nonzero(np.linalg.norm(now - was, axis=1) > _MOVED * before.mean_edge_length)),
        features=int(np.count_nonzero(sharp)),
        features_kept=int(np.count_nonzero(sharp & (angles(new.points, new.edges) > degrees))),
        of="" if after.target is None else after.target.name or "the surface",
    )
