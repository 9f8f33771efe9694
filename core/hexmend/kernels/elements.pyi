"""Quality of every hex from its eight corner tetrahedra, in one pass."""

from typing import Annotated

import numpy
from numpy.typing import NDArray

import hexmend.kernels.target


def measure(points: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order='C', device='cpu', writable=False)], hexes: Annotated[NDArray[numpy.int32], dict(shape=(None, 8), order='C', device='cpu', writable=False)], q: Annotated[NDArray[numpy.float64], dict(shape=(None,), order='C', device='cpu')], sigma: Annotated[NDArray[numpy.float64], dict(shape=(None,), order='C', device='cpu')], jacobian: Annotated[NDArray[numpy.float64], dict(shape=(None,), order='C', device='cpu')], eta: Annotated[NDArray[numpy.float64], dict(shape=(None,), order='C', device='cpu')]) -> None:
    """
    Quality of every hex at delta = 0; writes four arrays (m,) float64.

    q is q(H), the mean of q(T) = 3 sigma^(2/3)/|S|^2, 0 where sigma <= 0: (2.8), (2.10). sigma is the least
    of the eight corner determinants, (2.9). jacobian is the least of sigma/(|e1||e2||e3|), 0 at a corner
    with an edge of no length. eta is eta(H) = mean of eta(T) - 1, (B.20); +inf where sigma <= 0. A corner
    whose determinant is larger than any float has q(T) = 0, eta(T) = +inf and a scaled Jacobian of 0.
    """

def measure_against(points: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order='C', device='cpu', writable=False)], hexes: Annotated[NDArray[numpy.int32], dict(shape=(None, 8), order='C', device='cpu', writable=False)], target: hexmend.kernels.target.TargetMatrices, q: Annotated[NDArray[numpy.float64], dict(shape=(None,), order='C', device='cpu')], eta: Annotated[NDArray[numpy.float64], dict(shape=(None,), order='C', device='cpu')]) -> None:
    """
    Quality of every hex against its target at delta = 0; writes two arrays (m,) float64.

    eta is eta(H) of S W^-1, the mean of eta(T) - 1, and of the size if it has a weight; q is
    the mean of 1/eta(T). An inverted corner has eta(T) = +inf.
    """

def mean_edge_length(points: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order='C', device='cpu', writable=False)], hexes: Annotated[NDArray[numpy.int32], dict(shape=(None, 8), order='C', device='cpu', writable=False)]) -> float:
    """
    Mean length of the hexes' edges, each counted once a hex; 0 without hexes.
    """

def lower_to_edges(points: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order='C', device='cpu', writable=False)], hexes: Annotated[NDArray[numpy.int32], dict(shape=(None, 8), order='C', device='cpu', writable=False)], lengths: Annotated[NDArray[numpy.float64], dict(shape=(None,), order='C', device='cpu')]) -> None:
    """
    Lower lengths (n,), at the nodes of hexes, to that of the shortest edge of theirs at each. Runs on one
    thread.
    """

def corner_qualities(points: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order='C', device='cpu', writable=False)], hexes: Annotated[NDArray[numpy.int32], dict(shape=(None, 8), order='C', device='cpu', writable=False)], q: Annotated[NDArray[numpy.float64], dict(shape=(None, 8), order='C', device='cpu')]) -> None:
    """
    q(T) of the eight corner tetrahedra of every hex, (2.8), 0 where sigma <= 0; writes q (m, 8) float64.
    """

def corner_determinants(points: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order='C', device='cpu', writable=False)], hexes: Annotated[NDArray[numpy.int32], dict(shape=(None, 8), order='C', device='cpu', writable=False)], sigma: Annotated[NDArray[numpy.float64], dict(shape=(None, 8), order='C', device='cpu')]) -> None:
    """
    sigma of the eight corner tetrahedra of every hex, (2.9); writes sigma (m, 8) float64.
    """

def corner_jacobians(points: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order='C', device='cpu', writable=False)], hexes: Annotated[NDArray[numpy.int32], dict(shape=(None, 8), order='C', device='cpu', writable=False)], jacobians: Annotated[NDArray[numpy.float64], dict(shape=(None, 8), order='C', device='cpu')]) -> None:
    """
    Scaled Jacobians of the eight corner tetrahedra of every hex, sigma/(|e1||e2||e3|), -1 where an edge has
    no length; writes jacobians (m, 8) float64.
    """
