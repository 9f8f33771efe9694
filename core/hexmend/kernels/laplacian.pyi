"""
Laplacian sweeps: a node goes to the mean of its edge neighbours. Rings are `Topology.rings`.
"""

from typing import Annotated

import numpy
from numpy.typing import NDArray


def in_place(points: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order='C', device='cpu')], ring_start: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], ring: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], nodes: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)]) -> None:
    """
    Algorithm 3.1: node after node, each seeing where those before it went; changes points (n, 3).
    """

def simultaneous(points: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order='C', device='cpu', writable=False)], ring_start: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], ring: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], nodes: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], moved: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order='C', device='cpu')]) -> None:
    """
    All nodes at once, each seeing where the others were; writes moved (n, 3).
    """

def guarded(points: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order='C', device='cpu')], hexes: Annotated[NDArray[numpy.int32], dict(shape=(None, 8), order='C', device='cpu', writable=False)], start: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], corners: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], ring_start: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], ring: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], nodes: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], keep_least_quality: bool) -> int:
    """
    Algorithm 3.1 in which a move that harms is taken back; changes points (n, 3), returns how many were.

    A move harms if it inverts an attached hex that was not inverted, or, with keep_least_quality, if it
    lowers the least q(H) of the attached hexes. start, corners: `Topology.node_corners`.
    """
