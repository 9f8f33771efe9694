"""Feature edges of a surface: by dihedral angle or by marks of its file, without short dangling chains.

Sharp edges that stand out from the bends of the surface around them, and corners that stand out from a curve.

A coarse mesh of a smooth body bends as sharply from face to face as the edge of a part may do. What makes an edge is
that the surface around it bends less.
"""

from __future__ import annotations

from itertools import pairwise
from typing import TypeAlias

import numpy as np

from hexmend.arrays import cross_products, row_norms
from hexmend.boundary.edges import SurfaceEdges, chains, segment_pairs
from hexmend.boundary.marking import marked_segments
from hexmend.boundary.skin_faces import edges_between_sets, lone_set_nodes
from hexmend.boundary.tolerances import ROUNDING
from hexmend.kernels import closest_point, incidence
from hexmend.mesh.mesh import Mesh
from hexmend.mesh.topology.components import components
from hexmend.parameters import AUTO

#: Dihedral angle beyond which an edge is a feature: `AUTO` where it has to stand out from the surface around it.
FeatureAngle: TypeAlias = float | str
#: Default of the feature angle.
FEATURE_ANGLE: FeatureAngle = AUTO
#: Dangling chains and isolated groups of feature edges count as roughness of a patch if the sum of their dihedral
#: angles is less than this multiple of the feature angle.
WHISKER_FACTOR = 10.0


def feature_edges(
    points: np.ndarray,
    edges: SurfaceEdges,
    feature_angle: FeatureAngle,
    given: np.ndarray,
    kept: np.ndarray,
    whisker: float,
) -> np.ndarray:
    """Find the feature edges of a surface.

    Parameters
    ----------
    points : (n, 3) float64
    edges : SurfaceEdges
    feature_angle : float or "auto"
        Dihedral angle beyond which an edge is a feature; auto: chains of edges that stand out from the surface around
        them, see `hexmend.boundary.feature_edges.features`.
    given : (e,) bool
        Edges that are features whatever their angle.
    kept : (n,) bool
        Nodes at which a chain may end.
    whisker : float
        See `WHISKER_FACTOR`.

    Returns
    -------
    (e,) bool
    """
    certain = given | (edges.count != 2)
    angle, least = dihedral_angles(points, edges), angle_in_degrees(feature_angle)
    feature = certain | (angle > least)
    weight = np.where(certain, np.inf, angle / max(least, np.finfo(float).tiny))
    around = np.zeros(angle.size)
    if feature_angle == AUTO:
        sharp = np.flatnonzero(feature)
        around[sharp] = surrounding_angles(edges, angle, sharp)
    while True:
        chosen = np.flatnonzero(feature)
        segments = edges.nodes[chosen]
        valence = np.bincount(segments.ravel(), minlength=edges.n)
        ends, chain = ((valence == 1) & ~kept)[segments].any(axis=1), chains(segments, valence != 2)
        rough = _below_weight(chain, weight[chosen], ends, whisker)
        rough |= is_low(chain, np.where(certain, np.inf, angle)[chosen], around[chosen])
        whole = components(edges.n, segments)[segments[:, 0]]
        rough |= _below_weight(whole, weight[chosen], np.ones(len(chosen), dtype=bool), whisker)
        if not rough.any():
            return feature
        feature[chosen[rough]] = False


def angle_in_degrees(feature_angle: FeatureAngle) -> float:
    """Return the dihedral angle beyond which an edge may be a feature."""
    return LEAST_ANGLE if feature_angle == AUTO else float(feature_angle)


def _below_weight(group: np.ndarray, weight: np.ndarray, counts: np.ndarray, least: float) -> np.ndarray:
    """True for segments of groups that have a member with `counts` and a total weight below `least`, (s,) bool."""
    sums = np.bincount(group, weight)
    return ((sums < least) & (np.bincount(group, counts) > 0))[group]


def dihedral_angles(points: np.ndarray, edges: SurfaceEdges) -> np.ndarray:
    """Angles between the normals of the two faces of each edge, in degrees, 0 without a normal; (e,) float64."""
    normals = face_normals(points, edges.faces)
    one, other = (normals.take(edges.neighbours[:, side], axis=0) for side in (0, 1))  # in a third of the time of []
    if not edges.opposed.all():
        other = np.where(edges.opposed[:, None], other, -other)
    return np.where(edges.count == 2, _angles_between(one, other), 0.0)


def face_normals(points: np.ndarray, faces: np.ndarray) -> np.ndarray:
    """Unit normals of the faces' mean planes, 0 for a face of negligible area; (k, 3) float64."""
    first = points.take(faces[:, 0], axis=0)
    x = [points.take(faces[:, corner], axis=0) - first for corner in range(1, faces.shape[1])]
    area = sum(cross_products(one, other) for one, other in pairwise(x))  # twice the area vector
    size = row_norms(area)
    perimeter = row_norms(x[0]) + sum(row_norms(other - one) for one, other in pairwise(x)) + row_norms(x[-1])
    sound = size > ROUNDING * perimeter**2 / 8  # a square has all of it
    if sound.all():
        return area / size[:, None]
    return np.where(sound[:, None], area, 0.0) / np.where(sound, size, 1.0)[:, None]


