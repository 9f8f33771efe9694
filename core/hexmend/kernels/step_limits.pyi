"""Steps of nodes: how far they may go, and where they lead."""

from typing import Annotated

import numpy
from numpy.typing import NDArray


def shorten(step: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order='C', device='cpu')], points: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order='C', device='cpu', writable=False)], ring_start: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], ring: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], nodes: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], reach: float) -> None:
    """
    Shorten the steps (k, 3) of `nodes` (k,) that are longer than `reach` mean lengths of their edges; changes
    step. Rings are `Topology.rings`.
    """

def displaced(points: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order='C', device='cpu', writable=False)], nodes: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], step: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order='C', device='cpu', writable=False)], alpha: float, moved: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order='C', device='cpu')]) -> None:
    """
    Write points (n, 3), `nodes` (k,) of them displaced by alpha times their step (k, 3), to moved (n, 3).
    """
