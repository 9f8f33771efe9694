"""
Valence of edges, from which the block structure of a mesh follows, and averages along dual sheets.
"""

from typing import Annotated

import numpy
from numpy.typing import NDArray


def edges(hexes: Annotated[NDArray[numpy.int32], dict(shape=(None, 8), order='C', device='cpu', writable=False)], start: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], corners: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], neighbours: Annotated[NDArray[numpy.int32], dict(shape=(None, 6), order='C', device='cpu', writable=False)], max_items: int = 2147483647) -> tuple[Annotated[NDArray[numpy.int32], dict(shape=(None, 2))], Annotated[NDArray[numpy.int32], dict(shape=(None,))], Annotated[NDArray[numpy.bool_], dict(shape=(None,))]]:
    """
    Every edge once, with the number of hexes around it: (ends (e, 2) int32, valence (e,) int32, outside
    (e,) bool).

    ends: the lower node first, ascending. valence: hexes that have the edge; one that has it twice, its
    nodes being one, counts once. outside: True for an edge of a boundary face. start, corners and
    neighbours are those of `incidence`. OverflowError where there are more than `max_items` edges.
    """

def average_along_sheets(groups: Annotated[NDArray[numpy.int32], dict(shape=(None, 4), order='C', device='cpu', writable=False)], values: Annotated[NDArray[numpy.float64], dict(shape=(None,), order='C', device='cpu', writable=False)], average: Annotated[NDArray[numpy.float64], dict(shape=(None,), order='C', device='cpu')], count: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu')]) -> None:
    """
    Average values of edges (e + 1,) over the groups (g, 4) int32 of parallel edges around each edge; writes
    average (e + 1,) float64 and count (e + 1,) int32, the number of groups.

    It is the mean of the groups' means, and 0 without a group. The number e, and the last value, stand for
    no edge.
    """

def coarse_blocks(hexes: Annotated[NDArray[numpy.int32], dict(shape=(None, 8), order='C', device='cpu', writable=False)], start: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], corners: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)]) -> Annotated[NDArray[numpy.int32], dict(shape=(None, 27))]:
    """
    Nodes of each hex of the mesh of which this is a uniform refinement, 2 x 2 x 2 hexes for each, (k, 27)
    int32; no row where it is not. start, corners: `incidence.node_corners`.

    Node (x, y, z) of the 3 x 3 x 3 nodes of a coarse hex is in column 9 z + 3 y + x. Its axes are those of
    the first of its hexes, and coarse hexes are in the order of these.
    """

def interpolate_blocks(blocks: Annotated[NDArray[numpy.int32], dict(shape=(None, 27), order='C', device='cpu', writable=False)], kept: Annotated[NDArray[numpy.bool_], dict(shape=(None,), order='C', device='cpu', writable=False)], values: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order='C', device='cpu')]) -> None:
    """
    Interpolate values (n, 3) float64 within the blocks (k, 27) int32 of `coarse_blocks`, from those of the
    corners and of nodes that are kept (n,) bool to all others, which it writes.

    The interpolation is transfinite: linear on edges, from edges and corners on faces, and from faces, edges
    and corners inside. Runs on one thread.
    """
