"""
Convex polygons cut off at planes; on one thread, because a window's thread asks.
"""

from typing import Annotated

import numpy
from numpy.typing import NDArray


def before(points: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order='C', device='cpu', writable=False)], start: Annotated[NDArray[numpy.int64], dict(shape=(None,), order='C', device='cpu', writable=False)], places: Annotated[NDArray[numpy.int64], dict(shape=(None,), order='C', device='cpu', writable=False)], owner: Annotated[NDArray[numpy.int64], dict(shape=(None,), order='C', device='cpu', writable=False)], normals: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order='C', device='cpu', writable=False)], offsets: Annotated[NDArray[numpy.float64], dict(shape=(None,), order='C', device='cpu', writable=False)]) -> tuple[Annotated[NDArray[numpy.float64], dict(shape=(None, 3))], Annotated[NDArray[numpy.int64], dict(shape=(None,))], Annotated[NDArray[numpy.int64], dict(shape=(None,))]]:
    """
    What of polygons lies before all planes, where x . normal <= offset.

    Polygon i of k has the points (p, 3) at places[start[i]:start[i + 1]], in order; start (k + 1,), places and
    owner (k,) int64; normals (j, 3) and offsets (j,) float64. Makes the points of what is left, polygon after
    polygon, its start, and its owners.
    """
