"""
How much of the light from all around reaches polygons that stand in each other's way.
"""

from typing import Annotated

import numpy
from numpy.typing import NDArray


def normals(points: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order='C', device='cpu', writable=False)], start: Annotated[NDArray[numpy.int64], dict(shape=(None,), order='C', device='cpu', writable=False)], places: Annotated[NDArray[numpy.int64], dict(shape=(None,), order='C', device='cpu', writable=False)], answer: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order='C', device='cpu')]) -> None:
    """
    One normal a polygon, that of its mean plane; on one thread, because a window's thread asks.

    Polygon i of k has the points (p, 3) at places[start[i]:start[i + 1]], in order; start (k + 1,) and places
    int64. Writes answer (k, 3), of length 1, or 0 for a polygon without an area.
    """

def shine(points: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order='C', device='cpu', writable=False)], start: Annotated[NDArray[numpy.int64], dict(shape=(None,), order='C', device='cpu', writable=False)], places: Annotated[NDArray[numpy.int64], dict(shape=(None,), order='C', device='cpu', writable=False)], normals: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order='C', device='cpu', writable=False)], directions: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order='C', device='cpu', writable=False)], side: int, light: Annotated[NDArray[numpy.float64], dict(shape=(None,), order='C', device='cpu')], whole: Annotated[NDArray[numpy.float64], dict(shape=(None,), order='C', device='cpu')]) -> None:
    """
    Light from some directions (j, 3) float64, of length 1, at every corner of polygons with their normals
    (k, 3).

    From each direction the polygons that are turned to it are drawn into a square of so many pixels a side.
    Adds to light (start[-1],) float64 what reaches each corner, and to whole what would if nothing stood in
    its way.
    """
