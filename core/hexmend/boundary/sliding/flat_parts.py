"""Flat patches and straight curves of a boundary, and the linear motion of nodes that slide on them."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from hexmend.arrays import mask
from hexmend.boundary.classification import Boundary, NodeClass
from hexmend.boundary.tolerances import ROUNDING
from hexmend.mesh.linear_motion import LinearMotion


class FlatPart(NamedTuple):
    """Flat patch or straight curve.

    Parameters
    ----------
    nodes : (k,) int
        Its nodes, with those of its rim, ascending.
    directions : (3, d) float64
        Orthonormal directions in which it extends, in columns: two of a patch, one of a curve.
    """

    nodes: np.ndarray
    directions: np.ndarray


def flat_parts(points: np.ndarray, boundary: Boundary, mean_edge: float) -> list[FlatPart]:
    """Find the flat patches and straight curves of a boundary: no node is further than `ROUNDING` from them.

    Parameters
    ----------
    points : (n, 3) float64
        Node positions.
    boundary : Boundary
    mean_edge : float
        Mean edge length of the mesh.

    Returns
    -------
    list of FlatPart
        Patches first.
    """
    found = []
    kinds = (boundary.faces, boundary.patch_of_face, 2), (boundary.segments, boundary.curve_of_segment, 1)
    for pieces, part, dimensions in kinds:
        order = np.argsort(part, kind="stable")
        starts = np.flatnonzero(np.diff(part[order])) + 1
        for of_part in np.split(pieces[order], starts) if part.size else ():
            nodes = np.unique(of_part)
            x = points[nodes] - points[nodes].mean(axis=0)
            directions = np.linalg.eigh(x.T @ x)[1]  # by ascending extent
            if np.abs(x @ directions[:, : 3 - dimensions]).max() <= ROUNDING * mean_edge:
                found.append(FlatPart(nodes, directions[:, 3 - dimensions :]))
    return found


def flat_motion(points: np.ndarray, boundary: Boundary, sliding: np.ndarray, mean_edge: float) -> LinearMotion:
    """Restrict sliding nodes (k,) int on flat patches to their planes, and those on straight curves to their lines.

    A node keeps its distance from the plane or line.

    Parameters
    ----------
    points, boundary, mean_edge
        See `flat_parts`.
    sliding : (k,) int
        Nodes that slide: others, such as corners, get no linear motion.

    Returns
    -------
    LinearMotion
    """
    slides, nodes, projectors = mask(sliding, len(points)), [], []
    for part in flat_parts(points, boundary, mean_edge):
        own_class = NodeClass.PATCH if part.directions.shape[1] == 2 else NodeClass.CURVE
        own = part.nodes[slides[part.nodes] & (boundary.node_class[part.nodes] == own_class)]
        nodes.append(own)
        projectors.append(np.tile(part.directions @ part.directions.T, (own.size, 1, 1)))
    if not nodes:
        return LinearMotion()
    return LinearMotion(np.concatenate(nodes), np.concatenate(projectors))
