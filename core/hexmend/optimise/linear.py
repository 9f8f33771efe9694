"""Linear solvers for H p = -g with a symmetric H that is known as a product."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Protocol

import numpy as np
import scipy.sparse.linalg

from hexmend.energy import Hessian
from hexmend.kernels import precondition as kernels

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
    """

    tolerance: float = 1e-6
    iterations: int = 1000

    def __call__(self, hessian: Hessian, right: Vector) -> tuple[Vector, int]:
        count = 0

        def tick(_: Vector) -> None:
            nonlocal count
            count += 1

        solution, _ = scipy.sparse.linalg.minres(
            hessian, right, rtol=self.tolerance, maxiter=self.iterations, callback=tick
        )
        return solution, count


@dataclass(frozen=True)
class ConjugateGradients:
    """Conjugate gradients, preconditioned by the diagonal blocks, that end at a direction of negative curvature
    (Steihaug 1983).

    What has been reached before such a direction is returned, or, if it is the first, the preconditioned right-hand
    side: a direction of descent either way.

    Parameters
    ----------
    tolerance : float
        Of the residual, relative to the right-hand side, both in the norm of the preconditioner.
    iterations : int
        As for `Minres`.
    """

    tolerance: float = 1e-6
    iterations: int = 1000

    def __call__(self, hessian: Hessian, right: Vector) -> tuple[Vector, int]:
        precondition = block_jacobi(hessian.diagonal_blocks())
        x, r = np.zeros_like(right), right.copy()
        z = precondition(r)
        d, rz = z.copy(), float(r @ z)
        goal = self.tolerance**2 * rz
        for count in range(1, self.iterations + 1):
            hd = hessian @ d
            curvature = float(d @ hd)
            if not curvature > 0:
                return (x, count) if count > 1 else (d, count)
            alpha = rz / curvature
            x += alpha * d
            r -= alpha * hd
            z = precondition(r)
            rz, before = float(r @ z), rz
            if rz <= goal:
                return x, count
            d *= rz / before
            d += z
        return x, self.iterations


def block_jacobi(blocks: np.ndarray) -> Callable[[Vector], Vector]:
    """Preconditioner from the diagonal blocks (k, 6), each made positive definite as Algorithm A.4 does."""
    inverse = np.empty_like(blocks)
    kernels.invert_blocks(blocks, inverse)

    def apply(r: Vector) -> Vector:
        z = np.empty_like(r)
        kernels.apply_blocks(inverse, r.reshape(-1, 3), z.reshape(-1, 3))
        return z

    return apply
