"""The scalar formulas of a corner tetrahedron, as all kernels use them."""

from typing import Annotated

import numpy
from numpy.typing import NDArray


def power_minus_two_thirds(h: Annotated[NDArray[numpy.float64], dict(shape=(None,), order='C', device='cpu', writable=False)], powers: Annotated[NDArray[numpy.float64], dict(shape=(None,), order='C', device='cpu')]) -> None:
    """Write h^(-2/3) to powers."""

def barrier(sigma: Annotated[NDArray[numpy.float64], dict(shape=(None,), order='C', device='cpu', writable=False)], delta: float, h: Annotated[NDArray[numpy.float64], dict(shape=(None,), order='C', device='cpu')], r: Annotated[NDArray[numpy.float64], dict(shape=(None,), order='C', device='cpu')]) -> None:
    """Write h(sigma) of (3.2) and r = sqrt(sigma^2 + 4 delta^2)."""
