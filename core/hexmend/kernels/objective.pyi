"""Sum of eta(H)^p over a mesh: energies, gradient, Hessian product."""

from typing import Annotated

import numpy
from numpy.typing import NDArray

import hexmend.kernels.target


def energies(points: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order='C', device='cpu', writable=False)], hexes: Annotated[NDArray[numpy.int32], dict(shape=(None, 8), order='C', device='cpu', writable=False)], delta: float, offset: float, omitted: Annotated[NDArray[numpy.uint8], dict(shape=(None,), order='C', device='cpu', writable=False)], eta: Annotated[NDArray[numpy.float64], dict(shape=(None,), order='C', device='cpu')], target: hexmend.kernels.target.TargetMatrices | None = None) -> None:
    """
    eta(H), the mean of eta(T) minus offset, of every hex, with the barrier of (3.2) regularised by delta,
    in the unit of sigma; writes eta (m,).

    Bit t of omitted (m,) uint8 is set where corner tetrahedron t of the hex is omitted, that is, counts as
    perfect. With a target, sigma and delta are in the cube of each hex's target lengths.
    """

def gradient(points: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order='C', device='cpu', writable=False)], hexes: Annotated[NDArray[numpy.int32], dict(shape=(None, 8), order='C', device='cpu', writable=False)], delta: float, norm: tuple[float, float], omitted: Annotated[NDArray[numpy.uint8], dict(shape=(None,), order='C', device='cpu', writable=False)], shares: Annotated[NDArray[numpy.float64], dict(shape=(None, 8, 3), order='C', device='cpu')], target: hexmend.kernels.target.TargetMatrices | None = None) -> None:
    """
    Gradient of sum eta(H)^p by the corners of every hex, (B.3), (B.21); writes shares (m, 8, 3).
    """

def hessian_product(points: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order='C', device='cpu', writable=False)], hexes: Annotated[NDArray[numpy.int32], dict(shape=(None, 8), order='C', device='cpu', writable=False)], slots: Annotated[NDArray[numpy.int32], dict(shape=(None, 8), order='C', device='cpu', writable=False)], values: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order='C', device='cpu', writable=False)], delta: float, norm: tuple[float, float], omitted: Annotated[NDArray[numpy.uint8], dict(shape=(None,), order='C', device='cpu', writable=False)], shares: Annotated[NDArray[numpy.float64], dict(shape=(None, 8, 3), order='C', device='cpu')], target: hexmend.kernels.target.TargetMatrices | None = None) -> None:
    """
    Hessian of sum eta(H)^p times a displacement of the free nodes, (B.19) corrected; writes shares (m, 8,
    3).

    slots is the number of each corner among the free nodes, -1 if it is fixed; values has a row for each.
    """

def gather(shares: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order='C', device='cpu', writable=False)], start: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], corners: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], nodes: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], rows: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order='C', device='cpu')]) -> None:
    """
    Sum of the contributions, shares (m, 8, 3), over the corners at each of `nodes` (k,); writes rows (k, 3).
    """
