"""Search directions for all free nodes at once: Algorithms A.2, A.3, A.4."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

import numpy as np
from scipy.sparse.linalg import ArpackNoConvergence, LinearOperator, eigsh

from hexmend.energy import Hessian
from hexmend.optimise.linear import ConjugateGradients, LinearSolver


@dataclass(frozen=True)
class Found:
    """A search direction.

    Parameters
    ----------
    p : (k, 3) float64
    solver_iterations : int
        Of the linear solver; 0 where there is none.
    shift : float
        What was added to the diagonal of the Hessian.
    """

    p: np.ndarray
    solver_iterations: int = 0
    shift: float = 0.0


class Direction(Protocol):
    """Finds a search direction for sum eta^p."""

    def __call__(self, value: float, gradient: np.ndarray, hessian: Hessian) -> Found:
        """Search direction at a point of this value, gradient (k, 3) and Hessian."""


def steepest_descent(value: float, gradient: np.ndarray, hessian: Hessian) -> Found:
    """Algorithm A.2: p_k = -grad f of (3.3), f being the p-th root of the sum."""
    p = hessian.energy.p
    return Found(-(value ** (1 / p - 1) / p) * gradient)  # (C.2)


@dataclass(frozen=True)
class Newton:
    """Algorithm A.3: solve H p_k = -grad f."""

    solver: LinearSolver

    def __call__(self, value: float, gradient: np.ndarray, hessian: Hessian) -> Found:
        p, count = self.solver(hessian, -gradient.ravel())
        return Found(p.reshape(-1, 3), count, hessian.shift)


@dataclass(frozen=True)
class TruncatedNewton:
    """Newton's direction, only as good as the distance from the optimum deserves (Dembo and Steihaug 1983).

    The tolerance of the residual follows the gradient between two bounds: products with the Hessian that would make the
    direction better than the quadratic model is good are saved.

    Parameters
    ----------
    loosest, tightest : float
        Tolerance far from the optimum and near it, in (0, 1).
    iterations : int
        Most products with the Hessian.
    """

    loosest: float = 0.2
    tightest: float = 0.05
    iterations: int = 200

    def __call__(self, value: float, gradient: np.ndarray, hessian: Hessian) -> Found:
        share = np.sqrt(np.linalg.norm(gradient) / max(value, np.finfo(float).tiny))
        tolerance = float(np.clip(share, self.tightest, self.loosest))
        return Newton(ConjugateGradients(tolerance, self.iterations))(value, gradient, hessian)


@dataclass(frozen=True)
class ModifiedNewton:
    """Algorithm A.4: the same after the least eigenvalue is raised to a thousandth of the greatest."""

    solver: LinearSolver

    def __call__(self, value: float, gradient: np.ndarray, hessian: Hessian) -> Found:
        least, greatest = extreme_eigenvalues(hessian)
        if least < 0.001 * greatest:
            hessian = hessian.shifted(0.001 * greatest - least)
        return Newton(self.solver)(value, gradient, hessian)


def full(blocks: np.ndarray) -> np.ndarray:
    """Symmetric blocks (k, 6) as matrices (k, 3, 3)."""
    return blocks[:, [0, 1, 2, 1, 3, 4, 2, 4, 5]].reshape(-1, 3, 3)


def extreme_eigenvalues(hessian: Hessian) -> tuple[float, float]:
    """Least and greatest eigenvalue by Lanczos's method, good to a thousandth of their distance.

    The least is found as the greatest of lambda_max I - H, where it stands apart; where that does not converge in 50
    iterations it is taken to be zero (A.2).
    """
    start = np.ones(hessian.shape[0])  # ARPACK's own would be random

    def top(operator: LinearOperator) -> float | None:
        try:
            return float(eigsh(operator, k=1, which="LA", maxiter=50, tol=1e-3, v0=start, return_eigenvectors=False)[0])
        except ArpackNoConvergence:
            return None

    greatest = top(hessian)
    if greatest is None:
        return 0.0, float(np.linalg.eigvalsh(full(hessian.diagonal_blocks())).max())
    distance = top(LinearOperator(hessian.shape, matvec=lambda v: greatest * v - hessian @ v, dtype=np.float64))
    return (0.0 if distance is None else greatest - distance), greatest
