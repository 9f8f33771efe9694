"""
Conjugate gradients with an assembled Hessian, preconditioned by symmetric Gauss-Seidel.
"""

import enum
from typing import Annotated, overload

import numpy
from numpy.typing import NDArray


class SolveStatus(enum.Enum):
    """End of a solve."""

    DONE = 0
    """The tolerance is reached."""

    NEGATIVE_CURVATURE = 1
    """A direction of negative curvature was met."""

    TOO_MANY = 2
    """The number of iterations is exhausted."""

class BlockPattern:
    """Pattern of a symmetric matrix of 3 x 3 blocks."""

    def __init__(self, bounds: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], row_start: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], columns: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)]) -> None:
        """
        bounds (2 parts,) int32: `ordering.slots`; row_start (k + 1,) and columns (blocks,) int32: blocks
        above the diagonal, `sparsity.pattern`.
        """

class CoarsePattern:
    """Pattern of A R, R being translations of aggregates of slots."""

    def __init__(self, aggregate: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], row_start: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], columns: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)]) -> None:
        """
        aggregate (k,) int32: the aggregate of each slot; row_start (k + 1,) and columns (blocks,) int32: the
        aggregates that each row of A R meets, as `coarse_pattern` returns them.
        """

def coarse_pattern(slots: Annotated[NDArray[numpy.int32], dict(shape=(None, 8), order='C', device='cpu', writable=False)], slot_of_node: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], nodes: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], ring_start: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], ring: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], start: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], corners: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], distance: int) -> tuple[Annotated[NDArray[numpy.int32], dict(shape=(None,))], Annotated[NDArray[numpy.int32], dict(shape=(None,))], Annotated[NDArray[numpy.int32], dict(shape=(None,))]]:
    """
    Divide slots into aggregates: the arrays of a `CoarsePattern`.

    A slot is a centre if no centre before it is within `distance` edges; each slot belongs to the nearest
    centre, of several to the first. slots (m, 8): the slot of each corner, -1 if it is fixed; slot_of_node
    (n,), -1 likewise; nodes (k,): the node of each slot; ring_start, ring: `Topology.rings`; start, corners:
    `Topology.node_corners`. All are int32.
    """

def complete_diagonal(pattern: BlockPattern, off_diagonal: Annotated[NDArray[numpy.int16], dict(shape=(None, 12), order='C', device='cpu', writable=False)], diagonal: Annotated[NDArray[numpy.float32], dict(shape=(None, 6), order='C', device='cpu')]) -> int:
    """
    Add to diagonal (k, 6) float32, which `assembly.assemble_packed` began, what follows from the packed blocks
    (blocks + 1, 12): rows sum to the shares of fixed nodes. Returns the number of diagonal blocks whose
    eigenvalues differ too much for packed blocks.
    """

def coarse_workspace_size(coarse: CoarsePattern) -> int:
    """
    Numbers that `solve` needs in its workspace for a coarse space, besides `workspace_size`.
    """

def workspace_size(pattern: BlockPattern, ghosts: int = 0, coupled: bool = False) -> int:
    """
    Numbers of the workspace of `solve`; `coupled`: with `sum` and `exchange`.
    """

@overload
def solve(pattern: BlockPattern, off_diagonal: Annotated[NDArray[numpy.float32], dict(shape=(None, 9), order='C', device='cpu', writable=False)], diagonal: Annotated[NDArray[numpy.float32], dict(shape=(None, 6), order='C', device='cpu', writable=False)], damping: float, rhs: Annotated[NDArray[numpy.float32], dict(shape=(None, 4), order='C', device='cpu', writable=False)], tolerance: float, max_iterations: int, x: Annotated[NDArray[numpy.float32], dict(shape=(None, 4), order='C', device='cpu')], work: Annotated[NDArray[numpy.float32], dict(shape=(None,), order='C', device='cpu')], ghosts: int = 0, sum: object | None = None, exchange: object | None = None, coarse: CoarsePattern | None = None) -> tuple[int, SolveStatus]: ...

