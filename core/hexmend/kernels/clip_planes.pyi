"""
Sides of planes on which hexes lie. A point is beyond a plane where x . normal > offset; normals (k, 3)
and offsets (k,) float64. The functions run on one thread, because the window's thread calls them.
"""

from typing import Annotated

import numpy
from numpy.typing import NDArray


def centres_kept(points: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order='C', device='cpu', writable=False)], hexes: Annotated[NDArray[numpy.int32], dict(shape=(None, 8), order='C', device='cpu', writable=False)], normals: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order='C', device='cpu', writable=False)], offsets: Annotated[NDArray[numpy.float64], dict(shape=(None,), order='C', device='cpu', writable=False)], notch: bool, kept: Annotated[NDArray[numpy.bool_], dict(shape=(None,), order='C', device='cpu')]) -> None:
    """
    Hexes whose centre remains after the cut; writes kept (m,) bool.

    With `notch` what is beyond all planes is cut away, else what is beyond any of them.
    """

def touched(points: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order='C', device='cpu', writable=False)], hexes: Annotated[NDArray[numpy.int32], dict(shape=(None, 8), order='C', device='cpu', writable=False)], normals: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order='C', device='cpu', writable=False)], offsets: Annotated[NDArray[numpy.float64], dict(shape=(None,), order='C', device='cpu', writable=False)], notch: bool, answer: Annotated[NDArray[numpy.bool_], dict(shape=(None,), order='C', device='cpu')]) -> None:
    """
    Planes that cross or touch each hex where the section is visible; writes answer (m * k,) bool, hex by
    hex.

    None does where the hex lies wholly beyond one of them or, with `notch`, wholly before one.
    """
