"""Connectivity of a mesh, as sweeps take it."""

from typing import Annotated

import numpy
from numpy.typing import NDArray


class HexMesh:
    """Hexes, and the corners of hexes at each node."""

    def __init__(self, hexes: Annotated[NDArray[numpy.int32], dict(shape=(None, 8), order='C', device='cpu', writable=False)], start: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], corners: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)]) -> None:
        """
        hexes (m, 8) int32; start (n + 1,) and corners (8 m,) int32: `incidence.node_corners`.
        """
