"""Classification of boundary nodes: corners stay, other nodes may slide on a curve or a patch."""

from __future__ import annotations

from dataclasses import dataclass, replace
from enum import IntEnum

import numpy as np

from hexmend.arrays import index_of, mask
from hexmend.boundary.edges import SurfaceEdges, chains
from hexmend.boundary.feature_edges.features import (
    FEATURE_ANGLE,
    WHISKER_FACTOR,
    FeatureAngle,
    curve_corners,
    feature_edges,
    marked_corners,
    marked_edges,
)
from hexmend.boundary.skin_faces import skin_faces
from hexmend.errors import MeshError
from hexmend.mesh.fields import as_set
from hexmend.mesh.mesh import Mesh
from hexmend.mesh.topology.components import components
from hexmend.mesh.validation import as_faces, as_integers, as_points, check_node_numbers


class NodeClass(IntEnum):
    """Role of a node in the boundary of a mesh."""

    INSIDE = 0
    CORNER = 1
    CURVE = 2
    PATCH = 3


@dataclass(frozen=True, eq=False)
class Boundary:
    """Boundary divided into patches of faces, curves of feature edges, and corners.

    Parameters
    ----------
    node_class : (n,) uint8
        `NodeClass` of each node.
    component : (n,) int32
        Number of the curve of a curve node or of the patch of a patch node, each from 0; -1 for other nodes.
    faces : (k, 4) or (k, 3) int32
        Nodes of each face, counter-clockwise from outside.
    patch_of_face : (k,) int32
        Patch number of each face.
    segments : (s, 2) int32
        Nodes of each feature edge, lower node first.
    curve_of_segment : (s,) int32
        Curve number of each feature edge.
    """

    node_class: np.ndarray
    component: np.ndarray
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

    def with_corners(self, nodes: np.ndarray) -> Boundary:
        """Return the boundary with some nodes (k,) as corners; curves and patches stay as they are."""
        return self._with_class(nodes[self.node_class[nodes] != NodeClass.INSIDE], NodeClass.CORNER)

    def without_nodes(self, nodes: np.ndarray) -> Boundary:
        """Return the boundary with some nodes (k,) inside: they move freely, whatever their curve or patch."""
        return self._with_class(nodes, NodeClass.INSIDE)

    def _with_class(self, nodes: np.ndarray, node_class: NodeClass) -> Boundary:
        classes, component = self.node_class.copy(), self.component.copy()
        classes[nodes], component[nodes] = node_class, -1
        return replace(self, node_class=classes, component=component)

    def with_faces(self, which: np.ndarray) -> Boundary:
        """Return the boundary with some of its faces (k,) bool alone; nodes, curves and patches stay as they are."""
        return replace(self, faces=self.faces[which], patch_of_face=self.patch_of_face[which])

    def on_nodes(self, nodes: np.ndarray) -> Boundary:
        """Return the boundary with nodes numbered by their places among some (k,) int, which include all of its own."""
        number = index_of(nodes, len(self.node_class))
        return replace(
            self,
            node_class=self.node_class[nodes],
            component=self.component[nodes],
            faces=number[self.faces],
            segments=number[self.segments],
        )

    def count(self, node_class: NodeClass) -> int:
        """Return the number of nodes of a class."""
        return int(np.count_nonzero(self.node_class == node_class))


