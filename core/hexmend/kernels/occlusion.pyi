"""Ambient occlusion of polygons."""

from typing import Annotated

import numpy
from numpy.typing import NDArray


def normals(points: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order='C', device='cpu', writable=False)], start: Annotated[NDArray[numpy.int64], dict(shape=(None,), order='C', device='cpu', writable=False)], places: Annotated[NDArray[numpy.int64], dict(shape=(None,), order='C', device='cpu', writable=False)], answer: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order='C', device='cpu')]) -> None:
    """
    Unit normals of the mean planes of polygons; writes answer (k, 3), 0 for a polygon without area.

    Polygon i of k has the points (p, 3) numbered places[start[i]:start[i + 1]], in order; start (k + 1,)
    and places int64. It runs on one thread, because the window's thread calls it.
    """

def shine(points: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order='C', device='cpu', writable=False)], start: Annotated[NDArray[numpy.int64], dict(shape=(None,), order='C', device='cpu', writable=False)], places: Annotated[NDArray[numpy.int64], dict(shape=(None,), order='C', device='cpu', writable=False)], normals: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order='C', device='cpu', writable=False)], directions: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order='C', device='cpu', writable=False)], side: int, light: Annotated[NDArray[numpy.float64], dict(shape=(None,), order='C', device='cpu')], whole: Annotated[NDArray[numpy.float64], dict(shape=(None,), order='C', device='cpu')]) -> None:
    """
    Light from directions (j, 3) float64, unit vectors, at every corner of polygons with normals (k, 3).

    For each direction the polygons that face it are rasterised into a height map of `side` x `side` pixels.
    Adds the light that reaches each corner to light (start[-1],) float64, and the light without occlusion to
    whole.
    """
