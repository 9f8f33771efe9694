"""
Validity of hexes: bounds of det J, the determinant of the map from the unit cube, everywhere in them.

Second-order hexes are given by their 27 nodes each, x slowest and z fastest: nodes (m, 81) float64.
"""

from typing import Annotated

import numpy
from numpy.typing import NDArray


def certify(points: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order='C', device='cpu', writable=False)], hexes: Annotated[NDArray[numpy.int32], dict(shape=(None, 8), order='C', device='cpu', writable=False)], validity: Annotated[NDArray[numpy.uint8], dict(shape=(None,), order='C', device='cpu')]) -> None:
    """
    Write the validity (m,) uint8 of hexes: 0 where det J is positive everywhere, 1 where it is not at a corner,
    2 where it is not elsewhere, 3 where that is undecided: within rounding of 0.
    """

def certify_quadratic(nodes: Annotated[NDArray[numpy.float64], dict(shape=(None, 81), order='C', device='cpu', writable=False)], validity: Annotated[NDArray[numpy.uint8], dict(shape=(None,), order='C', device='cpu')]) -> None:
    """The same of second-order hexes."""

def jacobian_bounds(points: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order='C', device='cpu', writable=False)], hexes: Annotated[NDArray[numpy.int32], dict(shape=(None, 8), order='C', device='cpu', writable=False)], bounds: Annotated[NDArray[numpy.float64], dict(shape=(None, 2), order='C', device='cpu')]) -> None:
    """
    Write a lower bound of the least det J of each hex, and an upper bound of the greatest, (m, 2) float64.

    They differ from the extremes by at most a hundredth of these, or 1e-7 of the greatest coefficient.
    """

def jacobian_bounds_quadratic(nodes: Annotated[NDArray[numpy.float64], dict(shape=(None, 81), order='C', device='cpu', writable=False)], bounds: Annotated[NDArray[numpy.float64], dict(shape=(None, 2), order='C', device='cpu')]) -> None:
    """The same of second-order hexes."""

def least_jacobian(points: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order='C', device='cpu', writable=False)], hexes: Annotated[NDArray[numpy.int32], dict(shape=(None, 8), order='C', device='cpu', writable=False)]) -> float:
    """
    A lower bound, from -1 to 1, of the least det J over the greatest of the same hex, of all hexes.
    """

def least_jacobian_quadratic(nodes: Annotated[NDArray[numpy.float64], dict(shape=(None, 81), order='C', device='cpu', writable=False)]) -> float:
    """The same of second-order hexes."""

def jacobian_coefficients(points: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order='C', device='cpu', writable=False)], hexes: Annotated[NDArray[numpy.int32], dict(shape=(None, 8), order='C', device='cpu', writable=False)], coefficients: Annotated[NDArray[numpy.float64], dict(shape=(None, 27), order='C', device='cpu')]) -> None:
    """
    Write the Bernstein coefficients of det J of each hex, (m, 27) float64, x slowest and z fastest.
    """
