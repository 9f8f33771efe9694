"""Nodes of a boundary that have left their corner, curve or patch, and those that are kept exactly on it."""

from __future__ import annotations

from dataclasses import dataclass
from enum import IntEnum

import numpy as np

from hexmend.boundary.classification import NodeClass
from hexmend.boundary.feature_edges.features import FEATURE_ANGLE, FeatureAngle
from hexmend.boundary.sliding import SlidingBoundary
from hexmend.boundary.tolerances import FLAT_DISTANCE
from hexmend.mesh.mesh import Mesh
from hexmend.terminal_text import count_phrase

_CLASSES = (NodeClass.CORNER, NodeClass.CURVE, NodeClass.PATCH)
_KEYS = ("corners", "curve_nodes", "patch_nodes")


class Keeping(IntEnum):
    """Degree to which a node keeps the original boundary."""

    INSIDE = 0
    EXACT = 1
    WITHIN_TOLERANCE = 2


@dataclass(frozen=True, eq=False)
class Departures:
    """Nodes that have left the corner, curve or patch that they had on the original boundary.

    Parameters
    ----------
    node_class : (n,) uint8
        `NodeClass` of each node on the original boundary.
    distance : (n,) float64
        Distance of each node from its corner, curve or patch, in the mesh's unit; 0 inside.
    edge_length : float
        Mean edge length of the original mesh.
    """

    node_class: np.ndarray
    distance: np.ndarray
    edge_length: float

    @property
    def nodes(self) -> np.ndarray:
        """Numbers of the nodes that have left, ascending, (k,) int64."""
        return np.flatnonzero(self.distance > FLAT_DISTANCE * self.edge_length)

    @property
    def keeping(self) -> np.ndarray:
        """`Keeping` of each node, (n,) uint8."""
        keeping = np.where(self.node_class == NodeClass.INSIDE, Keeping.INSIDE, Keeping.EXACT).astype(np.uint8)
        keeping[self.nodes] = Keeping.WITHIN_TOLERANCE
        return keeping

    @property
    def counts(self) -> dict[str, int]:
        """Number of corners, nodes of curves and nodes of patches that have left."""
        left = self.node_class[self.nodes]
        return {key: int(np.count_nonzero(left == of)) for key, of in zip(_KEYS, _CLASSES, strict=True)}

    @property
    def max(self) -> float:
        """Largest distance in mean edge lengths."""
        return float(self.distance.max(initial=0.0)) / (self.edge_length or 1.0)

    @property
    def sentence(self) -> str:
        """Description as a sentence; "" where every node is kept exactly."""
        if not self.nodes.size:
            return ""
        corners, curve, patch = self.counts.values()
        left = [
            count_phrase(corners, "corner has left its place", "corners have left their places"),
            count_phrase(curve, "node has left its curve", "nodes have left their curves"),
            count_phrase(patch, "node has left its patch", "nodes have left their patches"),
        ]
        clauses = ", ".join(text for count, text in zip((corners, curve, patch), left, strict=True) if count)
        return f"For the sake of the worst hexes, {clauses}, by at most {self.max:.2g} mean edge lengths."

    def to_dict(self) -> dict[str, float | int | list[int]]:
        """Return the values by name: counts, the largest distance in mean edge lengths, and the nodes."""
        return {**self.counts, "max": self.max, "nodes": self.nodes.tolist()}


def departures(
    before: Mesh, after: Mesh, feature_angle: FeatureAngle = FEATURE_ANGLE, outer: bool = True
) -> Departures:
    """Find the nodes that have left their corner, curve or patch.

    Parameters
    ----------
    before, after : Mesh
        Meshes with the same hexes.
    feature_angle : float or "auto"
        See `boundary_of`.
    outer : bool
        See `SlidingBoundary`.

    Returns
    -------
    Departures
    """
    sliding = SlidingBoundary(before, feature_angle, outer=outer)
    node_class, distance = sliding.boundary.node_class, np.zeros(before.n_nodes)
    corners = np.flatnonzero(node_class == NodeClass.CORNER)
    distance[corners] = np.linalg.norm(after.points[corners] - before.points[corners], axis=1)
    x = after.points[sliding.nodes]
    distance[sliding.nodes] = np.linalg.norm(sliding.project(x) - x, axis=1)
    distance[(after.points == before.points).all(axis=1)] = 0.0  # on another surface they may be far away
    return Departures(node_class, distance, before.mean_edge_length)
