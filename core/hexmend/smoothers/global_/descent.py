"""Bases of the global methods, Algorithm 3.3: all free nodes at once, and the linear system of Newton's methods."""

from __future__ import annotations

from abc import abstractmethod
from dataclasses import dataclass

import numpy as np

from hexmend.energy import MeshEnergy
from hexmend.iteration import Outcome, Step
from hexmend.kernels.line_search import LineSearch
from hexmend.mesh.mesh import Mesh
from hexmend.optimise.descent import descend
from hexmend.optimise.linear_solvers import ConjugateGradients, LinearSolver, Minres
from hexmend.optimise.search_direction import DirectionMethod
from hexmend.parameters import parameter
from hexmend.quality import measure
from hexmend.smoothers.base import Steps
from hexmend.smoothers.base_optimiser import Optimiser


class GlobalDescent(Optimiser):
    """Search direction for all free nodes and a line search along it, repeated; a method chooses the direction."""

    keeps_linear_motion = True

    @abstractmethod
    def direction(self) -> DirectionMethod:
        """The search direction: Algorithm A.2, A.3 or A.4."""

    def softening(self, energy: MeshEnergy) -> float:
        """The parameter delta in the energy's unit of length."""
        return self.delta / (1.0 if self.delta_unit == "edge" else energy.unit**3)

    def delta_at(self, energy: MeshEnergy, points: np.ndarray) -> float:
        """delta of a step from points (n, 3): zero in the feasible region, 3.2.4."""
        return self.softening(energy) if measure(points, energy.mesh.elements).n_inverted else 0.0

    def search(self, energy: MeshEnergy) -> LineSearch:
        """Line search along directions in the energy's unit of length."""
        return self.line_search

    def steps(self, mesh: Mesh) -> Steps:
        if mesh.linear_motion is not None:
            mesh = mesh.with_points(mesh.constrained(mesh.points))
        sliding = self.sliding(mesh)
        energy = MeshEnergy(mesh, self.norm) if sliding is None else MeshEnergy.on_surface(sliding, self.norm)
        find, search = self.direction(), self.search(energy)
        points = energy.mesh.points
        x, quads = energy.to_edge_units(points), self.surface_quads(sliding)
        yield Step(points, surface=quads and quads.objective(points))
        while True:
            delta = self.delta_at(energy, points)
            if quads is not None:
                energy = energy.with_surface(quads.at(points, delta, self.softening(energy)))
            taken = descend(energy, x, delta, find, search)
            if taken is None or (taken.alpha == 0 and taken.slope < 0):  # None: inverted, and delta is zero
                return Outcome.NO_DESCENT
            x = taken.x
            points = energy.to_mesh_units(x)
            yield Step(points, taken.diagnostics(delta), surface=quads and quads.objective(points))


SOLVERS = {"minres": Minres, "cg": ConjugateGradients}


@dataclass(frozen=True)
class GlobalNewton(GlobalDescent):
    """Newton's direction for all free nodes; a method chooses the treatment of the Hessian."""

    bytes_per_hex = 2700

    solver: str = parameter(
        "minres",
        choices=tuple(SOLVERS),
        help="Linear solver: minimum residuals as in the thesis, or preconditioned conjugate gradients, faster.",
        advanced=True,
    )
    solver_tolerance: float = parameter(
        1e-6,
        low=1e-14,
        high=0.9,
        help="Residual at which the linear solver ends, relative to the gradient.",
        advanced=True,
    )
    solver_iterations: int = parameter(
        1000,
        low=1,
        high=10**6,
        help="Most iterations of the linear solver; then its direction is taken as it is.",
        advanced=True,
    )

    def linear_solver(self) -> LinearSolver:
        """The solver with the method's parameters."""
        return SOLVERS[self.solver](self.solver_tolerance, self.solver_iterations)
