"""
Local optimisation: one line-searched step at each free node, Algorithm 3.2.
"""

from collections.abc import Sequence
from typing import Annotated

import numpy
from numpy.typing import NDArray

import hexmend.kernels.hex_mesh
import hexmend.kernels.line_search
import hexmend.kernels.sliding_surface


STEEPEST_DESCENT: int = 0

NEWTON: int = 1

MODIFIED_NEWTON: int = 2

MOVED: int = 0

NO_DESCENT: int = 1

FLAT: int = 2

INFINITE: int = 3

class NodeStepSettings:
    """Settings of a step at a node."""

    def __init__(self, direction: int, delta: float, norm: tuple[float, float], search: hexmend.kernels.line_search.LineSearch) -> None:
        """
        direction is STEEPEST_DESCENT, NEWTON or MODIFIED_NEWTON; delta applies to the patch scaled to mean edge
        length 1; norm is (p, offset) of the objective.
        """

def sweep(points: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order='C', device='cpu')], mesh: hexmend.kernels.hex_mesh.HexMesh, groups: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], nodes: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], settings: NodeStepSettings, surface: hexmend.kernels.sliding_surface.SlidingSurface | None = None, tangents: Annotated[NDArray[numpy.float64], dict(shape=(None, 6), order='C', device='cpu', writable=False)] | None = None) -> int:
    """
    Move each of `nodes` once, in place: one pass of Algorithm 3.2.

    points (n, 3) float64, changed. Group k is nodes[groups[k]:groups[k + 1]]; nodes of one group share no hex,
    so that the result is that of a sequential sweep for any number of threads. With a surface, nodes that slide
    step along it: T'g and T'HT are the derivatives, tangents (k, 6) float64 the two unit tangents T of each, the
    second 0 on a curve, and the line search evaluates the energy at projected points.

    Returns the number of evaluations of a hex's energy in line searches.
    """

def patch_energy(points: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order='C', device='cpu', writable=False)], hexes: Annotated[NDArray[numpy.int32], dict(shape=(None, 8), order='C', device='cpu', writable=False)], star: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], factor: float, delta: float, norm: tuple[float, float]) -> tuple[float, float, list[float], list[float]]:
    """
    Energy of the patch of the node whose corners are star (k,) int32, 8 * hex + corner each.

    Lengths are multiplied by `factor`, or scaled to mean edge length 1 where it is 0. Returns the factor, 0 if
    the patch has no extent; the value; its gradient (3,); its second derivatives xx xy xz yy yz zz.
    """

def recorded_step(points: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order='C', device='cpu', writable=False)], hexes: Annotated[NDArray[numpy.int32], dict(shape=(None, 8), order='C', device='cpu', writable=False)], star: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], settings: NodeStepSettings) -> tuple[int, list[float], float, bool, float, float, list[float], Annotated[NDArray[numpy.float64], dict(shape=(None, 3))]]:
    """
    The step that `sweep` takes at the node whose corners are star (k,) int32; moves nothing.

    Returns the status (MOVED, NO_DESCENT, FLAT or INFINITE); the direction, its slope, whether it fell back to
    steepest descent, the shift of A.4; the accepted step length, 0 for none, and the point that it leads to;
    and alpha, energy and bound of each trial, (trials, 3). FLAT and INFINITE have no direction, and only MOVED
    has a point. The direction is in mean edge lengths of the patch.
    """

def energy_along(points: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order='C', device='cpu', writable=False)], hexes: Annotated[NDArray[numpy.int32], dict(shape=(None, 8), order='C', device='cpu', writable=False)], star: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], factor: float, direction: Sequence[float], delta: float, norm: tuple[float, float], curve: Annotated[NDArray[numpy.float64], dict(shape=(None, 2), order='C', device='cpu')]) -> None:
    """
    Energy of a patch along a direction (3,): writes the value at step length curve[:, 0] to curve[:, 1].

    star and factor: those of `patch_energy`.
    """
