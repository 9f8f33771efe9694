"""In what order an assembled Hessian keeps the free nodes."""

from typing import Annotated

import numpy
from numpy.typing import NDArray


def slots(hexes: Annotated[NDArray[numpy.int32], dict(shape=(None, 8), order='C', device='cpu', writable=False)], ring_start: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], ring: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], free: Annotated[NDArray[numpy.bool_], dict(shape=(None,), order='C', device='cpu', writable=False)], parts: int) -> tuple[Annotated[NDArray[numpy.int32], dict(shape=(None,))], Annotated[NDArray[numpy.int32], dict(shape=(None,))]]:
    """
    The free nodes after Cuthill and McKee, in parts that share no hex, with separators between them.

    ring_start, ring: `Topology.rings`; free (n,) bool. Of `parts` (at least 1) as many are made as are thick
    enough.

    Returns the node in each slot (k,), and where the parts, and then the separators, begin and end: (2 parts,).
    """
