"""Steps of nodes: their limits, and the points that they lead to."""

from typing import Annotated

import numpy
from numpy.typing import NDArray

import hexmend.kernels.hex_mesh


def shorten(step: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order='C', device='cpu')], points: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order='C', device='cpu', writable=False)], mesh: hexmend.kernels.hex_mesh.HexMesh, nodes: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], reach: float) -> None:
    """
    Shorten the steps (k, 3) of `nodes` (k,) that are longer than `reach` times the mean length of the
    node's edges; changes step.
    """

def displaced(points: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order='C', device='cpu', writable=False)], nodes: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], step: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order='C', device='cpu', writable=False)], alpha: float, moved: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order='C', device='cpu')]) -> None:
    """
    Points (n, 3) with `nodes` (k,) displaced by alpha times their steps (k, 3); writes moved (n, 3).
    """
