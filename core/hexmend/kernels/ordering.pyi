"""Ordering of the free nodes in an assembled Hessian."""

from typing import Annotated

import numpy
from numpy.typing import NDArray


def slots(hexes: Annotated[NDArray[numpy.int32], dict(shape=(None, 8), order='C', device='cpu', writable=False)], ring_start: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], ring: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], free: Annotated[NDArray[numpy.bool_], dict(shape=(None,), order='C', device='cpu', writable=False)], parts: int) -> tuple[Annotated[NDArray[numpy.int32], dict(shape=(None,))], Annotated[NDArray[numpy.int32], dict(shape=(None,))]]:
    """
    The free nodes after Cuthill and McKee, in parts that share no hex, followed by the separators between
    them.

    ring_start, ring: `Topology.rings`; free (n,) bool. The number of parts, at least 1, is reduced until
    none is too thin. Returns the node in each slot (k,), and the bounds of the parts and then the
    separators, (2 parts,).
    """
