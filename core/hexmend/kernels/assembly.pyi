"""The Hessian of a mesh's energy, assembled."""

from typing import Annotated, overload

import numpy
from numpy.typing import NDArray


@overload
def assemble(points: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order='C', device='cpu', writable=False)], delta: float, power: tuple[float, float], left_out: Annotated[NDArray[numpy.uint8], dict(shape=(None,), order='C', device='cpu', writable=False)], bounds: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], start: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], chosen: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], hexes: Annotated[NDArray[numpy.int32], dict(shape=(None, 8), order='C', device='cpu', writable=False)], slots: Annotated[NDArray[numpy.int32], dict(shape=(None, 8), order='C', device='cpu', writable=False)], target: Annotated[NDArray[numpy.int32], dict(shape=(None, 28), order='C', device='cpu', writable=False)], off: Annotated[NDArray[numpy.float32], dict(shape=(None, 9), order='C', device='cpu')], diagonal: Annotated[NDArray[numpy.float32], dict(shape=(None, 6), order='C', device='cpu')]) -> None: ...

@overload
def assemble(points: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order='C', device='cpu', writable=False)], delta: float, power: tuple[float, float], left_out: Annotated[NDArray[numpy.uint8], dict(shape=(None,), order='C', device='cpu', writable=False)], bounds: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], start: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], chosen: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], hexes: Annotated[NDArray[numpy.int32], dict(shape=(None, 8), order='C', device='cpu', writable=False)], slots: Annotated[NDArray[numpy.int32], dict(shape=(None, 8), order='C', device='cpu', writable=False)], target: Annotated[NDArray[numpy.int32], dict(shape=(None, 28), order='C', device='cpu', writable=False)], off: Annotated[NDArray[numpy.float64], dict(shape=(None, 9), order='C', device='cpu')], diagonal: Annotated[NDArray[numpy.float64], dict(shape=(None, 6), order='C', device='cpu')]) -> None:
    """
    Assemble the Hessian of sum eta(H)^p: add it to off and diagonal, in their precision.

    Slots are shared out, and each share takes all hexes at its slots: some hexes are computed twice, and every
    block is the sum over its hexes in one order, however many shares there are.

    left_out: bit t set: corner tetrahedron t of the hex is left out, as if it were perfect. The slots of share
    k are those from bounds[k] to bounds[k + 1], its hexes those from start[k] to start[k + 1] of: chosen, their
    numbers; hexes (.., 8); slots (.., 8), -1 where a corner is fixed; target (.., 28), from `couplings.pattern`.
    off (blocks + 1, 9): blocks above the diagonal, by rows, and one that is none. diagonal (k, 6): xx xy xz
    yy yz zz.
    """
