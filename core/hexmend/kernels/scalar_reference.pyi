"""
Scalar reference of the kernels: the same formulas without vectors, one hex after another.
"""

from typing import Annotated

import numpy
from numpy.typing import NDArray

import hexmend.kernels.hex_mesh
import hexmend.kernels.local
import hexmend.kernels.target


def energies(points: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order='C', device='cpu', writable=False)], hexes: Annotated[NDArray[numpy.int32], dict(shape=(None, 8), order='C', device='cpu', writable=False)], delta: float, offset: float, omitted: Annotated[NDArray[numpy.uint8], dict(shape=(None,), order='C', device='cpu', writable=False)], eta: Annotated[NDArray[numpy.float64], dict(shape=(None,), order='C', device='cpu')], target: hexmend.kernels.target.TargetMatrices | None = None) -> None:
    """As `objective.energies`."""

def gradient(points: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order='C', device='cpu', writable=False)], hexes: Annotated[NDArray[numpy.int32], dict(shape=(None, 8), order='C', device='cpu', writable=False)], delta: float, norm: tuple[float, float], omitted: Annotated[NDArray[numpy.uint8], dict(shape=(None,), order='C', device='cpu', writable=False)], shares: Annotated[NDArray[numpy.float64], dict(shape=(None, 8, 3), order='C', device='cpu')], target: hexmend.kernels.target.TargetMatrices | None = None) -> None:
    """As `objective.gradient`."""

def hessian_product(points: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order='C', device='cpu', writable=False)], hexes: Annotated[NDArray[numpy.int32], dict(shape=(None, 8), order='C', device='cpu', writable=False)], slots: Annotated[NDArray[numpy.int32], dict(shape=(None, 8), order='C', device='cpu', writable=False)], values: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order='C', device='cpu', writable=False)], delta: float, norm: tuple[float, float], omitted: Annotated[NDArray[numpy.uint8], dict(shape=(None,), order='C', device='cpu', writable=False)], shares: Annotated[NDArray[numpy.float64], dict(shape=(None, 8, 3), order='C', device='cpu')], target: hexmend.kernels.target.TargetMatrices | None = None) -> None:
    """As `objective.hessian_product`."""

def sweep(points: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order='C', device='cpu')], mesh: hexmend.kernels.hex_mesh.HexMesh, groups: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], nodes: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], settings: hexmend.kernels.local.NodeStepSettings) -> int:
    """As `local.sweep`."""
