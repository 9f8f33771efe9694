"""
Values of hexes, of_hexes (m,) float64, from values at their nodes, of_nodes (n,) float64. The functions
run on one thread, because the window's thread calls them.
"""

from typing import Annotated

import numpy
from numpy.typing import NDArray


def largest(hexes: Annotated[NDArray[numpy.int32], dict(shape=(None, 8), order='C', device='cpu', writable=False)], of_nodes: Annotated[NDArray[numpy.float64], dict(shape=(None,), order='C', device='cpu', writable=False)], of_hexes: Annotated[NDArray[numpy.float64], dict(shape=(None,), order='C', device='cpu')]) -> None:
    """The largest of the eight values."""

def mean(hexes: Annotated[NDArray[numpy.int32], dict(shape=(None, 8), order='C', device='cpu', writable=False)], of_nodes: Annotated[NDArray[numpy.float64], dict(shape=(None,), order='C', device='cpu', writable=False)], of_hexes: Annotated[NDArray[numpy.float64], dict(shape=(None,), order='C', device='cpu')]) -> None:
    """The mean of the eight values."""
