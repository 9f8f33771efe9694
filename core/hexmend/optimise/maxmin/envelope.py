"""Envelope of a surface: the band around it in which a boundary stays, and the nodes that slide on it."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

import numpy as np

from hexmend.boundary import Deviations, SlidingBoundary
from hexmend.optimise.maxmin.deviation import DeviationTracker
from hexmend.optimise.maxmin.linear_program import LinearConstraints, no_constraints


class Envelope:
    """Admissible places of a boundary: its nodes slide on the surface, or are released from it and stay in its band.

    Parameters
    ----------
    n_nodes : int
    sliding : SlidingBoundary, optional
        None where the boundary is fixed: then nothing is constrained here.

    Attributes
    ----------
    sliding : SlidingBoundary or None
    max_deviation : float
        Distance of boundary and surface in the band, in the mesh's unit of length.
    released : (n,) bool
        Nodes of the boundary that have left their corner, curve or patch.
    off_surface : (n,) bool
        Those of them that may leave the surface.
    flips_allowed : bool
        Steps may turn quads at released nodes over.
    """

    def __init__(self, n_nodes: int, sliding: SlidingBoundary | None):
        self.sliding = sliding
        self.max_deviation = np.inf if sliding is None else sliding.max_deviation
        self.released = np.zeros(n_nodes, dtype=bool)
        self.off_surface = np.zeros(n_nodes, dtype=bool)
        self.flips_allowed = False
        self._tracker: DeviationTracker | None = None
        self._examined: tuple[np.ndarray, SlidingBoundary, float, tuple[Deviations, Deviations]] | None = None

    def limit_to(self, max_deviation: float) -> None:
        """Set the distance of boundary and surface in the band, in the mesh's unit of length."""
        self.max_deviation = max_deviation

    def release(self, nodes: np.ndarray) -> None:
        """Let nodes (k,) of the boundary leave the surface."""
        self.released[nodes] = self.off_surface[nodes] = True

    def move_onto_patches(self, nodes: np.ndarray) -> None:
        """Let nodes (k,) of curves slide on the patches instead."""
        self.sliding = self.sliding.with_nodes_on_patches(nodes)
        self.released[nodes] = True

    @contextmanager
    def relaxed(self, max_deviation: float) -> Iterator[None]:
        """Context in which the band is as wide as `max_deviation`, if it is not wider, and steps may flip quads."""
        limit, self.flips_allowed = self.max_deviation, True
        self.limit_to(max(max_deviation, limit))
        try:
            yield
        finally:
            self.max_deviation, self.flips_allowed = limit, False

    def slides(self, nodes: np.ndarray) -> np.ndarray:
        """Mark those of some nodes (k,) that slide on the surface and have not left it, (k,) bool."""
        if self.sliding is None:
            return np.zeros(nodes.size, dtype=bool)
        return self.sliding.slides(nodes) & ~self.off_surface[nodes]

    def project(self, before: np.ndarray, points: np.ndarray, nodes: np.ndarray) -> np.ndarray:
        """Project nodes that slide onto the surface, and take moves back that turn a quad over.

        Parameters
        ----------
        before, points : (n, 3) float64
            Points before and after a step; `points` is changed.
        nodes : (k,) int
            The nodes that the step moves.

        Returns
        -------
        (n, 3) float64
        """
        if self.sliding is None:
            return points
        slide = nodes[self.slides(nodes)]
        if slide.size:
            points[slide] = self.sliding.project(points[slide], slide)
        # Away from the surface its normals say little, so that released nodes are not judged by them.
        return self.sliding.reject_flips(before, points, self.released if self.flips_allowed else None)

    def bounds(self, points: np.ndarray, moves: np.ndarray) -> LinearConstraints:
        """Linear constraints that keep the boundary in its band while each node moves by moves (n,) at most."""
        if not self._bounded:
            return no_constraints()
        return self._track(points).bounds(moves, self.max_deviation)

    def leaves_band(self, before: np.ndarray, points: np.ndarray, nodes: np.ndarray) -> bool:
        """Return True if the boundary left its band, or went further outside, as nodes (k,) moved."""
        if not self._bounded:
            return False
        tracker = self._track(before)
        after = tracker.after_move(points, nodes)
        if after.exceeds(tracker, nodes, self.max_deviation):
            return True
        self._tracker = after
        return False

    def track(self, before: np.ndarray, points: np.ndarray, nodes: np.ndarray) -> None:
        """Follow a move of nodes (k,) from `before` to `points`, faster than by finding all distances anew."""
        self._tracker = self._track(before).after_move(points, nodes)

    def largest_deviation(self, points: np.ndarray, above: float = 0.0) -> float:
        """The larger of the distances of the boundary at points (n, 3) from the surface, and of the surface from it.

        0 if that is no larger than `above`, which is found without a search for most places.
        """
        if self.sliding is None:
            return 0.0
        return max(float(places.distances.max(initial=0.0)) for places in self._deviations(points, above))

    def nodes_outside_band(self, points: np.ndarray) -> np.ndarray:
        """Nodes at which the boundary at points (n, 3) is outside its band, ascending, (k,) int."""
        return np.unique(np.concatenate([places.nodes for places in self._deviations(points, self.max_deviation)]))

    @property
    def _bounded(self) -> bool:
        return self.sliding is not None and bool(np.isfinite(self.max_deviation))

    def _deviations(self, points: np.ndarray, limit: float) -> tuple[Deviations, Deviations]:
        """Places of the boundary further than `limit` from the surface, and of the surface from the boundary.

        Those of a lower limit, at the points that were examined last, have them all.
        """
        sliding, known = self.sliding, self._examined
        if known is None or not (known[0] is points and known[1] is sliding and known[2] <= limit):
            midpoints = np.arange(len(sliding.samples))
            found = sliding.boundary_deviation(points, midpoints, limit), sliding.surface_deviation(points, limit=limit)
            self._examined = known = points, sliding, limit, found
        of_boundary, of_surface = known[3]
        return of_boundary.beyond(limit), of_surface.beyond(limit)

    def _track(self, points: np.ndarray) -> DeviationTracker:
        if self._tracker is None or self._tracker.points is not points:
            self._tracker = DeviationTracker(self.sliding, points)
        return self._tracker
