"""Valence of edges, from which the block structure of a mesh follows."""

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
