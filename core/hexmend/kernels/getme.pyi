"""
Simultaneous GETMe: a node moves to the weighted mean of the targets that its hexes' element steps give it.
"""

from typing import Annotated

import numpy
from numpy.typing import NDArray

import hexmend.kernels.hex_mesh


def weighted_means(places: Annotated[NDArray[numpy.float64], dict(shape=(None, 8, 3), order='C', device='cpu', writable=False)], weights: Annotated[NDArray[numpy.float64], dict(shape=(None,), order='C', device='cpu', writable=False)], mesh: hexmend.kernels.hex_mesh.HexMesh, nodes: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], targets: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order='C', device='cpu')]) -> None:
    """
    Means of the targets, places (m, 8, 3), of each of `nodes` over its hexes, by their weights (m,);
    writes targets (n, 3).
    """

def relax(points: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order='C', device='cpu', writable=False)], mesh: hexmend.kernels.hex_mesh.HexMesh, valid: Annotated[NDArray[numpy.bool_], dict(shape=(None,), order='C', device='cpu', writable=False)], harmed: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], moved: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order='C', device='cpu')]) -> int:
    """
    Shorten moves until no hex that was valid is inverted; returns the number of shortened moves.

    points (n, 3): before the move. valid (m,) bool: hexes that were valid there. harmed (k,) int32: those
    that are inverted at `moved` (n, 3), which is changed. In each round the nodes of all inverted hexes
    halve their moves, the fourth time to nothing; a hex none of whose nodes moves is as it was, so the
    rounds end.
    """
