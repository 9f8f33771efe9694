"""Newton steps of all free nodes at once, used by untangling and by the optimum of shape."""

from __future__ import annotations

from dataclasses import dataclass, replace

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
    loosest_definite, damping_decay : float or None, float
        As of `TruncatedNewtonConfig`.
    """

    solver_iterations: int = 200
    max_step: float = 1.5
    deflated: bool = False
    loosest_definite: float | None = None
    damping_decay: float = 4.0

    def direction(self) -> TruncatedNewton:
        """Make the direction for one sequence of steps; it adapts from step to step."""
        config = TruncatedNewtonConfig(
            self.solver_iterations,
            loosest_definite=self.loosest_definite,
            damping_decay=self.damping_decay,
            deflated=self.deflated,
        )
        return TruncatedNewton(config)

    def for_large_mesh(self) -> NewtonConfig:
        """Return the settings for large meshes: their regions move by many edges without a change of their hexes.

        Such a move is a long wave, which a damped matrix shortens, and a limit in edges too. Every step assembles a
        matrix, so that fewer but more accurate steps cost less.
        """
        return replace(self, max_step=8.0, loosest_definite=0.03, damping_decay=16.0)

    def step(self, energy: MeshEnergy, x: np.ndarray, delta: float, direction: TruncatedNewton) -> Descent | None:
        """Take a step from x (n, 3), in mean edge lengths; None where the energy is infinite there."""
        return descend(energy, x, delta, direction, SEARCH, self.max_step)


NEWTON = NewtonConfig()
DEFLATED_NEWTON = NewtonConfig(deflated=True)
