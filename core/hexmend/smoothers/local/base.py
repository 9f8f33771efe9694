"""Base of the local optimisers: the energy of a patch, and the line search on it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from hexmend.energy import POLICIES
from hexmend.kernels.line_search import LineSearch
from hexmend.mesh.mesh import Mesh
from hexmend.parameters import parameter
from hexmend.quality import measure
from hexmend.smoothers.base_optimiser import Optimiser

#: Units of delta in mean edge lengths: a patch of eight hexes is two wide.
EDGES = {"edge": 1.0, "extent": 2.0}


@dataclass(frozen=True)
class LocalOptimiser(Optimiser):
    """Steps with line search on the energy of one patch after another, each scaled to unit mean edge length."""

    delta_unit: str = parameter(
        "edge",
        choices=tuple(EDGES),
        help="Unit of length for delta: the patch's mean edge length, or its extent of two edges (Table 4.4).",
    )
    initial_step: float = parameter(1.0, low=1e-6, high=1e3, help="First trial step α of the line search (A.5).")
    backtrack_factor: float = parameter(
        0.7, low=0.01, high=0.99, help="Factor λ by which a rejected step is shortened (A.5)."
    )
    c1: float = parameter(1e-4, low=0, high=0.5, help="Share c₁ of the slope that a step must descend (Armijo, A.5).")
    max_backtracks: int = parameter(
        100, low=1, high=200, help="Backtracks of a step after which the node is left where it is."
    )

    @property
    def line_search(self) -> LineSearch:
        """The line search with the method's parameters."""
        return LineSearch(self.initial_step, self.backtrack_factor, self.c1, self.max_backtracks)

    def delta_at(self, mesh: Mesh, points: np.ndarray) -> float:
        """delta of a sweep that begins with the nodes at points (n, 3): zero in the feasible region, 3.2.4."""
        return POLICIES[self.delta_policy](self.delta * EDGES[self.delta_unit] ** 3).at(
            measure(points, mesh.hexes), mesh.mean_edge_length or 1.0
        )
