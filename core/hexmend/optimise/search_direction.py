"""Search directions for all free nodes at once: Algorithms A.2, A.3, A.4."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol, runtime_checkable

import numpy as np

from hexmend.energy import Hessian
from hexmend.energy.assembled_hessian import AssembledHessian, CGResult, unpack_symmetric
from hexmend.optimise.linear_solvers import LinearSolver, one_blas_thread

#: Share of the greatest eigenvalue to which lower ones are raised: a thousandth, by Algorithm A.4.
LEAST_EIGENVALUE = 1e-3
#: Share of a quantity at which its changes are no more than what rounding leaves: of the first gradient for solutions,
#: and of the energy for slopes.
NEGLIGIBLE = float(np.sqrt(np.finfo(float).eps))


@dataclass(frozen=True)
class SearchDirection:
    """Search direction of the free nodes.

    Parameters
    ----------
    vector : (k, 3) float64
        In mean edge lengths.
    solver_iterations : int
        Of the linear solver; 0 where none is used.
    shift : float
        Added to each diagonal entry of the Hessian, by `TruncatedNewton` as a multiple of the entry.
    """

    vector: np.ndarray
    solver_iterations: int = 0
    shift: float = 0.0


class DirectionMethod(Protocol):
    """Function that finds a search direction for sum eta^p."""

    def __call__(self, value: float, gradient: np.ndarray, hessian: Hessian) -> SearchDirection:
        """Find the direction from value, gradient (k, 3) and Hessian."""


@runtime_checkable
class DampedDirection(DirectionMethod, Protocol):
    """Direction of a matrix whose diagonal can be increased, as in `TruncatedNewton`."""

    def damped(self, gradient: np.ndarray, hessian: Hessian) -> SearchDirection | None:
        """Find the direction at the same points with more damping; None where that is of no use."""

    def shortened(self) -> None:
        """Damp the next direction more: the line search has shortened the step along this one."""


def steepest_descent(value: float, gradient: np.ndarray, hessian: Hessian) -> SearchDirection:
    """Algorithm A.2: p_k = -grad f of (3.3), f being the p-th root of the sum.

    With a target the gradient is that in the lengths at each node: a layer is thinner than steps elsewhere are long.
    A value that the reward of a floor makes negative has no root: its own gradient is taken.
    """
    p, lengths = hessian.energy.norm.p, hessian.energy.node_lengths
    step = -(value ** (1 / p - 1) / p if value > 0 else 1.0) * gradient  # (C.2)
    return SearchDirection(step if lengths is None else np.square(lengths) * step)


@dataclass(frozen=True)
class Newton:
    """Algorithm A.3: solve H p_k = -grad f."""

    solver: LinearSolver

    def __call__(self, value: float, gradient: np.ndarray, hessian: Hessian) -> SearchDirection:
        p, count = self.solver(hessian, -gradient.ravel())
        return SearchDirection(p.reshape(-1, 3), count, hessian.shift)


@dataclass(frozen=True)
class TruncatedNewtonConfig:
    """Settings of `TruncatedNewton`.

    Parameters
    ----------
    iterations : int
        Most iterations of conjugate gradients.
    loosest, tightest : float
        Bounds of the tolerance, in (0, 1).
    max_damping_increases : int
        Most increases of the damping in a step.
    damping_factor : float
        Factor of an increase; its square is the divisor after a step for which the damping was enough. The smallest
        damping that is not 0, as a share of the diagonal, is the tightest tolerance: a solution does not feel less.
    deflated : bool
        Deflate solutions by translations of aggregates of nodes: best where many iterations are needed. More than the
        smallest damping shortens long waves, so that a few iterations are enough: such solutions are not deflated.
    """

    iterations: int = 200
    loosest: float = 0.1
    tightest: float = 1e-3
    max_damping_increases: int = 12
    damping_factor: float = 2.0
    deflated: bool = False


class TruncatedNewton:
    """Newton's direction, solved only as accurately as the quadratic model justifies (Dembo and Steihaug 1983).

    The tolerance of the residual follows the square of what the last step left of the gradient (Eisenstat and Walker
    1996): loose while steps gain little, tight where Newton's method converges fast, but not so tight that the gradient
    would fall below the square root of a rounding error of the first. If the Hessian is not positive definite, its
    diagonal is increased until it is (Levenberg 1944): the matrix is assembled already, and another solution costs less
    than a short step.

    An object serves one sequence of steps: tolerance and damping follow from the step before.

    Parameters
    ----------
    config : TruncatedNewtonConfig, optional
    """

    def __init__(self, config: TruncatedNewtonConfig | None = None):
        self.config = config or TruncatedNewtonConfig()
        self._first = self._last = np.inf
        self._damping = 0.0
        self._increases, self._used_damping, self._next_damping = 0, 0.0, 0.0  # of this step
        self._last_tolerance = self.config.loosest
        self._matrix: AssembledHessian | None = None

    def __call__(self, value: float, gradient: np.ndarray, hessian: Hessian) -> SearchDirection:
        config, matrix = self.config, hessian.assembled(reuse=self._matrix)
        self._matrix = matrix
        tolerance = self._tolerance(hessian.energy.ranks.norm(gradient))
        self._increases, self._last_tolerance = 0, tolerance
        solved, damping, count = self._solve_definite(matrix, gradient, tolerance, self._damping)
        matrix.lend_memory()  # to the next gradient
        self._used_damping = damping
        self._damping = damping if damping > self._damping else damping / config.damping_factor**2
        if self._damping < config.tightest:
            self._damping = 0.0
        self._next_damping = self._damping
        np.negative(solved.x, out=solved.x)
        return SearchDirection(solved.x.reshape(-1, 3), count, damping)

    def solve_again(self, right: np.ndarray) -> tuple[np.ndarray, int, bool]:
        """Solve with the matrix of the last direction for another right-hand side (k, 3), as accurately.

        Returns
        -------
        (k, 3) float64
        int
            Iterations.
        bool
            False where the matrix is not positive definite.
        """
        if self._matrix is None:
            raise RuntimeError("solve_again comes after a direction has been found")
        solved = self._solve(self._matrix, right.ravel(), self._last_tolerance, self._used_damping)
        return solved.x.reshape(-1, 3), solved.iterations, not solved.negative_curvature

    def damped(self, gradient: np.ndarray, hessian: Hessian) -> SearchDirection | None:
        """Return the direction at the same points with more damping, where the limits of a step spoil the last one.

        A long wave moves small hexes by many of their edges. Damping shortens it as a whole; a limit of the step of
        each node may leave a direction that does not descend. The next step begins with this damping.

        Parameters
        ----------
        gradient : (k, 3) float64
        hessian : Hessian
            Both as in the last call.

        Returns
        -------
        SearchDirection or None
            None after `max_damping_increases`: the next step begins as if none had been asked for.
        """
        matrix = self._matrix
        if matrix is None or self._increases >= self.config.max_damping_increases:
            self._damping = self._next_damping
            return None
        if matrix.has_lent_memory:
            matrix = self._matrix = hessian.assembled(reuse=matrix)
        self._increases, damping = self._increases + 1, self._increased(self._used_damping)
        solved, damping, count = self._solve_definite(matrix, gradient, self.config.loosest, damping)
        matrix.lend_memory()
        self._used_damping = damping
        if solved.negative_curvature:
            self._damping = self._next_damping
            return None
        self._damping = damping
        return SearchDirection(-solved.x.reshape(-1, 3), count, damping)

    def shortened(self) -> None:
        """Damp the next direction more, by two increases: the line search has shortened the step along this one."""
        self._damping = max(self._damping, self._increased(self.config.damping_factor * self._used_damping))

    def _solve_definite(
        self, matrix: AssembledHessian, gradient: np.ndarray, tolerance: float, damping: float
    ) -> tuple[CGResult, float, int]:
        """Solve with a damping, increased until the matrix is positive definite.

        Returns the solution, the damping, and the number of iterations of all solutions.
        """
        solved = self._solve(matrix, gradient.ravel(), tolerance, damping)
        count = solved.iterations
        while solved.negative_curvature and self._increases < self.config.max_damping_increases:
            damping, self._increases = self._increased(damping), self._increases + 1
            del solved  # large meshes have no memory for two solutions
            solved = self._solve(matrix, gradient.ravel(), tolerance, damping)
            count += solved.iterations
        return solved, damping, count

    def _increased(self, damping: float) -> float:
        return max(self.config.damping_factor * damping, self.config.tightest)

    def _solve(self, matrix: AssembledHessian, right: np.ndarray, tolerance: float, damping: float) -> CGResult:
        config = self.config
        deflated = config.deflated and damping <= config.tightest
        return matrix.solve(right, tolerance, config.iterations, damping, deflated)

    def _tolerance(self, length: float) -> float:
        """Return the tolerance at a gradient of this length."""
        if self._first == np.inf:
            self._first = self._last = length
        loosest = self.config.loosest
        if length == 0:
            return loosest
        goal = max(0.9 * (length / self._last) ** 2, NEGLIGIBLE * self._first / length)
        self._last = length
        return float(np.clip(goal, self.config.tightest, loosest))


@dataclass(frozen=True)
class ModifiedNewton:
    """Algorithm A.4: Newton's direction after the least eigenvalue is raised to a thousandth of the greatest."""

    solver: LinearSolver

    def __call__(self, value: float, gradient: np.ndarray, hessian: Hessian) -> SearchDirection:
        least, greatest = extreme_eigenvalues(hessian)
        if least < LEAST_EIGENVALUE * greatest:
            hessian = hessian.shifted(LEAST_EIGENVALUE * greatest - least)
        return Newton(self.solver)(value, gradient, hessian)


