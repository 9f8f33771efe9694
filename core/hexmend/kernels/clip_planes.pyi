"""
Sides of planes on which hexes lie. A point is beyond a plane where x . normal > offset; normals (k, 3)
and offsets (k,) float64. The functions run on one thread, because the window's thread calls them.
"""

from typing import Annotated

import numpy
from numpy.typing import NDArray


def centre_heights(points: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order='C', device='cpu', writable=False)], hexes: Annotated[NDArray[numpy.int32], dict(shape=(None, 8), order='C', device='cpu', writable=False)], normal: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order='C', device='cpu', writable=False)], eightfold: Annotated[NDArray[numpy.float64], dict(shape=(None,), order='C', device='cpu')]) -> float:
    """
    Eight times the heights of the centres of hexes along a normal (1, 3); writes eightfold (m,) float64.

    Returns the largest extent of a hex along the normal.
    """

def opened(hexes: Annotated[NDArray[numpy.int32], dict(shape=(None, 8), order='C', device='cpu', writable=False)], neighbours: Annotated[NDArray[numpy.int32], dict(shape=(None, 6), order='C', device='cpu', writable=False)], eightfold: Annotated[NDArray[numpy.float64], dict(shape=(None,), order='C', device='cpu', writable=False)], extent: float, offset: float) -> tuple[Annotated[NDArray[numpy.int32], dict(shape=(None, 4))], Annotated[NDArray[numpy.int32], dict(shape=(None,))]]:
    """
    Faces that a plane opens: those between hexes whose centres are before it and beyond it.

    eightfold (m,) float64 and extent are those of `centre_heights`; neighbours (m, 6) int32 the hex behind
    each face, -1 for none. Returns the nodes of the faces (k, 4) and the hex before the plane (k,), int32.
    """

def touched(points: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order='C', device='cpu', writable=False)], hexes: Annotated[NDArray[numpy.int32], dict(shape=(None, 8), order='C', device='cpu', writable=False)], normals: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order='C', device='cpu', writable=False)], offsets: Annotated[NDArray[numpy.float64], dict(shape=(None,), order='C', device='cpu', writable=False)], notch: bool, answer: Annotated[NDArray[numpy.bool_], dict(shape=(None,), order='C', device='cpu')]) -> None:
    """
    Planes that cross or touch each hex where the section is visible; writes answer (m * k,) bool, hex by
    hex.

    None does where the hex lies wholly beyond one of them or, with `notch`, wholly before one.
    """
