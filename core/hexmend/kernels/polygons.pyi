"""
Clipping of convex polygons. It runs on one thread, because the window's thread calls it.
"""

from typing import Annotated

import numpy
from numpy.typing import NDArray


def before(points: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order='C', device='cpu', writable=False)], start: Annotated[NDArray[numpy.int64], dict(shape=(None,), order='C', device='cpu', writable=False)], places: Annotated[NDArray[numpy.int64], dict(shape=(None,), order='C', device='cpu', writable=False)], owner: Annotated[NDArray[numpy.int64], dict(shape=(None,), order='C', device='cpu', writable=False)], normals: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order='C', device='cpu', writable=False)], offsets: Annotated[NDArray[numpy.float64], dict(shape=(None,), order='C', device='cpu', writable=False)]) -> tuple[Annotated[NDArray[numpy.float64], dict(shape=(None, 3))], Annotated[NDArray[numpy.int64], dict(shape=(None,))], Annotated[NDArray[numpy.int64], dict(shape=(None,))]]:
    """
    Clip polygons to x . normal <= offset for all planes.

    Polygon i of k has the points (p, 3) numbered places[start[i]:start[i + 1]], in order; start (k + 1,),
    places and owner (k,) int64; normals (j, 3) and offsets (j,) float64. Returns the points of the remaining
    polygons, one after another, their start, and their owners.
    """
