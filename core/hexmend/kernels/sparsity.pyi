"""
Sparsity of a Hessian: the 3 x 3 blocks above its diagonal, one for each pair of free nodes of a hex.
"""

from typing import Annotated

import numpy
from numpy.typing import NDArray


PAIRS: int = 28

def pattern(slots: Annotated[NDArray[numpy.int32], dict(shape=(None, 8), order='C', device='cpu', writable=False)], nodes: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], start: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], corners: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], opposite: bool = True, max_items: int = 2147483647) -> tuple[Annotated[NDArray[numpy.int32], dict(shape=(None,))], Annotated[NDArray[numpy.int32], dict(shape=(None,))]]:
    """
    Blocks above the diagonal.

    slots (m, 8): the slot of each corner, -1 if it is fixed; nodes (k,): the node of each slot; start,
    corners: `Topology.node_corners`. Without `opposite`, nodes that only opposite corners of hexes join have
    no block. Returns row_start (k + 1,) and columns, ascending within a row, int32.
    OverflowError where there are more than `max_items` blocks.
    """
