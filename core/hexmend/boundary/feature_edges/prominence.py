"""Sharp edges that stand out from the bends of the surface around them, and corners that stand out from a curve.

A coarse mesh of a smooth body bends as sharply from face to face as the edge of a part may do. What makes an edge is
that the surface around it bends less.
"""

from __future__ import annotations

import numpy as np

from hexmend.boundary.edges import SurfaceEdges, segment_pairs
from hexmend.kernels import closest_point, incidence

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
