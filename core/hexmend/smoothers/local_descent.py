"""What the local methods share: Algorithm 3.2, node after node."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from hexmend.energy import POLICIES
from hexmend.kernels import local
from hexmend.mesh import Mesh
from hexmend.optimise import Step
from hexmend.parameters import parameter
from hexmend.quality import measure
from hexmend.smoothers.smoother import Smoother, Steps


@dataclass(frozen=True)
class LocalDescent(Smoother):
    """One line-searched step per free node, sweep after sweep, on the node's patch scaled to unit mean edge length."""

    optimises = True
    #: Search direction, one of `hexmend.kernels.local`.
    direction: ClassVar[int]

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

    def steps(self, mesh: Mesh) -> Steps:
        corners = mesh.topology.node_corners
        colours = mesh.topology.colouring(mesh.free)
        points = mesh.points
        yield Step(points)
        while True:
            delta = self.delta_at(mesh, points)
            points = points.copy()
            local.sweep(
                points,
                mesh.hexes,
                corners.start,
                corners.items,
                colours.start,
                colours.items,
                self.direction,
                delta,
                self.p,
                self.first_step,
                self.shrink,
                self.c1,
                self.max_cuts,
            )
            yield Step(points, {"delta": delta})
