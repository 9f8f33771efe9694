"""Newton steps of all free nodes at once, used by untangling and by the optimum of shape."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from hexmend.energy import MeshEnergy
from hexmend.kernels.line_search import LineSearch
from hexmend.optimise.descent import Descent, descend
from hexmend.optimise.search_direction import TruncatedNewton, TruncatedNewtonConfig

SEARCH = LineSearch(backtrack_factor=0.5)


@dataclass(frozen=True)
class NewtonConfig:
    """Settings of the Newton steps.

    Parameters
    ----------
    solver_iterations : int
        Most iterations of conjugate gradients for a direction.
    max_step : float
        How far a step may take a node, in mean lengths of the node's edges.
    deflated : bool
        Solve for translations of aggregates of nodes exactly: near an optimum a step moves large regions of a mesh.
    """

    solver_iterations: int = TruncatedNewtonConfig.iterations
    max_step: float = 1.0
    deflated: bool = False

    def direction(self) -> TruncatedNewton:
        """Make the direction for one sequence of steps; it adapts from step to step."""
        config = TruncatedNewtonConfig(self.solver_iterations, deflated=self.deflated, definite=False)
        return TruncatedNewton(config)

    def step(self, energy: MeshEnergy, x: np.ndarray, delta: float, direction: TruncatedNewton) -> Descent | None:
        """Take a step from x (n, 3), in mean edge lengths; None where the energy is infinite there."""
        return descend(energy, x, delta, direction, SEARCH, self.max_step)


NEWTON = NewtonConfig()
