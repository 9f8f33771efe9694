"""
Barrier of floors: of the scaled Jacobians at the corners of hexes, and of their qualities.
"""

from typing import Annotated, overload

import numpy
from numpy.typing import NDArray

import hexmend.kernels.assembly
import hexmend.kernels.target


class Floors:
    """
    Floors of the hexes of a mesh, with the weight and the bands of their barrier.
    """

    def __init__(self, jacobians: Annotated[NDArray[numpy.float64], dict(shape=(None,), order='C', device='cpu', writable=False)], qualities: Annotated[NDArray[numpy.float64], dict(shape=(None,), order='C', device='cpu', writable=False)], ignored: Annotated[NDArray[numpy.uint8], dict(shape=(None,), order='C', device='cpu', writable=False)], jacobian_band: float, quality_band: float, weight: float) -> None:
        """
        Floors jacobians (m,) of the scaled Jacobians and qualities (m,) of q(H), -inf where there is none;
        bit t of ignored (m,) uint8: corner t has no floor. The barrier begins a band above the floor.
        """

def qualities(points: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order='C', device='cpu', writable=False)], hexes: Annotated[NDArray[numpy.int32], dict(shape=(None, 8), order='C', device='cpu', writable=False)], omitted: Annotated[NDArray[numpy.uint8], dict(shape=(None,), order='C', device='cpu', writable=False)], values: Annotated[NDArray[numpy.float64], dict(shape=(None,), order='C', device='cpu')], target: hexmend.kernels.target.TargetMatrices | None = None) -> None:
    """
    q(H) of every hex, with a target that of S W^-1, omitted corners as perfect; writes values (m,).
    """

def values(points: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order='C', device='cpu', writable=False)], hexes: Annotated[NDArray[numpy.int32], dict(shape=(None, 8), order='C', device='cpu', writable=False)], floors: Floors, omitted: Annotated[NDArray[numpy.uint8], dict(shape=(None,), order='C', device='cpu', writable=False)], values: Annotated[NDArray[numpy.float64], dict(shape=(None,), order='C', device='cpu')], target: hexmend.kernels.target.TargetMatrices | None = None) -> None:
    """
    The barrier of every hex; writes values (m,); inf for a hex at or below a floor.
    """

def add_gradient(points: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order='C', device='cpu', writable=False)], hexes: Annotated[NDArray[numpy.int32], dict(shape=(None, 8), order='C', device='cpu', writable=False)], floors: Floors, omitted: Annotated[NDArray[numpy.uint8], dict(shape=(None,), order='C', device='cpu', writable=False)], shares: Annotated[NDArray[numpy.float64], dict(shape=(None, 8, 3), order='C', device='cpu')], target: hexmend.kernels.target.TargetMatrices | None = None) -> None:
    """
    Add the derivatives of the barrier by the corners of every hex to shares (m, 8, 3).
    """

@overload
def assemble(points: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order='C', device='cpu', writable=False)], floors: Floors, omitted: Annotated[NDArray[numpy.uint8], dict(shape=(None,), order='C', device='cpu', writable=False)], shares: hexmend.kernels.assembly.HexShares, off_diagonal: Annotated[NDArray[numpy.float32], dict(shape=(None, 9), order='C', device='cpu')], diagonal: Annotated[NDArray[numpy.float32], dict(shape=(None, 6), order='C', device='cpu')], target: hexmend.kernels.target.TargetMatrices | None = None) -> None: ...

@overload
def assemble(points: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order='C', device='cpu', writable=False)], floors: Floors, omitted: Annotated[NDArray[numpy.uint8], dict(shape=(None,), order='C', device='cpu', writable=False)], shares: hexmend.kernels.assembly.HexShares, off_diagonal: Annotated[NDArray[numpy.float64], dict(shape=(None, 9), order='C', device='cpu')], diagonal: Annotated[NDArray[numpy.float64], dict(shape=(None, 6), order='C', device='cpu')], target: hexmend.kernels.target.TargetMatrices | None = None) -> None:
    """
    Add the second derivatives of the barrier to off_diagonal and diagonal; see `assembly.assemble`.
    """
