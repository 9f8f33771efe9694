"""
GETMe: nodes go to means of the places that their hexes give them. start, corners: `Topology.node_corners`.
"""

from typing import Annotated

import numpy
from numpy.typing import NDArray


def weighted_means(places: Annotated[NDArray[numpy.float64], dict(shape=(None, 8, 3), order='C', device='cpu', writable=False)], weights: Annotated[NDArray[numpy.float64], dict(shape=(None,), order='C', device='cpu', writable=False)], start: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], corners: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], nodes: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], targets: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order='C', device='cpu')]) -> None:
    """
    Write, for each of `nodes`, the mean of its places (m, 8, 3) in its hexes by the hexes' weights (m,);
    targets (n, 3).
    """

def relax(points: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order='C', device='cpu', writable=False)], hexes: Annotated[NDArray[numpy.int32], dict(shape=(None, 8), order='C', device='cpu', writable=False)], start: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], corners: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], sound: Annotated[NDArray[numpy.bool_], dict(shape=(None,), order='C', device='cpu', writable=False)], harmed: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], moved: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order='C', device='cpu')]) -> int:
    """
    Shorten the moves of nodes until no hex that was sound is inverted; returns how many were shortened.

    points (n, 3): before the move. sound (m,) bool: whether a hex was sound there. harmed (k,) int32: hexes
    that are not sound any more at `moved` (n, 3), which is changed. Round after round, the nodes of all
    inverted hexes halve their moves, the fourth time to nothing; a hex none of whose nodes moves is what it
    was, so the rounds end.
    """
