"""
Incidence of nodes, hexes, faces and edges; components and colours. All linear in the number of hexes.
"""

from typing import Annotated

import numpy
from numpy.typing import NDArray


def node_corners(hexes: Annotated[NDArray[numpy.int32], dict(shape=(None, 8), order='C', device='cpu', writable=False)], n: int) -> tuple[Annotated[NDArray[numpy.int32], dict(shape=(None,))], Annotated[NDArray[numpy.int32], dict(shape=(None,))]]:
    """
    Corners of hexes at each of n nodes, as compressed rows (start (n + 1,), corners (8 m,)), both int32.

    Row i is corners[start[i]:start[i + 1]]: numbers 8 * hex + corner, ascending.
    """

def face_neighbours(hexes: Annotated[NDArray[numpy.int32], dict(shape=(None, 8), order='C', device='cpu', writable=False)], start: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], corners: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], opposed: bool = True) -> tuple[Annotated[NDArray[numpy.int32], dict(shape=(None, 6))], int]:
    """
    The hex behind each face, (m, 6) int32, and the number of non-manifold faces; start, corners:
    `node_corners`.

    Two faces are one if they have the same nodes in opposite order and no third face has these nodes; -1
    elsewhere. Faces that lie on the nodes of others otherwise are non-manifold, a defect of the mesh, and are
    counted once per hex. Without `opposed` any order of the nodes counts.
    """

def overlapping_corners(hexes: Annotated[NDArray[numpy.int32], dict(shape=(None, 8), order='C', device='cpu', writable=False)], start: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], corners: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)]) -> tuple[Annotated[NDArray[numpy.int32], dict(shape=(None,))], Annotated[NDArray[numpy.int32], dict(shape=(None,))]]:
    """
    Corners at each node whose cones overlap wherever the nodes are, as compressed rows (start (n + 1,),
    corners), both int32; start, corners: `node_corners`.

    Two faces at the node have the same two edges there, in one order as seen from their hexes.
    """

def join(parent: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu')], items: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], width: int) -> None:
    """
    Connect the items of each row of `width` items; changes parent (n,) int32, at first 0 to n - 1.

    Union-find: parent[i] is an item of i's component, at most i.
    """

def node_rings(hexes: Annotated[NDArray[numpy.int32], dict(shape=(None, 8), order='C', device='cpu', writable=False)], start: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], corners: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], max_items: int = 2147483647) -> tuple[Annotated[NDArray[numpy.int32], dict(shape=(None,))], Annotated[NDArray[numpy.int32], dict(shape=(None,))]]:
    """
    Edge neighbours of each node, ascending, as compressed rows (ring_start (n + 1,), ring), both int32.

    OverflowError where the rows have more than `max_items` items.
    """

def greedy_colours(start: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], corners: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], chosen: Annotated[NDArray[numpy.bool_], dict(shape=(None,), order='C', device='cpu', writable=False)]) -> Annotated[NDArray[numpy.int32], dict(shape=(None,))]:
    """
    Colour the chosen nodes (n,) bool so that two of one hex never share a colour, greedily in node order.

    Returns (n,) int32, -1 for nodes that were not chosen.
    """

def grouped(colour: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], count: int) -> tuple[Annotated[NDArray[numpy.int32], dict(shape=(None,))], Annotated[NDArray[numpy.int32], dict(shape=(None,))]]:
    """
    Nodes grouped by colour, each group in node order: (start (count + 1,), nodes), both int32.
    """