@overload
def solve(pattern: BlockPattern, off_diagonal: Annotated[NDArray[numpy.float64], dict(shape=(None, 9), order='C', device='cpu', writable=False)], diagonal: Annotated[NDArray[numpy.float64], dict(shape=(None, 6), order='C', device='cpu', writable=False)], damping: float, rhs: Annotated[NDArray[numpy.float64], dict(shape=(None, 4), order='C', device='cpu', writable=False)], tolerance: float, max_iterations: int, x: Annotated[NDArray[numpy.float64], dict(shape=(None, 4), order='C', device='cpu')], work: Annotated[NDArray[numpy.float64], dict(shape=(None,), order='C', device='cpu')], ghosts: int = 0, sum: object | None = None, exchange: object | None = None, coarse: CoarsePattern | None = None) -> tuple[int, SolveStatus]: ...

@overload
def solve(pattern: BlockPattern, off_diagonal: Annotated[NDArray[numpy.int16], dict(shape=(None, 12), order='C', device='cpu', writable=False)], diagonal: Annotated[NDArray[numpy.float32], dict(shape=(None, 6), order='C', device='cpu', writable=False)], damping: float, rhs: Annotated[NDArray[numpy.float32], dict(shape=(None, 4), order='C', device='cpu', writable=False)], tolerance: float, max_iterations: int, x: Annotated[NDArray[numpy.float32], dict(shape=(None, 4), order='C', device='cpu')], work: Annotated[NDArray[numpy.float32], dict(shape=(None,), order='C', device='cpu')], ghosts: int = 0, sum: object | None = None, exchange: object | None = None, coarse: CoarsePattern | None = None) -> tuple[int, SolveStatus]:
    """
    Solve A x = rhs, stopping at a direction of negative curvature (Steihaug 1983).

    At such a direction x is the iterate so far or, if it is the first, that direction. Vectors, (k, 4)
    with a fourth number 0, are in the precision of the matrix; sums over them are in double precision.

    off_diagonal (blocks + 1, 9): blocks above the diagonal, and an unused one; or (blocks + 1, 12) int16,
    packed, for vectors in single precision, see `assembly.assemble_packed`. diagonal (k, 6). damping:
    this multiple of D is added to the diagonal. tolerance: of the residual relative to the right-hand
    side, both in the norm of M^-1. work: see `workspace_size`. Writes x, which may be rhs; returns the
    iterations and the status. With `coarse` the iteration is deflated by the translations of aggregates,
    unless the matrix is not positive definite for these already; where processes share a matrix, it is not.

    Where several processes share a matrix, its columns from k on belong to ghosts, slots of other
    processes. `sum` adds a number over all processes; `exchange` is called with an array (k + ghosts, 4)
    of which it sends rows, and receives those of the ghosts. All processes call it together.
    """

@overload
def product(pattern: BlockPattern, off_diagonal: Annotated[NDArray[numpy.float32], dict(shape=(None, 9), order='C', device='cpu', writable=False)], diagonal: Annotated[NDArray[numpy.float32], dict(shape=(None, 6), order='C', device='cpu', writable=False)], order: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], x: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order='C', device='cpu', writable=False)], y: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order='C', device='cpu')]) -> None: ...

@overload
def product(pattern: BlockPattern, off_diagonal: Annotated[NDArray[numpy.float64], dict(shape=(None, 9), order='C', device='cpu', writable=False)], diagonal: Annotated[NDArray[numpy.float64], dict(shape=(None, 6), order='C', device='cpu', writable=False)], order: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], x: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order='C', device='cpu', writable=False)], y: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order='C', device='cpu')]) -> None: ...

@overload
def product(pattern: BlockPattern, off_diagonal: Annotated[NDArray[numpy.int16], dict(shape=(None, 12), order='C', device='cpu', writable=False)], diagonal: Annotated[NDArray[numpy.float32], dict(shape=(None, 6), order='C', device='cpu', writable=False)], order: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], x: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order='C', device='cpu', writable=False)], y: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order='C', device='cpu')]) -> None:
    """
    Product A x of x (k, 3) in double precision; writes y (k, 3).

    Row k of x and y belongs to slot order[k].
    """

