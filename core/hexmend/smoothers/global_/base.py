"""Base of the global methods: Algorithm 3.3, all free nodes at once."""

from __future__ import annotations

from abc import abstractmethod
from dataclasses import dataclass

from hexmend.energy import POLICIES, DeltaPolicy, MeshEnergy, SlidingEnergy
from hexmend.iteration import Outcome, Step
from hexmend.kernels.line_search import LineSearch
from hexmend.mesh.mesh import Mesh
from hexmend.optimise.descent import descend
from hexmend.optimise.search_direction import Direction
from hexmend.parameters import parameter
from hexmend.quality import measure
from hexmend.smoothers.base import Steps
from hexmend.smoothers.base_optimiser import Optimiser


@dataclass(frozen=True)
class GlobalDescent(Optimiser):
    """Search direction for all free nodes and a line search along it, repeated; a method chooses the direction."""

    delta_unit: str = parameter(
        "edge",
        choices=("edge", "mesh"),
        help="Unit of length for delta: the mean edge length of the mesh, or the unit of its points (Table 4.3).",
    )
    initial_step: float = parameter(1.0, low=1e-6, high=1e6, help="First trial step α of the line search (A.5).")
    backtrack_factor: float = parameter(
        0.7, low=0.01, high=0.99, help="Factor λ by which a rejected step is shortened (A.5)."
    )
    c1: float = parameter(1e-4, low=0, high=0.5, help="Share c₁ of the slope that a step must descend (Armijo, A.5).")
    max_backtracks: int = parameter(100, low=1, high=500, help="Backtracks of a step after which the method gives up.")

    @property
    def line_search(self) -> LineSearch:
        """The line search with the method's parameters."""
        return LineSearch(self.initial_step, self.backtrack_factor, self.c1, self.max_backtracks)

    @abstractmethod
    def direction(self) -> Direction:
        """The search direction: Algorithm A.2, A.3 or A.4."""

    def policy(self, energy: MeshEnergy) -> DeltaPolicy:
        """Policy of delta, in the energy's unit of length."""
        return POLICIES[self.delta_policy](self.delta / (1.0 if self.delta_unit == "edge" else energy.unit**3))

    def steps(self, mesh: Mesh) -> Steps:
        sliding = self.sliding(mesh)
        energy = MeshEnergy(mesh, self.power) if sliding is None else SlidingEnergy(sliding, self.power)
        find, policy, search = self.direction(), self.policy(energy), self.line_search
        points = energy.mesh.points
        x = energy.to_edge_units(points)
        yield Step(points)
        while True:
            delta = policy.at(measure(points, mesh.hexes), energy.unit)  # zero in the feasible region, 3.2.4
            taken = descend(energy, x, delta, find, search)
            if taken is None:  # inverted, and delta is zero
                return Outcome.NO_DESCENT
            if taken.alpha == 0 and taken.slope < 0:
                return Outcome.NO_DESCENT
            x = taken.x
            points = energy.to_mesh_units(x)
            yield Step(points, taken.diagnostics(delta))
