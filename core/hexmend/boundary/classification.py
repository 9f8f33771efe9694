"""The boundary of a mesh, each node classed by what it may do: a corner is kept, others slide on a curve or a patch."""

from __future__ import annotations

from dataclasses import dataclass
from enum import IntEnum

import numpy as np

from hexmend.boundary.edges import SurfaceEdges, chains
from hexmend.boundary.features import DEGREES, WHISKER, feature_edges, given_corners, given_edges, turns
from hexmend.errors import MeshError
from hexmend.mesh.components import components
from hexmend.mesh.fields import as_set
from hexmend.mesh.mesh import Mesh
from hexmend.mesh.validation import as_faces, as_integers, as_points, check_node_numbers


class NodeClass(IntEnum):
    """What a node of a mesh is to its boundary."""

    INSIDE = 0
    CORNER = 1
    CURVE = 2
    PATCH = 3


@dataclass(frozen=True, eq=False)
class Boundary:
    """Faces of a boundary in patches, their feature edges in curves, and what that makes of the nodes.

    Parameters
    ----------
    kind : (n,) uint8
        One of `NodeClass` for each node.
    part : (n,) int32
        The curve of a curve node, the patch of a patch node, -1 of others; both counted from 0.
    faces : (k, 4) or (k, 3) int32
        Nodes of each face, counter-clockwise from outside.
    patch_of_face : (k,) int32
    segments : (s, 2) int32
        Nodes of each feature edge, lower node first.
    curve_of_segment : (s,) int32
    """

    kind: np.ndarray
    part: np.ndarray
    faces: np.ndarray
    patch_of_face: np.ndarray
    segments: np.ndarray
    curve_of_segment: np.ndarray

    @property
    def n_patches(self) -> int:
        """Number of patches."""
        return int(self.patch_of_face.max(initial=-1)) + 1

    @property
    def n_curves(self) -> int:
        """Number of curves."""
        return int(self.curve_of_segment.max(initial=-1)) + 1

    def count(self, kind: NodeClass) -> int:
        """Number of nodes of a kind."""
        return int(np.count_nonzero(self.kind == kind))


def boundary_of(
    mesh: Mesh, degrees: float = DEGREES, *, turn: float | None = None, whisker: float = WHISKER,
    sharp: np.ndarray | None = None, corners: np.ndarray | None = None,
) -> Boundary:  # fmt: skip
    """Class the boundary of a mesh.

    Parameters
    ----------
    mesh : Mesh
    degrees : float
        Angle between two faces beyond which their edge is a feature.
    turn : float, optional
        Angle by which a curve turns at a corner; that of `degrees` where none is given.
    whisker : float
        A chain of feature edges that ends in the middle of a patch, and what hangs together with no other, is left out
        where its angles sum up to less than so many times `degrees`; 0 leaves every one.
    sharp : (e, 2) int, optional
        Edges that are features whatever their angle. Where none are given: those that the mesh's file marks (Medit's
        Ridges and RequiredEdges, and where references of Quadrilaterals change).
    corners : (c,) int, optional
        Nodes that are kept. Where none are given: those that the file marks (Medit's Corners) and the pinned ones.

    Examples
    --------
    >>> from hexmend.gallery import make
    >>> cube = boundary_of(make("cube", size=27))
    >>> [cube.count(kind) for kind in NodeClass], cube.n_curves, cube.n_patches
    ([8, 8, 24, 24], 12, 6)
    """
    sharp = given_edges(mesh) if sharp is None else sharp
    corners = given_corners(mesh) if corners is None else corners
    return classify(
        mesh.points, mesh.topology.boundary_faces, degrees,
        turn=turn, whisker=whisker, sharp=sharp, corners=corners,
    )  # fmt: skip


def classify(
    points: np.ndarray, faces: np.ndarray, degrees: float = DEGREES, *, turn: float | None = None,
    whisker: float = WHISKER, sharp: np.ndarray | None = None, corners: np.ndarray | None = None,
) -> Boundary:  # fmt: skip
    """Class the nodes of any surface of triangles or quads; see `boundary_of`.

    A curve is a chain of feature edges from corner to corner, or a loop without any. Corners are where not two feature
    edges meet, where a curve turns, where the surface is no disc (sheets that touch in a node), and those given.
    Patches are the faces between curves.

    Parameters
    ----------
    points : (n, 3) float64
    faces : (k, 4) or (k, 3) int32
    degrees, turn, whisker, sharp, corners
        See `boundary_of`.
    """
    points = as_points(points)
    n = len(points)
    faces, kept = as_faces(faces, n), np.zeros(n, dtype=bool)
    kept[as_set([] if corners is None else corners, "corners", n)] = True
    edges = SurfaceEdges(faces, n)
    given = np.isin(edges.key, edges.keys_of(_edges([] if sharp is None else sharp, n)))
    feature = feature_edges(points, edges, degrees, given, kept, whisker)
    segments = edges.nodes[feature]
    valence = np.bincount(segments.ravel(), minlength=n)
    corner = kept | ((valence != 2) & (valence != 0)) | (edges.fans > 1)
    corner |= turns(points, segments, ~corner & (valence == 2)) > (degrees if turn is None else turn)
    curve_of_segment = chains(segments, corner)
    patch_of_face = components(len(faces), edges.neighbours[~feature & (edges.count == 2)])

    kind, part = np.zeros(n, dtype=np.uint8), np.full(n, -1, dtype=np.int32)
    kind[faces], part[faces] = NodeClass.PATCH, patch_of_face[:, None]
    kind[segments], part[segments] = NodeClass.CURVE, curve_of_segment[:, None]
    corner &= kind != NodeClass.INSIDE
    kind[corner], part[corner] = NodeClass.CORNER, -1
    return Boundary(kind, part, faces, patch_of_face, segments, curve_of_segment)


def _edges(edges: np.ndarray, n: int) -> np.ndarray:
    """Edges of nodes below n, (e, 2) int; `MeshError` where they are none."""
    array = as_integers(edges, "sharp edges", ("edge", "end"))
    if not array.size:
        return array.reshape(0, 2)
    if array.ndim != 2 or array.shape[1] != 2:
        raise MeshError(f"sharp edges have shape {array.shape}: expected (e, 2)")
    check_node_numbers(array, n, ("edge", "end"))
    return array
