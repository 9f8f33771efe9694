"""Comparison of two surfaces: distances, volume and sharp edges of a boundary before and after smoothing.

Nodes of a boundary that have left their corner, curve or patch, and those that are kept exactly on it.
"""

from __future__ import annotations

from dataclasses import dataclass
from enum import IntEnum

import numpy as np

from hexmend.arrays import extent
from hexmend.boundary.classification import NodeClass, boundary_of
from hexmend.boundary.feature_edges.features import FEATURE_ANGLE, FeatureAngle, angle_in_degrees, dihedral_angles
from hexmend.boundary.skin_surface import SAMPLE_DISTANCE, SkinSurface
from hexmend.boundary.sliding import SlidingBoundary
from hexmend.boundary.tolerances import FLAT_DISTANCE, ROUNDING
from hexmend.errors import MeshError
from hexmend.mesh.mesh import Mesh
from hexmend.terminal_text import count_phrase


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
        change = self._distance
        if abs(self.volume_change) > ROUNDING:
            percent = 100 * self.volume_change
            change += f"; its volume changed by {percent:{'+.2g' if abs(percent) < 99 else '+,.0f'}} %"
        if self.features:
            edges = count_phrase(self.features, "sharp edge")
            change += f"; {self.features_kept:,} of {edges} {'is' if self.features_kept == 1 else 'are'} kept"
        return f"{self._motion} {change}."

    @property
    def _distance(self) -> str:
        """Distance of the boundary from the surface or from its earlier shape, as a clause."""
        if self.max <= ROUNDING:
            return f"it is on {self.reference}" if self.reference else "it has kept its shape"
        return (
            f"it is at most {self.max:.2g} mean edge lengths ({self.max_percent_of_diagonal:.2g} % of the diagonal) "
            f"from {self.reference or 'where it was'}, {self.mean:.2g} in the mean"
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


def mutual_distances(
    one: SkinSurface, other: SkinSurface, spacing: float = 0.0, stop_distance: float = 0.0
) -> tuple[np.ndarray, np.ndarray]:
    """Return the distances of the first surface's samples from the second, (s,), and the reverse, (t,).

    Samples of the first are thinned as by `SkinSurface.samples`; distances below `stop_distance` may be too large.
    """
    return other.distances(one.samples(spacing), stop_distance), one.distances(other.samples(), stop_distance)


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
    if before.n_nodes != after.n_nodes or not np.array_equal(before.elements, after.elements):
        raise MeshError(
            f"{before.n_elements} and {after.n_elements} hexes that are not the same: expected one mesh, moved"
        )
    before = before.with_points(before.surface_points)
    old = SkinSurface(before.points, before.topology.boundary_faces)
    new = old.with_points(after.points)
    spacing = SAMPLE_DISTANCE * before.mean_edge_length
    # Where faces overlap, all boxes at a place would be searched for a piece closer than the one on which it lies.
    rounding = ROUNDING * before.mean_edge_length
    near = 1e-6 * rounding  # distances below are not told apart
    if after.target is None:
        pieces = old.pieces_of_samples
        both = new.distances(old.samples(), near, pieces), old.distances(new.samples(), near, pieces)
    else:
        both = mutual_distances(after.target, new, spacing, near)
    was, now = old.points[old.nodes], new.points[old.nodes]
    sharp = np.isin(old.edges.key, old.edges.keys_of(boundary_of(before, feature_angle).segments))
    least = angle_in_degrees(feature_angle)
    sharp &= dihedral_angles(old.points, old.edges) > least
    volume = old.volume()
    return SurfaceChange(
        max_distance=float(max(one.max() for one in both)),
        mean_distance=float(max(one.mean() for one in both)),
        edge_length=before.mean_edge_length,
        diagonal=float(np.linalg.norm(extent(was))),
        volume_change=(new.volume() - volume) / volume if volume else 0.0,
        moved=int(np.count_nonzero(np.linalg.norm(now - was, axis=1) > rounding)),
        features=int(np.count_nonzero(sharp)),
        features_kept=int(np.count_nonzero(sharp & (dihedral_angles(new.points, new.edges) > least))),
        reference="" if after.target is None else after.target.name or "the surface",
    )


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
