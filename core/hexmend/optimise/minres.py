"""Minimum residuals (Paige and Saunders 1975), ended by the residual relative to the right-hand side."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

import numpy as np

from hexmend.arrays import dot, euclidean_norm

if TYPE_CHECKING:
    pass


def minres(
    product: Callable[[np.ndarray], np.ndarray], right: np.ndarray, tolerance: float, iterations: int
) -> tuple[np.ndarray, int]:
    """Solve A x = b with a symmetric A, which may be indefinite, from x = 0.

    It ends at |b - A x| <= tolerance |b|, as MATLAB's (4.1.2). SciPy's rule compares with |A| |x|: with an
    ill-conditioned matrix it ends much sooner, with a poor direction.

    Parameters
    ----------
    product : callable
        v (n,) -> A v (n,).
    right : (n,) float64
        b.
    tolerance : float
    iterations : int
        Limit, after which the solution so far is returned, as it is where A or b overflow: none in the Krylov space
        has a smaller residual.

    Returns
    -------
    x : (n,) float64
    iterations : int

    Examples
    --------
    >>> matrix = np.diag([3.0, -2.0, 0.5])
    >>> x, count = minres(matrix.__matmul__, np.array([3.0, 2.0, 1.0]), 1e-10, 100)
    >>> x.round(8).tolist(), count
    ([1.0, -1.0, 2.0], 3)
    """
    x, residual = np.zeros(right.size), euclidean_norm(right)
    beta, goal = residual, tolerance * residual
    if residual == 0 or not np.isfinite(residual):
        return x, 0
    last, now = np.zeros(right.size), right / beta  # Lanczos's vectors
    before, direction = np.zeros(right.size), np.zeros(right.size)  # columns of V R^-1
    below = off_diagonal = epsilon = 0.0
    c, s = -1.0, 0.0  # the last Givens rotation
    for count in range(1, iterations + 1):
        # Lanczos: A now = below last + alpha now + beta next.
        following = product(now)
        if count > 1:
            following -= below * last
        alpha = dot(now, following)
        following -= alpha * now
        beta = euclidean_norm(following)
        if not np.isfinite(beta):  # overflow: no later iterate is finite
            return x, count
        # A column of the tridiagonal matrix becomes one of R = Q T.
        upper, delta, gamma = epsilon, c * off_diagonal + s * alpha, s * off_diagonal - c * alpha
        epsilon, off_diagonal = s * beta, -c * beta
        length = float(np.hypot(gamma, beta)) or np.finfo(float).tiny
        c, s = gamma / length, beta / length
        before, direction = direction, (now - upper * before - delta * direction) / length
        x += c * residual * direction
        residual *= s
        if residual <= goal or beta == 0:
            return x, count
        last, now, below = now, following / beta, beta
    return x, iterations
