"""
On which side of planes hexes lie; on one thread, because a window's thread asks.

normals (k, 3) and offsets (k,) float64: a point lies beyond a plane where x . normal > offset.
"""

from typing import Annotated

import numpy
from numpy.typing import NDArray


def centres_kept(points: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order='C', device='cpu', writable=False)], hexes: Annotated[NDArray[numpy.int32], dict(shape=(None, 8), order='C', device='cpu', writable=False)], normals: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order='C', device='cpu', writable=False)], offsets: Annotated[NDArray[numpy.float64], dict(shape=(None,), order='C', device='cpu', writable=False)], notch: bool, kept: Annotated[NDArray[numpy.bool_], dict(shape=(None,), order='C', device='cpu')]) -> None:
    """
    Whether the centre of each hex is not cut away; writes kept (m,) bool.

    With notch what lies beyond all planes is cut away, else what lies beyond one of them.
    """

def touched(points: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order='C', device='cpu', writable=False)], hexes: Annotated[NDArray[numpy.int32], dict(shape=(None, 8), order='C', device='cpu', writable=False)], normals: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order='C', device='cpu', writable=False)], offsets: Annotated[NDArray[numpy.float64], dict(shape=(None,), order='C', device='cpu', writable=False)], notch: bool, answer: Annotated[NDArray[numpy.bool_], dict(shape=(None,), order='C', device='cpu')]) -> None:
    """
    Which planes cross or touch each hex where that can be seen; writes answer (m * k,) bool, hex by hex.

    None does where the hex lies wholly beyond one of them, or, with notch, wholly before.
    """
