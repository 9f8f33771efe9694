"""
Laplacian sweeps: a node moves to the mean of its edge neighbours. ring_start, ring: `Topology.rings`.

With a surface the means of nodes that slide are projected onto it.
"""

from typing import Annotated

import numpy
from numpy.typing import NDArray

import hexmend.kernels.hex_mesh
import hexmend.kernels.sliding_surface


def in_place(points: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order='C', device='cpu')], ring_start: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], ring: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], nodes: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], surface: hexmend.kernels.sliding_surface.SlidingSurface | None = None) -> None:
    """Algorithm 3.1: one node after another; changes points (n, 3)."""

def simultaneous(points: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order='C', device='cpu', writable=False)], ring_start: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], ring: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], nodes: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], moved: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order='C', device='cpu')]) -> None:
    """
    All nodes at once, from the old positions of the others; writes moved (n, 3).
    """

def smart_sweep(points: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order='C', device='cpu')], mesh: hexmend.kernels.hex_mesh.HexMesh, ring_start: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], ring: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], nodes: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], keep_least_quality: bool, surface: hexmend.kernels.sliding_surface.SlidingSurface | None = None) -> int:
    """
    Smart Laplacian: Algorithm 3.1 without moves that do harm; changes points (n, 3), returns the number of
    rejected moves.

    A move does harm if it inverts a valid hex or, with keep_least_quality, lowers the least q(H) of the
    hexes at the node.
    """
