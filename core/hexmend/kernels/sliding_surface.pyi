"""
The surface on which nodes of the boundary slide: sweeps that take one project every trial point onto it.
"""

from typing import Annotated

import numpy
from numpy.typing import NDArray

import hexmend.kernels.closest_point


class BoundaryQuads:
    """
    Quads of the boundary at the nodes that slide. A step that flips one is rejected.

    A quad is flipped if its normal points against `outward`; one that is flipped
    already may stay so.
    """

    def __init__(self, start: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], corners: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], quads: Annotated[NDArray[numpy.int32], dict(shape=(None, 4), order='C', device='cpu', writable=False)], outward: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order='C', device='cpu', writable=False)]) -> None:
        """
        corners holds 4 * quad + corner of each of k sliding nodes, from start (k + 1,) on, all int32; quads
        (f, 4) int32; outward (f, 3) float64 are normals of the original surface, 0 where it has none.
        """

class SlidingSurface:
    """Curves and patches, with the nodes that slide on them."""

    def __init__(self, slots: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], cache: hexmend.kernels.closest_point.ClosestPointCache, quads: BoundaryQuads) -> None:
        """
        slots (n,) int32 numbers the nodes that slide, -1 for others; cache has the curve or patch of each.
        """

class SurfaceTerm:
    """Term of the objective over the boundary quads of a sliding surface."""

    def __init__(self, counted: Annotated[NDArray[numpy.uint8], dict(shape=(None, 4), order='C', device='cpu', writable=False)], normals: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order='C', device='cpu', writable=False)], inverse_lengths: Annotated[NDArray[numpy.float64], dict(shape=(None, 8), order='C', device='cpu', writable=False)] | None, weight: float, delta: float) -> None:
        """
        counted (f, 4) uint8 is 0 for corners of quads that count as perfect; normals (f, 3) float64 are the
        outward unit normals of the surface at the quads; inverse_lengths (f, 8) float64 those that the
        edges from each corner to the next and the previous are to have, with a target. weight is that of a quad
        relative to a hex; delta as of hexes.
        """

def tangent_bases(number: Annotated[NDArray[numpy.int64], dict(shape=(None,), order='C', device='cpu', writable=False)], flat: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order='C', device='cpu', writable=False)], smooth: Annotated[NDArray[numpy.float64], dict(shape=(None, 9), order='C', device='cpu', writable=False)], pieces: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], weights: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order='C', device='cpu', writable=False)], of_curve: Annotated[NDArray[numpy.bool_], dict(shape=(None,), order='C', device='cpu', writable=False)], interior: float, bases: Annotated[NDArray[numpy.float64], dict(shape=(None, 9), order='C', device='cpu')]) -> None:
    """
    Write orthonormal directions in which nodes may move, in columns, bases (k, 9): a node of a curve has one,
    one of a patch two, the other columns are 0.

    pieces (k,) int32 and weights (k, 3) describe the closest points of the nodes; of_curve (k,) bool. The
    normal or tangent is that of the piece where all weights exceed `interior`, or else interpolated between
    its corners. number (p,) int64 of each piece of the trees in flat (t, 3) and smooth (t, 9), unit vectors
    of triangles and segments, and of their three corners; numbers must exist.
    """

def tangent_projectors(bases: Annotated[NDArray[numpy.float64], dict(shape=(None, 9), order='C', device='cpu', writable=False)], projectors: Annotated[NDArray[numpy.float64], dict(shape=(None, 9), order='C', device='cpu')]) -> None:
    """
    Write the projectors B B^T (k, 9) onto directions, orthonormal or 0, in the columns of bases B (k, 9).
    """

def flipped_quads(before: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order='C', device='cpu', writable=False)], after: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order='C', device='cpu', writable=False)], quads: Annotated[NDArray[numpy.int32], dict(shape=(None, 4), order='C', device='cpu', writable=False)], outward: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order='C', device='cpu', writable=False)], flipped: Annotated[NDArray[numpy.bool_], dict(shape=(None,), order='C', device='cpu')]) -> None:
    """
    Write flipped (f,) bool: True for a quad that is flipped at the points after and was not before.
    """
