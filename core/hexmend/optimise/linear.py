"""Linear solvers for H p = -g with a symmetric H."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

import numpy as np

from hexmend.energy import Hessian
from hexmend.optimise.blas import one_blas_thread

Vector = np.ndarray


class LinearSolver(Protocol):
    """Solves H x = b."""

    def __call__(self, hessian: Hessian, right: Vector) -> tuple[Vector, int]:
        """Solution (3 k,), as good as the solver got it, and the number of iterations."""


@dataclass(frozen=True)
class Minres:
    """Minimum residuals without a preconditioner, as in the thesis (4.1.2); takes indefinite matrices.

    Parameters
    ----------
    tolerance : float
        Of the residual, relative to the right-hand side.
    iterations : int
        Limit, after which the solution so far is taken as it is.
    precision : type
        Of the matrix.
    """

    tolerance: float = 1e-6
    iterations: int = 1000
    precision: type = np.float32

    def __post_init__(self):
        import scipy.sparse.linalg  # noqa: F401  (now, while nobody's clock runs)

    def __call__(self, hessian: Hessian, right: Vector) -> tuple[Vector, int]:
        from scipy.sparse.linalg import minres

        count = 0

        def tick(_: Vector) -> None:
            nonlocal count
            count += 1

        matrix = hessian.assembled(self.precision)
        with one_blas_thread():
            solution, _ = minres(matrix, right, rtol=self.tolerance, maxiter=self.iterations, callback=tick)
        return solution, count


@dataclass(frozen=True)
class ConjugateGradients:
    """Conjugate gradients, preconditioned by symmetric Gauss-Seidel, that end at a direction of negative curvature
    (Steihaug 1983).

    Parameters
    ----------
    tolerance : float
        Of the residual, relative to the right-hand side, both in the norm of the preconditioner.
    iterations : int
        As for `Minres`.
    precision : type
        Of matrix and vectors: single precision is twice as fast, and enough for a direction.
    """

    tolerance: float = 1e-6
    iterations: int = 1000
    precision: type = np.float32

    def __call__(self, hessian: Hessian, right: Vector) -> tuple[Vector, int]:
        solved = hessian.assembled(self.precision).solve(right, self.tolerance, self.iterations)
        return solved.x, solved.iterations
