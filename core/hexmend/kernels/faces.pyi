"""
Metrics of every hex from its six faces. Each function writes arrays (m,) float64.
"""

from typing import Annotated

import numpy
from numpy.typing import NDArray


def angles(points: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order='C', device='cpu', writable=False)], hexes: Annotated[NDArray[numpy.int32], dict(shape=(None, 8), order='C', device='cpu', writable=False)], smallest: Annotated[NDArray[numpy.float64], dict(shape=(None,), order='C', device='cpu')], largest: Annotated[NDArray[numpy.float64], dict(shape=(None,), order='C', device='cpu')]) -> None:
    """
    Angles between adjacent edges of the faces, four corners of six faces, in degrees; 0 and 180 where an
    edge has no length.
    """

def warpage(points: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order='C', device='cpu', writable=False)], hexes: Annotated[NDArray[numpy.int32], dict(shape=(None, 8), order='C', device='cpu', writable=False)], worst: Annotated[NDArray[numpy.float64], dict(shape=(None,), order='C', device='cpu')]) -> None:
    """
    Greatest over the faces of 1 - min((n0 . n2)^3, (n1 . n3)^3), n the unit normals at the face's corners;
    2 where a corner of a face has no normal.
    """

def volume(points: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order='C', device='cpu', writable=False)], hexes: Annotated[NDArray[numpy.int32], dict(shape=(None, 8), order='C', device='cpu', writable=False)], enclosed: Annotated[NDArray[numpy.float64], dict(shape=(None,), order='C', device='cpu')]) -> None:
    """
    Volume inside the six bilinear faces, that of Verdict's 24 tetrahedra: negative for a hex turned inside
    out.

    Of a face a, b, c, d it is (a + b + c + d) . (c - a) x (d - b) / 24, in the cube of the mesh's unit of
    length.
    """
