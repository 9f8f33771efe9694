"""What the local optimisers share: the energy of a patch, and the line search on it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from hexmend.energy import POLICIES
from hexmend.mesh import Mesh
from hexmend.parameters import parameter
from hexmend.quality import measure
from hexmend.smoothers.sliding_smoother import SlidingSmoother


@dataclass(frozen=True)
class LocalOptimiser(SlidingSmoother):
    """Line-searched steps for the energy of one patch after another, each scaled to unit mean edge length."""

    optimises = True

    p: float = parameter(
        2.0, low=1, high=32, help="Exponent of the objective (3.3): the higher, the more the worst hexes count."
    )
    delta: float = parameter(
        0.01,
        low=0,
        high=10,
        unit="mean edge length³",
        help="Softness of the barrier (3.2) while any hex is inverted; then zero. Large values move the optimum.",
    )
    delta_policy: str = parameter(
        "fixed",
        choices=tuple(POLICIES),
        help="fixed: delta as given; adaptive: as large as the worst hex asks, falling to delta as it recovers.",
    )
    first_step: float = parameter(1.0, low=1e-6, high=1e3, help="First trial step α of the line search (A.5).")
    shrink: float = parameter(0.7, low=0.01, high=0.99, help="Factor λ by which the line search cuts a step (A.5).")
    c1: float = parameter(1e-4, low=0, high=0.5, help="Share c₁ of the slope that a step must descend (Armijo, A.5).")
    max_cuts: int = parameter(100, low=1, high=200, help="Cuts of a step after which the node is left where it is.")

    def delta_at(self, mesh: Mesh, points: np.ndarray) -> float:
        """delta of a sweep that begins with the nodes at points (n, 3): zero in the feasible region, 3.2.4."""
        return POLICIES[self.delta_policy](self.delta).at(measure(points, mesh.hexes), mesh.mean_edge_length or 1.0)
