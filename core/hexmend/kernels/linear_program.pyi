"""Linear program of a step of sequential linear programming."""

from typing import Annotated

import numpy
from numpy.typing import NDArray


def rows(nodes: Annotated[NDArray[numpy.int32], dict(shape=(None, 4), order='C', device='cpu', writable=False)], slopes: Annotated[NDArray[numpy.float64], dict(shape=(None, 12), order='C', device='cpu', writable=False)], gains: Annotated[NDArray[numpy.float64], dict(shape=(None,), order='C', device='cpu', writable=False)], index: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], first: Annotated[NDArray[numpy.int64], dict(shape=(None,), order='C', device='cpu', writable=False)], displacements: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order='C', device='cpu', writable=False)], columns: Annotated[NDArray[numpy.int64], dict(shape=(None,), order='C', device='cpu', writable=False)], gain_column: int) -> tuple[Annotated[NDArray[numpy.int64], dict(shape=(None,))], Annotated[NDArray[numpy.int64], dict(shape=(None,))], Annotated[NDArray[numpy.float64], dict(shape=(None,))]]:
    """
    Rows of the program, one for each of r linear models of values that depend on four nodes.

    A row has minus the slope of its value along each direction of its nodes, in the column of the direction,
    and its gain in the last place, in gain_column. nodes (r, 4) int32, which must exist; slopes (r, 12) by
    their places; gains (r,). index (n,) int32 numbers the nodes with directions, -1 for others: those of
    number k are rows first[k]:first[k + 1] of displacements (w, 3) and of their columns (w,) int64; first
    (k + 1,) int64. Returns where each row begins, (r + 1,) int64, its columns, int64, and values. A node that
    a model has twice counts once, with the sum of its slopes.
    """
