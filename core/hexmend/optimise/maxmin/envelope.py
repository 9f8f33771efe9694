"""The envelope of the surface in which a boundary stays as it is moved, and which of its nodes are on the surface."""

from __future__ import annotations

import numpy as np

from hexmend.boundary import Deviations, SlidingBoundary
from hexmend.optimise.maxmin.deviation import DeviationTracker
from hexmend.optimise.maxmin.linear_program import LinearConstraints, no_constraints


class Envelope:
    """Where the boundary of a mesh may go: its nodes slide, or are lifted off the surface but stay in the room around.

    Parameters
    ----------
    n_nodes : int
    sliding : SlidingBoundary, optional
        Without it the boundary is fixed, and nothing is bounded here.

    Attributes
    ----------
    sliding : SlidingBoundary or None
    room : float
        How far boundary and surface may be from each other, in the mesh's unit.
    released : (n,) bool
        Nodes of the boundary that need not stay on the surface.
    flips_allowed : bool
        Whether quads at these may be turned over; else no step does that.
    """

    def __init__(self, n_nodes: int, sliding: SlidingBoundary | None):
        self.sliding = sliding
        self.room = np.inf if sliding is None else sliding.room
        self.released = np.zeros(n_nodes, dtype=bool)
        self.flips_allowed = False
        self._tracker: DeviationTracker | None = None

    def slides(self, nodes: np.ndarray) -> np.ndarray:
        """Which of some nodes (k,) are put back on the surface wherever they are moved to, (k,) bool."""
        if self.sliding is None:
            return np.zeros(nodes.size, dtype=bool)
        return self.sliding.slides(nodes) & ~self.released[nodes]

    def project(self, before: np.ndarray, points: np.ndarray, nodes: np.ndarray) -> np.ndarray:
        """The points (n, 3) after a step of some nodes (k,) from `before`: put back, and no quad turned over.

        `points` is changed.
        """
        if self.sliding is None:
            return points
        slide = nodes[self.slides(nodes)]
        if slide.size:
            points[slide] = self.sliding.put_back(points[slide], slide)
        # Off the surface its normals say little.
        return self.sliding.unturned(before, points, self.released if self.flips_allowed else None)

    def bounds(self, points: np.ndarray, moves: np.ndarray) -> LinearConstraints:
        """What keeps the boundary in its room as nodes go from points (n, 3) no further than moves (n,) each."""
        if not self._bounded:
            return no_constraints()
        return self._track(points).bounds(moves, self.room)

    def leaves_band(self, before: np.ndarray, points: np.ndarray, nodes: np.ndarray) -> bool:
        """Whether the boundary has left its room, further than it was, as nodes (k,) went from `before` to points."""
        if not self._bounded:
            return False
        apart = self._track(before)
        after = apart.after_move(points, nodes)
        if after.exceeds(apart, nodes, self.room):
            return True
        self._tracker = after
        return False

    def track(self, before: np.ndarray, points: np.ndarray, nodes: np.ndarray) -> None:
        """Know that nodes (k,) have gone from `before` to points, both (n, 3): quicker than to look at all anew."""
        self._tracker = self._track(before).after_move(points, nodes)

    def largest_deviation(self, points: np.ndarray) -> float:
        """The largest distance of the boundary, nodes being at points (n, 3), and the surface, both ways."""
        if self.sliding is None:
            return 0.0
        return max(float(off.far.max(initial=0.0)) for off in self._deviations(points, 0.0))

    def infeasible_nodes(self, points: np.ndarray) -> np.ndarray:
        """Nodes where the boundary, at points (n, 3), is out of its room, ascending, (k,) int."""
        return np.unique(np.concatenate([off.nodes for off in self._deviations(points, self.room)]))

    @property
    def _bounded(self) -> bool:
        return self.sliding is not None and bool(np.isfinite(self.room))

    def _deviations(self, points: np.ndarray, room: float) -> tuple[Deviations, Deviations]:
        """Where the boundary is further than that from the surface, and the surface from the boundary."""
        sliding = self.sliding
        return sliding.off(points, np.arange(len(sliding.middles)), room), sliding.behind(points, room=room)

    def _track(self, points: np.ndarray) -> DeviationTracker:
        if self._tracker is None or self._tracker.points is not points:
            self._tracker = DeviationTracker(self.sliding, points)
        return self._tracker
