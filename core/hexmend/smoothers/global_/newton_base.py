"""Base of the global Newton methods: the linear system and its solvers."""

from __future__ import annotations

from dataclasses import dataclass

from hexmend.optimise.linear_solvers import ConjugateGradients, LinearSolver, Minres
from hexmend.parameters import parameter
from hexmend.smoothers.global_.base import GlobalDescent

SOLVERS = {"minres": Minres, "cg": ConjugateGradients}


@dataclass(frozen=True)
class GlobalNewton(GlobalDescent):
    """Newton's direction for all free nodes; a method chooses the treatment of the Hessian."""

    bytes_per_hex = 3000

    solver: str = parameter(
        "minres",
        choices=tuple(SOLVERS),
        help="Linear solver: minimum residuals as in the thesis, or preconditioned conjugate gradients, faster.",
    )
    solver_tolerance: float = parameter(
        1e-6, low=1e-14, high=0.9, help="Residual at which the linear solver ends, relative to the gradient."
    )
    solver_iterations: int = parameter(
        1000, low=1, high=10**6, help="Most iterations of the linear solver; then its direction is taken as it is."
    )

    def linear_solver(self) -> LinearSolver:
        """The solver with the method's parameters."""
        return SOLVERS[self.solver](self.solver_tolerance, self.solver_iterations)
