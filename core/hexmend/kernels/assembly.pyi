"""Assembly of the Hessian of a mesh's energy."""

from typing import Annotated, overload

import numpy
from numpy.typing import NDArray


@overload
def assemble(points: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order='C', device='cpu', writable=False)], delta: float, power: tuple[float, float], left_out: Annotated[NDArray[numpy.uint8], dict(shape=(None,), order='C', device='cpu', writable=False)], bounds: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], start: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], chosen: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], hexes: Annotated[NDArray[numpy.int32], dict(shape=(None, 8), order='C', device='cpu', writable=False)], slots: Annotated[NDArray[numpy.int32], dict(shape=(None, 8), order='C', device='cpu', writable=False)], target: Annotated[NDArray[numpy.int32], dict(shape=(None, 28), order='C', device='cpu', writable=False)], off: Annotated[NDArray[numpy.float32], dict(shape=(None, 9), order='C', device='cpu')], diagonal: Annotated[NDArray[numpy.float32], dict(shape=(None, 6), order='C', device='cpu')]) -> None: ...

@overload
def assemble(points: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order='C', device='cpu', writable=False)], delta: float, power: tuple[float, float], left_out: Annotated[NDArray[numpy.uint8], dict(shape=(None,), order='C', device='cpu', writable=False)], bounds: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], start: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], chosen: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], hexes: Annotated[NDArray[numpy.int32], dict(shape=(None, 8), order='C', device='cpu', writable=False)], slots: Annotated[NDArray[numpy.int32], dict(shape=(None, 8), order='C', device='cpu', writable=False)], target: Annotated[NDArray[numpy.int32], dict(shape=(None, 28), order='C', device='cpu', writable=False)], off: Annotated[NDArray[numpy.float64], dict(shape=(None, 9), order='C', device='cpu')], diagonal: Annotated[NDArray[numpy.float64], dict(shape=(None, 6), order='C', device='cpu')]) -> None:
    """
    Add the Hessian of sum eta(H)^p to off and diagonal, in their precision.

    Slots are divided into shares that are assembled in parallel. Each share computes all hexes at its slots, some
    of them twice, so that every block is summed over its hexes in one order for any number of shares. The slots of
    share k are bounds[k] to bounds[k + 1] - 1; its hexes are numbers start[k] to start[k + 1] - 1 of chosen, their
    numbers in the mesh; hexes (.., 8); slots (.., 8), -1 where a corner is fixed; target (.., 28), from
    `sparsity.pattern`. Bit t of left_out is set where corner tetrahedron t of a hex is omitted.
    off (blocks + 1, 9): blocks above the diagonal, by rows, and an unused one. diagonal (k, 6): xx xy xz yy yz zz.
    """
