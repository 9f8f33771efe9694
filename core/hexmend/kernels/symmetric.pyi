"""Symmetric 3 x 3 matrices, xx xy xz yy yz zz."""

from collections.abc import Sequence


def extreme_eigenvalues(a: Sequence[float]) -> tuple[float, float]:
    """Least and greatest eigenvalue (Smith 1961)."""

def solve(a: Sequence[float], b: Sequence[float]) -> list[float]:
    """Solution of the linear system; zero where the matrix is singular."""

def newton(hessian: Sequence[float], gradient: Sequence[float], modified: bool) -> list[float]:
    """The direction of Algorithm A.3 or, modified, A.4, at a node."""
