"""One line-searched step per free node: Algorithm 3.2."""

from collections.abc import Sequence
from typing import Annotated

import numpy
from numpy.typing import NDArray


STEEPEST_DESCENT: int = 0

NEWTON: int = 1

MODIFIED_NEWTON: int = 2

MOVED: int = 0

NO_DESCENT: int = 1

FLAT: int = 2

INFINITE: int = 3

def sweep(points: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order='C', device='cpu')], hexes: Annotated[NDArray[numpy.int32], dict(shape=(None, 8), order='C', device='cpu', writable=False)], start: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], corners: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], groups: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], nodes: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], direction: int, delta: float, power: tuple[float, float], first: float, shrink: float, c1: float, cuts: int) -> int:
    """
    Move every node of `nodes` once, in place: one pass of Algorithm 3.2.

    Group k is nodes[groups[k]:groups[k + 1]]. Nodes of one group share no hex, so that each sees the others
    where they stay: the result is that of a sequential sweep, whatever the number of threads. delta is meant
    for the patch scaled to mean edge length 1; power is (p, offset) of the objective; first, shrink, c1 and cuts
    are those of the line search, A.5. Returns how often its trial steps asked a hex for its energy.
    """

def look(points: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order='C', device='cpu', writable=False)], hexes: Annotated[NDArray[numpy.int32], dict(shape=(None, 8), order='C', device='cpu', writable=False)], star: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], factor: float, delta: float, power: tuple[float, float]) -> tuple[float, float, list[float], list[float]]:
    """
    What a visit of `sweep` begins with, at the node that the corners `star` (8 * hex + corner) share.

    Lengths are multiplied by `factor`; if that is 0, so that the patch's mean edge is 1. Returns the factor,
    0 if the patch has no extent; the value; its gradient; second derivatives xx xy xz yy yz zz.
    """

def visit(points: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order='C', device='cpu', writable=False)], hexes: Annotated[NDArray[numpy.int32], dict(shape=(None, 8), order='C', device='cpu', writable=False)], star: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], direction: int, delta: float, power: tuple[float, float], first: float, shrink: float, c1: float, cuts: int) -> tuple[int, list[float], float, bool, float, float, list[float], Annotated[NDArray[numpy.float64], dict(shape=(None, 3))]]:
    """
    What `sweep` does at one node, that the corners `star` (8 * hex + corner) share; it moves nothing.

    Returns the verdict (MOVED, NO_DESCENT, FLAT, INFINITE); the direction, its slope, whether it fell back to
    steepest descent, what A.4 added to the eigenvalues; the accepted step and the place that it leads to; and
    alpha, energy and bound of each trial, (trials, 3). Where the verdict is FLAT or INFINITE, there is no
    direction; a place only where it is MOVED. The direction is in lengths so that the patch's mean edge is 1.
    """

def along(points: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order='C', device='cpu', writable=False)], hexes: Annotated[NDArray[numpy.int32], dict(shape=(None, 8), order='C', device='cpu', writable=False)], star: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], factor: float, direction: Sequence[float], delta: float, power: tuple[float, float], curve: Annotated[NDArray[numpy.float64], dict(shape=(None, 2), order='C', device='cpu')]) -> None:
    """
    Write the patch's energy at curve[:, 0] times a direction to curve[:, 1].
    """
