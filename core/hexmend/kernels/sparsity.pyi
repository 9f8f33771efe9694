"""
Sparsity of a Hessian: the 3 x 3 blocks above its diagonal, one for each pair of free nodes of a hex.
"""

from typing import Annotated

import numpy
from numpy.typing import NDArray


PAIRS: int = 28

def pattern(slots: Annotated[NDArray[numpy.int32], dict(shape=(None, 8), order='C', device='cpu', writable=False)], nodes: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], start: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], corners: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], max_items: int = 2147483647) -> tuple[Annotated[NDArray[numpy.int32], dict(shape=(None,))], Annotated[NDArray[numpy.int32], dict(shape=(None,))], Annotated[NDArray[numpy.uint16], dict(shape=(None, 28))]]:
    """
    Blocks above the diagonal, and the block that each pair of a hex's corners adds to.

    slots (m, 8): the slot of each corner, -1 if it is fixed; nodes (k,): the node of each slot; start,
    corners: `Topology.node_corners`. Returns row_start (k + 1,) and columns, ascending within a row; and
    target (m, 28) uint16, of the pairs 01, 02... 07, 12...: the block, from the first of the row of the
    lower slot on, 65535 where a corner is fixed or both are one node. The others are int32.
    OverflowError where there are more than `max_items` blocks.
    """
