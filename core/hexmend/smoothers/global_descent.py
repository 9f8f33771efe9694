"""What the global methods share: Algorithm 3.3, all free nodes at once."""

from __future__ import annotations

from abc import abstractmethod
from dataclasses import dataclass

from hexmend.energy import POLICIES, MeshEnergy, SlidingEnergy
from hexmend.mesh import Mesh
from hexmend.optimise import Outcome, Step
from hexmend.optimise.descent import descend
from hexmend.optimise.direction import Direction
from hexmend.optimise.line_search import BackLineSearch
from hexmend.parameters import parameter
from hexmend.quality import measure
from hexmend.smoothers.sliding_smoother import SlidingSmoother
from hexmend.smoothers.smoother import Steps


@dataclass(frozen=True)
class GlobalDescent(SlidingSmoother):
    """A search direction for all free nodes, a line search along it, and so on; a method names the direction."""

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
    first_step: float = parameter(1.0, low=1e-6, high=1e6, help="First trial step α of the line search (A.5).")
    shrink: float = parameter(0.7, low=0.01, high=0.99, help="Factor λ by which the line search cuts a step (A.5).")
    c1: float = parameter(1e-4, low=0, high=0.5, help="Share c₁ of the slope that a step must descend (Armijo, A.5).")
    max_cuts: int = parameter(100, low=1, high=500, help="Cuts of a step after which the method gives up.")

    @abstractmethod
    def direction(self) -> Direction:
        """The search direction: Algorithm A.2, A.3 or A.4."""

    def steps(self, mesh: Mesh) -> Steps:
        sliding, policy = self.sliding(mesh), POLICIES[self.delta_policy](self.delta)
        energy = MeshEnergy(mesh, self.p) if sliding is None else SlidingEnergy(sliding, self.p)
        search = BackLineSearch(self.first_step, self.shrink, self.c1, self.max_cuts)
        find = self.direction()
        points = energy.mesh.points
        x = energy.scaled(points)
        yield Step(points)
        while True:
            delta = policy.at(measure(points, mesh.hexes), energy.unit)  # zero in the feasible region, 3.2.4
            taken = descend(energy, x, delta, find, search)
            if taken is None:  # inverted, and delta is zero
                return Outcome.NO_DESCENT
            if taken.alpha == 0 and taken.slope < 0:
                return Outcome.NO_DESCENT
            x = taken.x
            points = energy.placed(x)
            yield Step(points, taken.notes(delta))
