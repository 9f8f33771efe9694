"""Assembly of the Hessian of a mesh's energy."""

from typing import Annotated, overload

import numpy
from numpy.typing import NDArray

import hexmend.kernels.target


class HexShares:
    """
    Slots divided into shares that are assembled in parallel, with the hexes at the slots
    of each.

    Each share computes all its hexes, some of which are in several, so that every block is
    summed over its hexes in one order for any number of shares.
    """

    def __init__(self, bounds: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], start: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], numbers: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], hexes: Annotated[NDArray[numpy.int32], dict(shape=(None, 8), order='C', device='cpu', writable=False)], slots: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], row_start: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], columns: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)]) -> None:
        """
        Slots of share k: bounds[k] to bounds[k + 1] - 1; its hexes: start[k] to start[k + 1] - 1 of numbers,
        in the mesh, int32. hexes (m, 8) int32 of the mesh; slots (n,) int32 of its nodes, -1 for fixed ones;
        row_start (k + 1,) and columns (blocks,) int32: `sparsity.pattern`.
        """

@overload
def assemble(points: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order='C', device='cpu', writable=False)], delta: float, norm: tuple[float, float], omitted: Annotated[NDArray[numpy.uint8], dict(shape=(None,), order='C', device='cpu', writable=False)], shares: HexShares, off_diagonal: Annotated[NDArray[numpy.float32], dict(shape=(None, 9), order='C', device='cpu')], diagonal: Annotated[NDArray[numpy.float32], dict(shape=(None, 6), order='C', device='cpu')], target: hexmend.kernels.target.TargetMatrices | None = None) -> None: ...

@overload
def assemble(points: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order='C', device='cpu', writable=False)], delta: float, norm: tuple[float, float], omitted: Annotated[NDArray[numpy.uint8], dict(shape=(None,), order='C', device='cpu', writable=False)], shares: HexShares, off_diagonal: Annotated[NDArray[numpy.float64], dict(shape=(None, 9), order='C', device='cpu')], diagonal: Annotated[NDArray[numpy.float64], dict(shape=(None, 6), order='C', device='cpu')], target: hexmend.kernels.target.TargetMatrices | None = None) -> None:
    """
    Add the Hessian of sum eta(H)^p to off_diagonal and diagonal, in their precision.

    Bit t of omitted (m,) uint8 is set where corner tetrahedron t of a hex is omitted. off_diagonal (blocks +
    1, 9): blocks above the diagonal, by rows, and an unused one. diagonal (k, 6): xx xy xz yy yz zz.
    """

def assemble_packed(points: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order='C', device='cpu', writable=False)], delta: float, norm: tuple[float, float], omitted: Annotated[NDArray[numpy.uint8], dict(shape=(None,), order='C', device='cpu', writable=False)], shares: HexShares, first_separator: int, off_diagonal: Annotated[NDArray[numpy.int16], dict(shape=(None, 12), order='C', device='cpu')], diagonal: Annotated[NDArray[numpy.float32], dict(shape=(None, 6), order='C', device='cpu')], target: hexmend.kernels.target.TargetMatrices | None = None) -> None:
    """
    Write the Hessian of sum eta(H)^p above the diagonal to off_diagonal (blocks + 1, 12) int16, packed.

    A block has nine whole numbers of 20 bits, by rows, and a power of two that they are multiplied by: each is
    rounded by at most 2^-19 of the largest. What belongs to fixed nodes is added to diagonal (k, 6) float32;
    `conjugate_gradients.complete_diagonal` adds the rest. Slots from first_separator on are those of
    separators, the last of which may be ghosts; see `assemble`.
    """
