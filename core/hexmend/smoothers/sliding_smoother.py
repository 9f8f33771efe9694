"""What methods share whose boundary nodes stay, or slide on the surface, as they are told: 5.2.1."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TypeVar

import numpy as np

from hexmend.boundary import SlidingBoundary
from hexmend.mesh.mesh import Mesh
from hexmend.parameters import parameter
from hexmend.smoothers.base import Smoother

T = TypeVar("T")

#: The word for a surface tolerance that sets no limit: nodes slide, wherever the boundary between them goes.
UNLIMITED = "unlimited"

#: Sweeps in which a node would leave the room around the surface before it is not tried any more.
PATIENCE = 3


@dataclass(frozen=True)
class SlidingSmoother(Smoother):
    """A method that may let the nodes of the boundary slide on the surface, which they never leave."""

    boundary: str = parameter(
        "fixed", choices=("fixed", "slide"), help="Whether nodes of the boundary stay, or slide on the surface (5.2.1)."
    )
    feature_angle: float = parameter(
        40.0, low=1, high=180, unit="degrees", help="Along edges at which the boundary turns by more nodes only slide."
    )

    surface_tolerance: float = parameter(
        0.3,
        low=0,
        high=10,
        unit="mean edge length",
        help="How far the boundary may leave the surface: 0 keeps it there, so that nodes slide where it is flat "
        "alone; unlimited sets no limit to what sliding nodes leave between them.",
        no_limit=UNLIMITED,
    )

    @property
    def slides(self) -> bool:
        return self.boundary == "slide"

    def movable(self, mesh: Mesh) -> np.ndarray:
        sliding = self.sliding(mesh)
        return mesh.free if sliding is None else sliding.mesh.free

    def sliding(self, mesh: Mesh) -> SlidingBoundary | None:
        """What the nodes of a mesh's boundary slide on; None where they stay."""
        if not self.slides:
            return None
        return SlidingBoundary(mesh, self.feature_angle, self.max_deviation(mesh))

    def max_deviation(self, mesh: Mesh) -> float:
        """How far the boundary may leave the surface, in the mesh's unit of length."""
        return np.inf if self.surface_tolerance == UNLIMITED else self.surface_tolerance * mesh.mean_edge_length


class Sweeps:
    """Sweeps that move node after node, each sweep without the nodes that would leave the room around the surface.

    Where a sweep has left the room, it is made again with the nodes staying at which it did. A node that had to stay in
    `PATIENCE` sweeps stays for good.

    Parameters
    ----------
    sliding : SlidingBoundary or None
        None where the boundary stays: a sweep is a sweep.
    n : int
        Number of nodes.
    """

    def __init__(self, sliding: SlidingBoundary | None, n: int):
        self.sliding, self._often = sliding, np.zeros(n, dtype=np.int64)

    def __call__(self, points: np.ndarray, sweep: Callable[[np.ndarray, np.ndarray], T]) -> tuple[np.ndarray, T]:
        """The points after a sweep from points (n, 3), and what it returned.

        Parameters
        ----------
        points : (n, 3) float64
            Stay as they are.
        sweep : callable
            Takes points that it moves, and which nodes have to stay, (n,) bool.
        """
        stays = self._often >= PATIENCE
        while True:
            moved = points.copy()
            told = sweep(moved, stays)
            beyond = np.empty(0, dtype=np.int64) if self.sliding is None else self.sliding.outside_band(moved)
            beyond = beyond[(moved[beyond] != points[beyond]).any(axis=1)]
            if not beyond.size:
                return moved, told
            stays = stays.copy()
            stays[beyond] = True
            self._often[beyond] += 1
