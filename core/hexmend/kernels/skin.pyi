"""
Visible faces of a mesh of which the hexes with keep (m,) bool are shown. The functions run on one
thread, because the window's thread calls them.
"""

from typing import Annotated

import numpy
from numpy.typing import NDArray


def visible(nodes: int, hexes: Annotated[NDArray[numpy.int32], dict(shape=(None, 8), order='C', device='cpu', writable=False)], neighbours: Annotated[NDArray[numpy.int32], dict(shape=(None, 6), order='C', device='cpu', writable=False)], keep: Annotated[NDArray[numpy.bool_], dict(shape=(None,), order='C', device='cpu', writable=False)]) -> tuple[Annotated[NDArray[numpy.int32], dict(shape=(None,))], Annotated[NDArray[numpy.int32], dict(shape=(None, 4))], Annotated[NDArray[numpy.int32], dict(shape=(None,))]]:
    """
    Faces of shown hexes behind which no hex is shown.

    nodes is the number of nodes of the mesh; neighbours (m, 6) int32 the hex behind each face, -1 for
    none. Returns the nodes of these faces (u,), the faces as positions among them (k, 4), and the hex of
    each (k,), all int32.
    """

def edges_kept(hexes: Annotated[NDArray[numpy.int32], dict(shape=(None, 8), order='C', device='cpu', writable=False)], start: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], corners: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], edges: Annotated[NDArray[numpy.int32], dict(shape=(None, 2), order='C', device='cpu', writable=False)], keep: Annotated[NDArray[numpy.bool_], dict(shape=(None,), order='C', device='cpu', writable=False)], answer: Annotated[NDArray[numpy.bool_], dict(shape=(None,), order='C', device='cpu')]) -> None:
    """
    Edges (k, 2) int32 that a shown hex has; writes answer (k,) bool.

    start, corners: `Topology.node_corners`.
    """
