"""
Distances between a boundary that moves and the surface that it had, as terms of an energy.
"""

from typing import Annotated, overload

import numpy
from numpy.typing import NDArray

import hexmend.kernels.closest_point


class FitSamples:
    """Samples of a boundary and of its surface."""

    def __init__(self, nodes: Annotated[NDArray[numpy.int32], dict(shape=(None, 4), order='C', device='cpu', writable=False)], first: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order='C', device='cpu', writable=False)], slots: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], roots: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], surface: hexmend.kernels.closest_point.ClosestPointCache, directions: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order='C', device='cpu', writable=False)], faces: Annotated[NDArray[numpy.int32], dict(shape=(None, 4), order='C', device='cpu', writable=False)]) -> None:
        """
        nodes (s, 4) int32: a sample is their mean; first (s, 3): where it was on the surface; slots (s,) int32 in
        the cache of the surface, -1 for a sample that is compared with `first` alone; roots (s,) int32 of its
        curve or patch in the trees of the boundary; directions (p, 3): unit normal or tangent of each piece of
        the surface; faces (f, 4) int32, whose centres are the vertices after the nodes. Arrays are not copied.
        """

def distances(samples: FitSamples, moving: hexmend.kernels.closest_point.BoxTrees, rows: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], known: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu')], distances: Annotated[NDArray[numpy.float64], dict(shape=(None,), order='C', device='cpu')], vectors: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order='C', device='cpu')], directions: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order='C', device='cpu')], nodes: Annotated[NDArray[numpy.int32], dict(shape=(None, 4), order='C', device='cpu')], weights: Annotated[NDArray[numpy.float64], dict(shape=(None, 4), order='C', device='cpu')]) -> None:
    """
    Write of all samples, s of the boundary and then t of the surface, the distances (s + t,) from the other,
    the vectors (s + t, 3) that grow as the boundary moves along them, the unit normal or tangent there, and
    the nodes (s + t, 4) int32 that move with it with their weights (s + t, 4).

    moving: trees of the boundary as it is, with boxes that are up to date. rows (k,) int32: those that are
    written, each once. known (t,) int32: a piece near each sample of the surface, the first t of the boundary
    as it was, -1 for none; it is written.
    """

def add_gradient(nodes: Annotated[NDArray[numpy.int32], dict(shape=(None, 4), order='C', device='cpu', writable=False)], weights: Annotated[NDArray[numpy.float64], dict(shape=(None, 4), order='C', device='cpu', writable=False)], vectors: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order='C', device='cpu', writable=False)], gradient: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order='C', device='cpu')]) -> None:
    """
    Add vectors (k, 3), times the weights (k, 4) of their nodes (k, 4) int32, to the rows of gradient (n, 3).
    """

@overload
def hessian(slots: Annotated[NDArray[numpy.int32], dict(shape=(None, 4), order='C', device='cpu', writable=False)], distances: Annotated[NDArray[numpy.float64], dict(shape=(None,), order='C', device='cpu')], vectors: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order='C', device='cpu')], directions: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order='C', device='cpu')], weights: Annotated[NDArray[numpy.float64], dict(shape=(None, 4), order='C', device='cpu')], first: Annotated[NDArray[numpy.float64], dict(shape=(None,), order='C', device='cpu', writable=False)], second: Annotated[NDArray[numpy.float64], dict(shape=(None,), order='C', device='cpu', writable=False)], of_line: Annotated[NDArray[numpy.bool_], dict(shape=(None,), order='C', device='cpu', writable=False)], row_start: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], columns: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], off_diagonal: Annotated[NDArray[numpy.float32], dict(shape=(None, 9), order='C', device='cpu')], diagonal: Annotated[NDArray[numpy.float32], dict(shape=(None, 6), order='C', device='cpu')]) -> None: ...

@overload
def hessian(slots: Annotated[NDArray[numpy.int32], dict(shape=(None, 4), order='C', device='cpu', writable=False)], distances: Annotated[NDArray[numpy.float64], dict(shape=(None,), order='C', device='cpu')], vectors: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order='C', device='cpu')], directions: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order='C', device='cpu')], weights: Annotated[NDArray[numpy.float64], dict(shape=(None, 4), order='C', device='cpu')], first: Annotated[NDArray[numpy.float64], dict(shape=(None,), order='C', device='cpu', writable=False)], second: Annotated[NDArray[numpy.float64], dict(shape=(None,), order='C', device='cpu', writable=False)], of_line: Annotated[NDArray[numpy.bool_], dict(shape=(None,), order='C', device='cpu', writable=False)], row_start: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], columns: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], off_diagonal: Annotated[NDArray[numpy.float64], dict(shape=(None, 9), order='C', device='cpu')], diagonal: Annotated[NDArray[numpy.float64], dict(shape=(None, 6), order='C', device='cpu')]) -> None:
    """
    Add second derivatives of samples to a matrix, see `assembly.assemble`.

    slots (k, 4) int32 of their nodes, -1 for none; distances, vectors, directions and weights as they are
    written by `distances`; first and second (k,): derivatives of the cost by the distance, the first divided
    by it; of_line (k,) bool: near a line or a point, else near a plane; row_start and columns of the blocks
    above the diagonal.
    """
