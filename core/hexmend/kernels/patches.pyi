"""Patches of several free nodes, and a Newton step of each."""

from typing import Annotated

import numpy
from numpy.typing import NDArray

import hexmend.kernels.hex_mesh
import hexmend.kernels.local


class PatchPartition:
    """Patches, as `partition` makes them."""

    def __init__(self, hexes: Annotated[NDArray[numpy.int32], dict(shape=(None, 8), order='C', device='cpu', writable=False)], slots: Annotated[NDArray[numpy.int32], dict(shape=(None, 8), order='C', device='cpu', writable=False)], hex_start: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], node_start: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], nodes: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)]) -> None:
        """
        hexes and slots (.., 8) are those of the patches, patch after patch, as hex_start says.
        """

def partition(mesh: hexmend.kernels.hex_mesh.HexMesh, free: Annotated[NDArray[numpy.bool_], dict(shape=(None,), order='C', device='cpu', writable=False)], size: int, overlap: int) -> tuple[Annotated[NDArray[numpy.int32], dict(shape=(None,))], Annotated[NDArray[numpy.int32], dict(shape=(None,))], Annotated[NDArray[numpy.int32], dict(shape=(None,))], Annotated[NDArray[numpy.int32], dict(shape=(None,))], Annotated[NDArray[numpy.int32], dict(shape=(None, 8))]]:
    """
    Divide the free nodes (n,) bool into connected patches of at most `size` nodes, breadth first from the
    lowest remaining node; then add to each the nodes within `overlap` steps between nodes of one hex.

    Returns node_start and nodes: the nodes of each patch, ascending; hex_start and patch_hexes: the hexes
    at them; slots (.., 8): the number of each corner of these hexes among the patch's nodes, -1 if it is
    fixed; all int32.
    """

def colours(hex_start: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], patch_hexes: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], hexes: int) -> tuple[Annotated[NDArray[numpy.int32], dict(shape=(None,))], Annotated[NDArray[numpy.int32], dict(shape=(None,))]]:
    """
    Groups of patches that share no hex, by greedy colouring: (start, patches), int32.

    hexes: the number of hexes of the mesh.
    """

def sweep(points: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order='C', device='cpu')], partition: PatchPartition, groups: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], patches: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], settings: hexmend.kernels.local.NodeStepSettings) -> tuple[int, int]:
    """
    Move the nodes of every patch by one Newton step together, in place, with the other nodes fixed.

    Group k is patches[groups[k]:groups[k + 1]] and shares no hex: the result is that of a sequential sweep
    for any number of threads. The target has a row for each of the partition's hexes. Returns the evaluations
    of a hex's energy in line searches, and of its derivatives.
    """