@overload
def to_slots(of_nodes: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order='C', device='cpu', writable=False)], order: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], scale: float, of_slots: Annotated[NDArray[numpy.float32], dict(shape=(None, 4), order='C', device='cpu')]) -> None: ...

@overload
def to_slots(of_nodes: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order='C', device='cpu', writable=False)], order: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], scale: float, of_slots: Annotated[NDArray[numpy.float64], dict(shape=(None, 4), order='C', device='cpu')]) -> None:
    """
    Write vectors of nodes (k, 3), times a scale, to slots (k, 4), whose fourth number becomes 0.

    Row k of of_nodes belongs to slot order[k], int32.
    """

@overload
def from_slots(of_slots: Annotated[NDArray[numpy.float32], dict(shape=(None, 4), order='C', device='cpu', writable=False)], order: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], scale: float, of_nodes: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order='C', device='cpu')]) -> None: ...

@overload
def from_slots(of_slots: Annotated[NDArray[numpy.float64], dict(shape=(None, 4), order='C', device='cpu', writable=False)], order: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], scale: float, of_nodes: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order='C', device='cpu')]) -> None:
    """
    Write vectors of slots (k, 4), times a scale, to nodes (k, 3); see `to_slots`.
    """

@overload
def turn_blocks(turn: Annotated[NDArray[numpy.float32], dict(shape=(None, 9), order='C', device='cpu', writable=False)], at: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], rows: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], columns: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], off_diagonal: Annotated[NDArray[numpy.float32], dict(shape=(None, 9), order='C', device='cpu')]) -> None: ...

@overload
def turn_blocks(turn: Annotated[NDArray[numpy.float64], dict(shape=(None, 9), order='C', device='cpu', writable=False)], at: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], rows: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], columns: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], off_diagonal: Annotated[NDArray[numpy.float64], dict(shape=(None, 9), order='C', device='cpu')]) -> None:
    """
    Replace the blocks `at` (j,) int32, each once, by T_row^T B T_column.

    rows, columns (j,) int32: indices in turn (k, 9); off_diagonal (blocks + 1, 9). Numbers must exist.
    """

@overload
def turn_diagonal(turn: Annotated[NDArray[numpy.float32], dict(shape=(None, 9), order='C', device='cpu', writable=False)], slots: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], diagonal: Annotated[NDArray[numpy.float32], dict(shape=(None, 6), order='C', device='cpu')]) -> None: ...

@overload
def turn_diagonal(turn: Annotated[NDArray[numpy.float64], dict(shape=(None, 9), order='C', device='cpu', writable=False)], slots: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], diagonal: Annotated[NDArray[numpy.float64], dict(shape=(None, 6), order='C', device='cpu')]) -> None:
    """
    Replace the diagonal blocks D of `slots` (k,) int32, each once, by T^T D T.

    turn (k, 9): T of each; diagonal (s, 6): xx xy xz yy yz zz of each slot. Numbers must exist.
    """

@overload
def project_diagonal(projectors: Annotated[NDArray[numpy.float32], dict(shape=(None, 9), order='C', device='cpu', writable=False)], slots: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], diagonal: Annotated[NDArray[numpy.float32], dict(shape=(None, 6), order='C', device='cpu')]) -> None: ...

@overload
def project_diagonal(projectors: Annotated[NDArray[numpy.float64], dict(shape=(None, 9), order='C', device='cpu', writable=False)], slots: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], diagonal: Annotated[NDArray[numpy.float64], dict(shape=(None, 6), order='C', device='cpu')]) -> None:
    """
    Replace the diagonal blocks D of `slots` (k,) int32, each once, by P D P + size (I - P).

    projectors (k, 9): the symmetric P of each; size is the absolute mean of the eigenvalues along P, or 1 where
    it is 0 or not a number. diagonal (s, 6): xx xy xz yy yz zz of each slot. Numbers must exist.
    """
