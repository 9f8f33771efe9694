"""Patches that hold several free nodes, and a Newton step of each."""

from typing import Annotated

import numpy
from numpy.typing import NDArray


def grow(hexes: Annotated[NDArray[numpy.int32], dict(shape=(None, 8), order='C', device='cpu', writable=False)], start: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], corners: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], free: Annotated[NDArray[numpy.bool_], dict(shape=(None,), order='C', device='cpu', writable=False)], size: int, overlap: int) -> tuple[Annotated[NDArray[numpy.int32], dict(shape=(None,))], Annotated[NDArray[numpy.int32], dict(shape=(None,))], Annotated[NDArray[numpy.int32], dict(shape=(None,))], Annotated[NDArray[numpy.int32], dict(shape=(None,))], Annotated[NDArray[numpy.int32], dict(shape=(None, 8))]]:
    """
    Divide the free nodes (n,) bool into patches of `size` nodes that hang together, breadth first from the
    lowest that is left; then each also holds those reached in `overlap` steps from node to node of a hex.

    Returns node_start, nodes: the nodes of each patch, ascending; hex_start, chosen: the hexes at them; slots
    (.., 8): where each corner of these is among the patch's nodes, -1 if it stays.
    """

def colours(hex_start: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], chosen: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], hexes: int) -> tuple[Annotated[NDArray[numpy.int32], dict(shape=(None,))], Annotated[NDArray[numpy.int32], dict(shape=(None,))]]:
    """
    Patches in groups, greedily, so that two of one group share none of so many hexes: (start, patches), int32.
    """

def sweep(points: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order='C', device='cpu')], hexes: Annotated[NDArray[numpy.int32], dict(shape=(None, 8), order='C', device='cpu', writable=False)], slots: Annotated[NDArray[numpy.int32], dict(shape=(None, 8), order='C', device='cpu', writable=False)], hex_start: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], node_start: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], nodes: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], groups: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], patches: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], delta: float, power: tuple[float, float], first: float, shrink: float, c1: float, cuts: int) -> tuple[int, int]:
    """
    Give the nodes of every patch one Newton step together, in place, the rest being fixed.

    hexes (.., 8) are those of the patches, one patch after another. Group k is patches[groups[k]:groups[k + 1]]
    and shares no hex: the result is that of one patch after another, whatever the number of threads. delta is
    meant for the patch scaled to mean edge length 1; power is (p, offset) of the objective; first, shrink, c1 and
    cuts are those of the line search, A.5. Returns how often hexes were asked for their energy in line
    searches, and for its derivatives.
    """
