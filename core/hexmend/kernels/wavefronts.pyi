"""
Order of the nodes in a sweep, and groups of nodes that can be stepped at the same time.
"""

from typing import Annotated

import numpy
from numpy.typing import NDArray


def levels(ring_start: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], ring: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], start: Annotated[NDArray[numpy.bool_], dict(shape=(None,), order='C', device='cpu', writable=False)]) -> Annotated[NDArray[numpy.int32], dict(shape=(None,))]:
    """
    Number of edges between each node and the nearest where `start` (n,) bool is true; (n,) int32.

    One more than the deepest level where there is no way.
    """

def wavefronts(start: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], corners: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], sequence: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)]) -> tuple[Annotated[NDArray[numpy.int32], dict(shape=(None,))], Annotated[NDArray[numpy.int32], dict(shape=(None,))]]:
    """
    Groups of the nodes of a sequence: (group_start, nodes), both int32.

    No hex has two nodes of one group, and a node's group follows those of all earlier nodes of its hexes.
    Sweeping group after group, the nodes of each in parallel, equals sweeping the sequence.
    """
