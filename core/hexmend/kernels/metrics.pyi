"""
Metrics of every hex from its edges, diagonals, principal axes and corners, as the Verdict library
defines them: SAND2007-1751. Each function writes arrays (m,) float64.
"""

from typing import Annotated

import numpy
from numpy.typing import NDArray


def lengths(points: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order='C', device='cpu', writable=False)], hexes: Annotated[NDArray[numpy.int32], dict(shape=(None, 8), order='C', device='cpu', writable=False)], edge_ratio: Annotated[NDArray[numpy.float64], dict(shape=(None,), order='C', device='cpu')], stretch: Annotated[NDArray[numpy.float64], dict(shape=(None,), order='C', device='cpu')], diagonal: Annotated[NDArray[numpy.float64], dict(shape=(None,), order='C', device='cpu')]) -> None:
    """
    Ratios of edges and diagonals; E the twelve edges' lengths, D the four diagonals'.

    edge_ratio is max E / min E; +inf where an edge has no length. stretch is sqrt(3) min E / max D; 0
    where neither edge nor diagonal has a length, +inf where only diagonals have none. diagonal is min D /
    max D; 0 where no diagonal has a length.
    """

def axes(points: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order='C', device='cpu', writable=False)], hexes: Annotated[NDArray[numpy.int32], dict(shape=(None, 8), order='C', device='cpu', writable=False)], aspect_ratio: Annotated[NDArray[numpy.float64], dict(shape=(None,), order='C', device='cpu')], skew: Annotated[NDArray[numpy.float64], dict(shape=(None,), order='C', device='cpu')], taper: Annotated[NDArray[numpy.float64], dict(shape=(None,), order='C', device='cpu')]) -> None:
    """
    Figures of the principal axes X1, X2, X3, the sums of the four edges along x, y and z.

    aspect_ratio is max |Xi| / min |Xi|, Verdict's "maximum edge ratio". skew is the greatest |cos| of
    the angle of two axes. taper is the greatest |Xij| / min(|Xi|, |Xj|), Xij the cross derivatives. Where
    an axis has no length they are +inf, 1 and +inf.
    """

def corners(points: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order='C', device='cpu', writable=False)], hexes: Annotated[NDArray[numpy.int32], dict(shape=(None, 8), order='C', device='cpu', writable=False)], shape: Annotated[NDArray[numpy.float64], dict(shape=(None,), order='C', device='cpu')], condition: Annotated[NDArray[numpy.float64], dict(shape=(None,), order='C', device='cpu')]) -> None:
    """
    Figures of the eight corner tetrahedra, with edges S = [e1, e2, e3] and sigma = det S.

    shape is the least 3 sigma^(2/3) / |S|^2; 0 where sigma <= 0. condition is the greatest |S| |S^-1| / 3,
    Frobenius norms; +inf where sigma <= 0.
    """

def centre(points: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order='C', device='cpu', writable=False)], hexes: Annotated[NDArray[numpy.int32], dict(shape=(None, 8), order='C', device='cpu', writable=False)], jacobian: Annotated[NDArray[numpy.float64], dict(shape=(None,), order='C', device='cpu')]) -> None:
    """
    Determinant of the Jacobian at the centre, det [X1, X2, X3] / 64 of the principal axes.
    """