def extreme_eigenvalues(hessian: Hessian) -> tuple[float, float]:
    """Find the least and the greatest eigenvalue by Lanczos's method, to a thousandth of their distance.

    The least is found as the greatest of lambda_max I - H, where it is isolated; where that does not converge in 50
    iterations it is taken to be zero (A.2).
    """
    from scipy.sparse.linalg import ArpackNoConvergence, LinearOperator, eigsh

    start = np.ones(hessian.shape[0])  # ARPACK's own start is random
    matrix = hessian.assembled(hessian.energy.precision)
    size = float(np.abs(matrix.diagonal_blocks).max(initial=0.0))
    if size == 0:
        return 0.0, 0.0
    exponent = int(np.frexp(size)[1])  # ARPACK takes very small numbers for 0

    def top(operator: LinearOperator) -> float | None:
        try:
            with one_blas_thread():
                return float(
                    eigsh(operator, 1, which="LA", maxiter=50, tol=1e-3, v0=start, return_eigenvectors=False)[0]
                )
        except ArpackNoConvergence:
            return None

    def product(v: np.ndarray) -> np.ndarray:
        return np.ldexp(matrix @ v, -exponent)

    greatest = top(LinearOperator(hessian.shape, matvec=product, dtype=np.float64))
    if greatest is None:
        return 0.0, float(np.linalg.eigvalsh(unpack_symmetric(matrix.diagonal_blocks)).max())
    distance = top(LinearOperator(hessian.shape, matvec=lambda v: greatest * v - product(v), dtype=np.float64))
    least = 0.0 if distance is None else greatest - distance
    return float(np.ldexp(least, exponent)), float(np.ldexp(greatest, exponent))