def turning_angles(points: np.ndarray, segments: np.ndarray, between: np.ndarray) -> np.ndarray:
    """Angles by which curves turn at nodes `between` (n,) bool two segments, in degrees, 0 elsewhere; (n,) float64."""
    ends, (first, second) = segments.ravel(), segment_pairs(segments, between).T
    node = ends[first]
    before, after = points[node] - points[ends[first ^ 1]], points[ends[second ^ 1]] - points[node]
    angle = np.zeros(len(points))
    angle[node] = _angles_between(before, after)
    return angle


def _angles_between(one: np.ndarray, other: np.ndarray) -> np.ndarray:
    """Angles between vectors (k, 3), in degrees, 0 where a vector is 0; (k,) float64."""
    return np.degrees(np.arctan2(row_norms(cross_products(one, other)), np.einsum("ij,ij->i", one, other)))


def curve_corners(points: np.ndarray, segments: np.ndarray, between: np.ndarray, turn: FeatureAngle) -> np.ndarray:
    """Find the nodes at which curves turn by more than `turn` or, if it is auto, by more than beside them.

    Parameters
    ----------
    points : (n, 3) float64
    segments : (s, 2) int32
    between : (n,) bool
        True for nodes at which exactly two segments meet.
    turn : float or "auto"
        In degrees.

    Returns
    -------
    (n,) bool
    """
    turns = turning_angles(points, segments, between)
    return standing_corners(segments, turns, between) if turn == AUTO else turns > turn


def marked_edges(mesh: Mesh) -> np.ndarray:
    """Edges marked in the mesh's file as ridges or required, and those at which named sets end, (e, 2) int.

    Faces of two references, as Medit has them, are of two sets.
    """
    found = [edges_between_sets(mesh), marked_segments(mesh)]
    for cells in mesh.cells:
        if cells.kind in ("quad", "triangle") and "medit:ref" in cells.data:
            edges, side = SurfaceEdges(cells.nodes, mesh.n_nodes), np.asarray(cells.data["medit:ref"])
            found.append(edges.nodes[side[edges.neighbours[:, 0]] != side[edges.neighbours[:, 1]]])
    return np.concatenate(found)


def marked_corners(mesh: Mesh) -> np.ndarray:
    """Nodes marked in the mesh's file as corners, those alone in a named set, and those that stay, (c,) int."""
    corners = np.asarray(mesh.node_sets.get("corners", []), dtype=np.int64)
    return np.concatenate([corners, lone_set_nodes(mesh), np.flatnonzero(mesh.immovable)])


#: Dihedral angle, in degrees, above which an edge may stand out, and turn above which a node of a curve may.
LEAST_ANGLE = 40.0
#: Multiple of the bends of the surface around it that the mean dihedral angle of a chain has at least.
EDGE_FACTOR = 3.5
#: Multiple of the lower turn of its two neighbours at which a node of a curve is a corner.
TURN_FACTOR = 2.0
#: Angle, in degrees, of an edge or turn that is no bend of a smooth surface or curve, however coarse the mesh.
CERTAIN_ANGLE = 75.0
#: Share of the edges around a chain that bend less than what counts as the bend of the surface there.
_QUANTILE = 0.6


def surrounding_angles(edges: SurfaceEdges, angle: np.ndarray, chosen: np.ndarray) -> np.ndarray:
    """Measure the bends of the surface around some edges.

    Parameters
    ----------
    edges : SurfaceEdges
    angle : (e,) float64
        Dihedral angle of each edge, in degrees.
    chosen : (s,) int64
        Numbers of some edges.

    Returns
    -------
    (s,) float64
        Quantile of the dihedral angles of the edges at the nodes of each chosen edge and at their neighbours, without
        the edge itself and without edges beyond `CERTAIN_ANGLE`; 0 where no edge is left.
    """
    start, ends = incidence.grouped(edges.nodes.ravel(), edges.n)
    some = chosen.astype(np.int32)
    return closest_point.quantiles_around(edges.nodes, start, ends, angle, some, CERTAIN_ANGLE, _QUANTILE)


def is_low(chain: np.ndarray, angle: np.ndarray, around: np.ndarray) -> np.ndarray:
    """Find the edges of chains that do not stand out.

    Parameters
    ----------
    chain : (s,) int
        Number of the chain of each edge, from 0.
    angle, around : (s,) float64
        Dihedral angle of each edge, inf for one that is certain, and the bend of the surface around it, in degrees.

    Returns
    -------
    (s,) bool
    """
    return (np.bincount(chain, angle) < EDGE_FACTOR * np.bincount(chain, around))[chain]


def standing_corners(segments: np.ndarray, turn: np.ndarray, between: np.ndarray) -> np.ndarray:
    """Find the nodes at which a curve has a corner that stands out from the turns beside it.

    Parameters
    ----------
    segments : (s, 2) int32
    turn : (n,) float64
        Turn of the curve at each node between two segments, in degrees.
    between : (n,) bool
        True for nodes at which exactly two segments meet and that are no corners.

    Returns
    -------
    (n,) bool
    """
    ends, (first, second) = segments.ravel(), segment_pairs(segments, between).T
    node, known = ends[first], np.where(between, turn, np.inf)
    lower = np.minimum(known[ends[first ^ 1]], known[ends[second ^ 1]])
    lower = np.where(np.isfinite(lower), lower, 0.0)
    found = np.zeros(turn.size, dtype=bool)
    found[node] = (turn[node] > LEAST_ANGLE) & ((turn[node] > TURN_FACTOR * lower) | (turn[node] > CERTAIN_ANGLE))
    return found
