"""Steps of sequential linear programming, and the corners at which it ends."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from hexmend.iteration import Step


@dataclass(frozen=True, eq=False)
class MaxMinStep:
    """Accepted step of the algorithm.

    Parameters
    ----------
    points : (n, 3) float64
    least : float
        The least value of the corners that can be moved, in the mesh's unit.
    corners : int
        Number of corners whose nodes moved.
    radius : float
        Of the trust region, in lengths of the shortest edge at each node.
    """

    points: np.ndarray
    least: float
    corners: int
    radius: float

    def step(self, infeasible: bool) -> Step:
        """Convert it to a step of a smoother; see `Step.infeasible`."""
        diagnostics = {"least": self.least, "corners": self.corners, "radius": self.radius}
        return Step(self.points, diagnostics, intermediate=True, infeasible=infeasible)


@dataclass(frozen=True, eq=False)
class ActiveCorners:
    """Corners that let the least rise no further.

    Parameters
    ----------
    least : float
        The least value of the corners that can be moved.
    hexes, corners : (k,) int64
        Hex and corner (0 to 7) of each, by descending multiplier. Raising one lowers others of its connected group.
    """

    least: float
    hexes: np.ndarray
    corners: np.ndarray
