"""The band around a surface in which a boundary that slides on it stays."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from hexmend.boundary.comparison import SkinSurface

#: Relative rounding error of a distance; also the smallest tolerance, as a share of the boundary's diagonal.
_ROUNDING = 1e-9
NO_NODES = np.empty(0, dtype=np.int64)


@dataclass(frozen=True, eq=False)
class Deviations:
    """Samples of one surface that lie further from the other than a limit.

    Parameters
    ----------
    indices : (k,) int64
        Numbers of these samples, ascending.
    distances : (k,) float64
        Distance of each from the closest point of the other surface, in the mesh's unit.
    directions : (k, 3) float64
        Unit vectors from the closest point to the sample: moving along them increases the distance.
    nodes : (k, 4) int
        Boundary nodes whose weighted mean is the sample, or the point closest to it.
    weights : (k, 4) float64
        Weights of these nodes.
    """

    indices: np.ndarray
    distances: np.ndarray
    directions: np.ndarray
    nodes: np.ndarray
    weights: np.ndarray


class Band:
    """Two-sided distance between a boundary and the surface on which it slides, against a tolerance.

    Nodes of the boundary lie on the surface; its edges and faces deviate where the surface is curved.

    Parameters
    ----------
    points : (n, 3) float64
        Original node positions of the boundary.
    faces : (k, 4) int32
        Faces of the boundary.
    start : (n, 3) float64
        Node positions before sliding, with the nodes on the surface.
    target : SkinSurface or None
        The surface; None if it is the original boundary.
    tolerance : float
        Largest distance allowed, in the mesh's unit; 0 allows rounding only.
    """

    def __init__(
        self, points: np.ndarray, faces: np.ndarray, start: np.ndarray, target: SkinSurface | None, tolerance: float
    ):
        self.points, self._faces, self._start, self._given = points, faces, start, target
        corners = points[faces.ravel()]
        size = float(np.linalg.norm(np.ptp(corners, axis=0))) if corners.size else 0.0
        self.tolerance = max(tolerance, _ROUNDING * size)

    @cached_property
    def skin(self) -> SkinSurface:
        """The original boundary."""
        return SkinSurface(self.points, self._faces)

    @property
    def target(self) -> SkinSurface:
        """The surface on which the boundary slides."""
        return self._given or self.skin

    @cached_property
    def midpoints(self) -> np.ndarray:
        """Samples of the boundary, (s, 4) int: each is the mean of four nodes.

        They are the midpoints of edges (with each node twice) and of faces, then the nodes themselves.
        """
        nodes = np.tile(self.skin.nodes[:, None], 4)
        return np.concatenate([np.tile(self.skin.edges.nodes, 2), self._faces, nodes])

    def midpoints_of(self, nodes: np.ndarray) -> np.ndarray:
        """Find the samples of `midpoints` that move with some nodes (j,), as (k,) int64."""
        moved = np.zeros(len(self.points), dtype=bool)
        moved[nodes] = True
        return np.flatnonzero(moved[self.midpoints].any(axis=1))

    def boundary_deviation(
        self, points: np.ndarray, indices: np.ndarray, limit: float | np.ndarray = 0.0
    ) -> Deviations:
        """Find samples of the boundary that are further from the surface than a limit.

        Parameters
        ----------
        points : (n, 3) float64
            Node positions.
        indices : (k,) int64
            Samples of `midpoints` to be examined.
        limit : float or (k,) float64
            In the mesh's unit; one for all samples, or one for each.

        Returns
        -------
        Deviations
        """
        limit = np.broadcast_to(limit, indices.shape)
        moved = (points - self._start)[self.midpoints[indices]].mean(axis=1)
        # A sample cannot be further away than it was at first plus its own move: no search for the others.
        near = self._initial_boundary_deviation[indices] + np.linalg.norm(moved, axis=1) > np.maximum(limit, 0.0)
        indices, limit = indices[near], limit[near]
        x = points[self.midpoints[indices]].mean(axis=1)
        closest = self.target.closest(x, max(float(limit.min(initial=np.inf)), 0.0))
        distances, directions = _distance_and_direction(x, closest)
        out = distances > limit
        nodes = self.midpoints[indices[out]]
        return Deviations(indices[out], distances[out], directions[out], nodes, np.full(nodes.shape, 0.25))

    def surface_deviation(
        self, points: np.ndarray, indices: np.ndarray | None = None, limit: float | np.ndarray = 0.0
    ) -> Deviations:
        """Find samples of the surface that are further from the boundary than a limit.

        Parameters
        ----------
        points : (n, 3) float64
            Node positions of the boundary.
        indices : (k,) int64, optional
            Samples of the surface to be examined; all by default.
        limit : float or (k,) float64
            In the mesh's unit; one for all samples, or one for each.

        Returns
        -------
        Deviations
        """
        initial, nodes, weights = self.initial_surface_deviation
        if indices is None:
            indices = np.arange(len(initial))
        limit = np.broadcast_to(limit, indices.shape)
        moved = np.einsum("sk,ski->si", weights[indices], (points - self._start)[nodes[indices]])
        near = initial[indices] + np.linalg.norm(moved, axis=1) > np.maximum(limit, 0.0)
        indices, limit = indices[near], limit[near]
        if not indices.size:
            return Deviations(indices, np.empty(0), np.empty((0, 3)), nodes[indices], weights[indices])
        x = self._samples[indices]
        enough = max(float(limit.min(initial=np.inf)), 0.0)
        closest, nodes, weights = self.skin.with_points(points).closest_on(x, enough)
        distances, directions = _distance_and_direction(x, closest)
        out = distances > limit
        return Deviations(indices[out], distances[out], directions[out], nodes[out], weights[out])

    def outside_band(self, points: np.ndarray) -> np.ndarray:
        """Find nodes at which the boundary is outside the band and further from the surface than at first.

        Where a sample of the surface is too far from the boundary, these are the nodes of the face closest to it now
        and of the face closest to it at first.

        Parameters
        ----------
        points : (n, 3) float64
            Node positions.

        Returns
        -------
        (k,) int
            Numbers of nodes, ascending.
        """
        if not np.isfinite(self.tolerance):
            return NO_NODES
        initial, nodes, _ = self.initial_surface_deviation
        boundary_limit = self._allowed(self._initial_boundary_deviation)
        boundary = self.boundary_deviation(points, np.arange(len(self.midpoints)), boundary_limit)
        surface = self.surface_deviation(points, limit=self._allowed(initial))
        return np.unique(np.concatenate([x.ravel() for x in (boundary.nodes, surface.nodes, nodes[surface.indices])]))

    def _allowed(self, initial: np.ndarray) -> np.ndarray:
        return np.maximum(initial, self.tolerance) * (1 + _ROUNDING)

    @cached_property
    def _samples(self) -> np.ndarray:
        return self._start[self.midpoints].mean(axis=1) if self._given is None else self._given.samples()

    @cached_property
    def _initial_boundary_deviation(self) -> np.ndarray:
        """Distance of `midpoints` from the surface before sliding, (s,)."""
        if self._given is None:
            return np.zeros(len(self.midpoints))
        return self.target.distances(self._start[self.midpoints].mean(axis=1))

    @cached_property
    def initial_surface_deviation(self) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Distance of the surface's samples from the boundary before sliding, (s,), with what is closest to them.

        The latter is given by boundary nodes, (s, 4) int, and their weights, (s, 4).
        """
        if self._given is None:
            return np.zeros(len(self.midpoints)), self.midpoints, np.full(self.midpoints.shape, 0.25)
        x = self._samples
        closest, nodes, weights = self.skin.with_points(self._start).closest_on(x)
        return np.linalg.norm(x - closest, axis=1), nodes, weights


def _distance_and_direction(x: np.ndarray, closest: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Distances (k,) of x (k, 3) from the closest points (k, 3), and unit vectors from these to x (k, 3)."""
    difference = x - closest
    distances = np.linalg.norm(difference, axis=1)
    return distances, difference / np.maximum(distances, np.finfo(float).tiny)[:, None]
