"""
In what order a sweep visits nodes, and which of them it can visit at the same time.
"""

from typing import Annotated

import numpy
from numpy.typing import NDArray


def levels(ring_start: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], ring: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], start: Annotated[NDArray[numpy.bool_], dict(shape=(None,), order='C', device='cpu', writable=False)]) -> Annotated[NDArray[numpy.int32], dict(shape=(None,))]:
    """
    How many edges lie between each node and the nearest of those where `start` (n,) bool is true; (n,) int32.

    One more than the deepest level where no way leads there.
    """

def wavefronts(start: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], corners: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], sequence: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)]) -> tuple[Annotated[NDArray[numpy.int32], dict(shape=(None,))], Annotated[NDArray[numpy.int32], dict(shape=(None,))]]:
    """
    The nodes of a sequence in groups, so that no hex holds two nodes of one group, and a node's group is behind
    those of all earlier nodes that share a hex with it: (group_start, nodes), both int32.

    Visiting group after group, each side by side, does what visiting the sequence one by one does.
    """
