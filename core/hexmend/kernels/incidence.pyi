"""
Who touches whom: nodes and hexes, faces, edges, colours. All linear in the number of hexes.
"""

from typing import Annotated

import numpy
from numpy.typing import NDArray


def node_corners(hexes: Annotated[NDArray[numpy.int32], dict(shape=(None, 8), order='C', device='cpu', writable=False)], n: int) -> tuple[Annotated[NDArray[numpy.int32], dict(shape=(None,))], Annotated[NDArray[numpy.int32], dict(shape=(None,))]]:
    """
    Corners of hexes at each of n nodes, as compressed rows (start (n + 1,), corners (8 m,)), both int32.

    Row i is corners[start[i]:start[i + 1]]: numbers 8 * hex + corner, ascending.
    """

def face_neighbours(hexes: Annotated[NDArray[numpy.int32], dict(shape=(None, 8), order='C', device='cpu', writable=False)], start: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], corners: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)]) -> tuple[Annotated[NDArray[numpy.int32], dict(shape=(None, 6))], int]:
    """
    The hex behind each face, (m, 6) int32, and how many faces are crowded; start, corners: `node_corners`.

    -1 where there is no hex, or where more than two share the face. Those are crowded, a defect of the mesh,
    counted once a hex. A face belongs to its lowest node; there those of equal nodes are paired.
    """

def components(hexes: Annotated[NDArray[numpy.int32], dict(shape=(None, 8), order='C', device='cpu', writable=False)], used: Annotated[NDArray[numpy.bool_], dict(shape=(None,), order='C', device='cpu', writable=False)]) -> int:
    """
    How many parts, hanging together by nodes, the used nodes (n,) bool are in.
    """

def node_rings(hexes: Annotated[NDArray[numpy.int32], dict(shape=(None, 8), order='C', device='cpu', writable=False)], start: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], corners: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], most: int = 2147483647) -> tuple[Annotated[NDArray[numpy.int32], dict(shape=(None,))], Annotated[NDArray[numpy.int32], dict(shape=(None,))]]:
    """
    Edge neighbours of each node, ascending, as compressed rows (ring_start (n + 1,), ring), both int32.

    OverflowError where the rows have more than `most` items.
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

def layers(neighbours: Annotated[NDArray[numpy.int32], dict(shape=(None, 6), order='C', device='cpu', writable=False)]) -> Annotated[NDArray[numpy.int32], dict(shape=(None,))]:
    """
    How many hexes lie between each hex and the boundary, counted through faces, breadth first; (m,) int32.

    0 for a hex with a boundary face; one more than the deepest layer where no way leads to the boundary.
    """

def around(hexes: Annotated[NDArray[numpy.int32], dict(shape=(None, 8), order='C', device='cpu', writable=False)], start: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], corners: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], chosen: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], rings: int) -> Annotated[NDArray[numpy.bool_], dict(shape=(None,))]:
    """
    True for the hexes `chosen` (k,) int32 and those reached from them in so many steps from hex to hex
    through a common node; (m,) bool.
    """
