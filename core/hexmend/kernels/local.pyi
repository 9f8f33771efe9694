"""
Local optimisation: one line-searched step at each free node, Algorithm 3.2.
"""

from collections.abc import Sequence
import enum
from typing import Annotated

import numpy
from numpy.typing import NDArray

import hexmend.kernels.hex_mesh
import hexmend.kernels.line_search
import hexmend.kernels.sliding_surface
import hexmend.kernels.target


class Direction(enum.Enum):
    """Search direction."""

    STEEPEST_DESCENT = 0
    """Algorithm A.2."""

    NEWTON = 1
    """Algorithm A.3."""

    MODIFIED_NEWTON = 2
    """Algorithm A.4."""

class StepStatus(enum.Enum):
    """Result of a step at a node."""

    MOVED = 0
    """The node moved."""

    NO_DESCENT = 1
    """No step descended."""

    FLAT = 2
    """The gradient is 0, or the patch has no extent."""

    INFINITE = 3
    """The energy is infinite."""

class NodeStepSettings:
    """Settings of a step at a node."""

    def __init__(self, direction: Direction, delta: float, norm: tuple[float, float], search: hexmend.kernels.line_search.LineSearch, target: hexmend.kernels.target.TargetMatrices | None = None) -> None:
        """
        delta applies to the patch scaled to mean edge length 1, with a target to S W^-1; norm is (p, offset)
        of the objective.
        """

def sweep(points: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order='C', device='cpu')], mesh: hexmend.kernels.hex_mesh.HexMesh, groups: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], nodes: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], settings: NodeStepSettings, surface: hexmend.kernels.sliding_surface.SlidingSurface | None = None, tangents: Annotated[NDArray[numpy.float64], dict(shape=(None, 6), order='C', device='cpu', writable=False)] | None = None, term: hexmend.kernels.sliding_surface.SurfaceTerm | None = None) -> int:
    """
    Move each of `nodes` once, in place: one pass of Algorithm 3.2.

    points (n, 3) float64, changed. Group k is nodes[groups[k]:groups[k + 1]]; nodes of one group share no
    hex, so that the result is that of a sequential sweep for any number of threads. With a surface, nodes
    that slide step along it: T'g and T'HT are the derivatives, tangents (k, 6) float64 the two unit tangents
    T of each, the second 0 on a curve, and the line search evaluates the energy at projected points. With a
    term the quads of the surface count in their objective.

    Returns the number of evaluations of a hex's energy in line searches.
    """

class PatchEnergy:
    """Energy of a node's patch, its gradient and Hessian by the node."""

    @property
    def factor(self) -> float:
        """Factor by which lengths are multiplied; 0 for a patch without extent."""

    @property
    def value(self) -> float: ...

    @property
    def gradient(self) -> list[float]: ...

    @property
    def hessian(self) -> list[float]:
        """xx, xy, xz, yy, yz, zz"""

def patch_energy(points: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order='C', device='cpu', writable=False)], hexes: Annotated[NDArray[numpy.int32], dict(shape=(None, 8), order='C', device='cpu', writable=False)], star: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], factor: float, delta: float, norm: tuple[float, float], target: hexmend.kernels.target.TargetMatrices | None = None) -> PatchEnergy:
    """
    Energy of the patch of the node whose corners are star (k,) int32, 8 * hex + corner each.

    Lengths are multiplied by `factor`, or scaled to mean edge length 1 where it is 0, with a target to unit
    root mean square of the inverse lengths.
    """

class RecordedStep:
    """A step at one node, in mean edge lengths of its patch."""

    @property
    def status(self) -> StepStatus: ...

    @property
    def direction(self) -> list[float]:
        """0 where the status is FLAT or INFINITE"""

    @property
    def slope(self) -> float:
        """Derivative of the energy along the direction."""

    @property
    def fallback(self) -> bool:
        """True if Newton's direction did not descend: steepest descent."""

    @property
    def shift(self) -> float:
        """Shift of the eigenvalues by Algorithm A.4."""

    @property
    def alpha(self) -> float:
        """Accepted step length; 0 for none."""

    @property
    def place(self) -> list[float]:
        """The point that the step leads to, if the node MOVED."""

    @property
    def trials(self) -> Annotated[NDArray[numpy.float64], dict(shape=(None, 3))]:
        """alpha, energy and bound of each trial, (trials, 3); a copy."""

def recorded_step(points: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order='C', device='cpu', writable=False)], hexes: Annotated[NDArray[numpy.int32], dict(shape=(None, 8), order='C', device='cpu', writable=False)], star: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], settings: NodeStepSettings) -> RecordedStep:
    """
    The step that `sweep` takes at the node whose corners are star (k,) int32; moves nothing.
    """

def energy_along(points: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order='C', device='cpu', writable=False)], hexes: Annotated[NDArray[numpy.int32], dict(shape=(None, 8), order='C', device='cpu', writable=False)], star: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], factor: float, direction: Sequence[float], delta: float, norm: tuple[float, float], curve: Annotated[NDArray[numpy.float64], dict(shape=(None, 2), order='C', device='cpu')], target: hexmend.kernels.target.TargetMatrices | None = None) -> None:
    """
    Energy of a patch along a direction (3,): writes the value at step length curve[:, 0] to curve[:, 1].

    star and factor: those of `patch_energy`.
    """
