"""
Sequential GETMe: the worst hex takes its element step, again and again, from a priority queue.
"""

from typing import Annotated

import numpy
from numpy.typing import NDArray

import hexmend.kernels.hex_mesh
import hexmend.kernels.sliding_surface


class WorstFirstSettings:
    """Settings of the element steps."""

    def __init__(self, scaling: float, relaxation: float, penalty: float, rejection_penalty: float) -> None:
        """
        scaling and relaxation are the scale s and the blend rho of an element step. After it the hex ranks
        as better by penalty if the step was accepted and by rejection_penalty if not, in q(H).
        """

def sweep(points: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order='C', device='cpu')], mesh: hexmend.kernels.hex_mesh.HexMesh, free: Annotated[NDArray[numpy.bool_], dict(shape=(None,), order='C', device='cpu', writable=False)], candidates: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], q: Annotated[NDArray[numpy.float64], dict(shape=(None,), order='C', device='cpu')], valid: Annotated[NDArray[numpy.bool_], dict(shape=(None,), order='C', device='cpu')], settings: WorstFirstSettings, surface: hexmend.kernels.sliding_surface.SlidingSurface | None = None) -> int:
    """
    Take as many element steps as there are candidates, each of the hex that is worst at the time; returns
    the number of rejected steps, those that inverted a valid hex.

    points (n, 3), changed, end at the best state reached: fewest inverted hexes, then highest q_min, then
    highest q_mean. free (n,) bool; candidates (k,) int32: the hexes that have a free node. q (m,) float64
    and valid (m,) bool, as measured at points, are changed to those of the last state, which need not be
    the best. With a surface each element step is projected before it is checked.
    """