def boundary_of(
    mesh: Mesh,
    feature_angle: FeatureAngle = FEATURE_ANGLE,
    *,
    turn: FeatureAngle | None = None,
    whisker: float = WHISKER_FACTOR,
    sharp: np.ndarray | None = None,
    corners: np.ndarray | None = None,
) -> Boundary:
    """Classify the nodes of the boundary of a mesh and of the interfaces between its materials.

    A patch is of the boundary or of an interface, never of both: where they meet is a curve.

    Parameters
    ----------
    mesh : Mesh
    feature_angle : float or "auto"
        Dihedral angle beyond which an edge is a feature. auto: edges of more than 40 degrees in chains that stand out
        from the bends of the surface around them.
    turn : float or "auto", optional
        Angle between successive segments beyond which a curve has a corner, in degrees; `feature_angle` by default.
        auto: more than 40 degrees and than the turns beside it, or more than 75.
    whisker : float
        Feature edges that end in the middle of a patch, or are isolated, are dropped if the sum of their dihedral
        angles is less than this multiple of `feature_angle` (auto: of 40 degrees); 0 keeps them all.
    sharp : (e, 2) int, optional
        Edges that are features whatever their angle. By default those that the mesh's file marks (Medit's Ridges and
        RequiredEdges, and edges at which references of Quadrilaterals change), and those at which named sets end.
    corners : (c,) int, optional
        Nodes that are corners. By default those that the file marks (Medit's Corners), those alone in a named set,
        and the pinned nodes.

    Returns
    -------
    Boundary

    Raises
    ------
    MeshError
        For edges or corners that name nodes that do not exist.

    Examples
    --------
    >>> from hexmend.gallery import make
    >>> cube = boundary_of(make("cube", size=27))
    >>> [cube.count(of) for of in NodeClass], cube.n_curves, cube.n_patches
    ([8, 8, 24, 24], 12, 6)
    """
    sharp = marked_edges(mesh) if sharp is None else sharp
    corners = marked_corners(mesh) if corners is None else corners
    marks = {"sharp": sharp, "corners": corners}
    return classify(mesh.points, skin_faces(mesh).faces, feature_angle, turn=turn, whisker=whisker, **marks)


def classify(
    points: np.ndarray,
    faces: np.ndarray,
    feature_angle: FeatureAngle = FEATURE_ANGLE,
    *,
    turn: FeatureAngle | None = None,
    whisker: float = WHISKER_FACTOR,
    sharp: np.ndarray | None = None,
    corners: np.ndarray | None = None,
    edges: SurfaceEdges | None = None,
) -> Boundary:
    """Classify the nodes of any surface of triangles or quads; see `boundary_of`.

    A curve is a chain of feature edges from corner to corner, or a loop without corners. Corners are nodes at which
    one, three or more feature edges meet, a curve turns, or sheets of the surface touch, and those given. Patches are
    the connected faces between curves.

    Parameters
    ----------
    points : (n, 3) float64
    faces : (k, 4) or (k, 3) int32
    feature_angle, turn, whisker, sharp, corners
        See `boundary_of`; no edges and corners are given by default.
    edges : SurfaceEdges, optional
        Those of the faces, where they are known already.

    Returns
    -------
    Boundary

    Raises
    ------
    MeshError
        For arrays of another shape or type, and for nodes that do not exist.
    """
    points = as_points(points)
    n = len(points)
    faces, kept = as_faces(faces, n), mask(as_set([] if corners is None else corners, "corners", n), n)
    edges = edges or SurfaceEdges(faces, n)
    given = np.isin(edges.key, edges.keys_of(_edges([] if sharp is None else sharp, n)))
    feature = feature_edges(points, edges, feature_angle, given, kept, whisker)
    segments = edges.nodes[feature]
    valence = np.bincount(segments.ravel(), minlength=n)
    corner = kept | ((valence != 2) & (valence != 0)) | (edges.fans > 1)
    corner |= curve_corners(points, segments, ~corner & (valence == 2), feature_angle if turn is None else turn)
    curve_of_segment = chains(segments, corner)
    patch_of_face = components(len(faces), edges.neighbours[~feature & (edges.count == 2)])

    node_class, part = np.zeros(n, dtype=np.uint8), np.full(n, -1, dtype=np.int32)
    node_class[faces], part[faces] = NodeClass.PATCH, patch_of_face[:, None]
    node_class[segments], part[segments] = NodeClass.CURVE, curve_of_segment[:, None]
    corner &= node_class != NodeClass.INSIDE
    node_class[corner], part[corner] = NodeClass.CORNER, -1
    return Boundary(node_class, part, faces, patch_of_face, segments, curve_of_segment)


def _edges(edges: np.ndarray, n: int) -> np.ndarray:
    """Check edges of n nodes, (e, 2) int; raises `MeshError` for another shape or an unknown node."""
    array = as_integers(edges, "sharp edges", ("edge", "end"))
    if not array.size:
        return array.reshape(0, 2)
    if array.ndim != 2 or array.shape[1] != 2:
        raise MeshError(f"sharp edges have shape {array.shape}: expected (e, 2)")
    check_node_numbers(array, n, ("edge", "end"))
    return array
