"""
Sequential GETMe: the worst hex takes its element step, again and again, from a priority queue.
"""

from typing import Annotated

import numpy
from numpy.typing import NDArray


def sweep(points: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order='C', device='cpu')], hexes: Annotated[NDArray[numpy.int32], dict(shape=(None, 8), order='C', device='cpu', writable=False)], start: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], corners: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], free: Annotated[NDArray[numpy.bool_], dict(shape=(None,), order='C', device='cpu', writable=False)], candidates: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], q: Annotated[NDArray[numpy.float64], dict(shape=(None,), order='C', device='cpu')], sound: Annotated[NDArray[numpy.bool_], dict(shape=(None,), order='C', device='cpu')], s: float, rho: float, penalty: float, setback: float) -> int:
    """
    Take as many element steps as there are candidates, each of the hex that is worst at the time; returns the
    number of rejected steps.

    A step that inverts a sound hex is rejected. After its step a hex ranks as better by `penalty` if the step was
    accepted and by `setback` if it was rejected, so that it is not chosen for ever. points (n, 3), changed, end at
    the best state reached: fewest inverted hexes, then highest q_min, then highest q_mean. free (n,) bool;
    candidates (k,) int32: the hexes that have a free node. q (m,) float64 and sound (m,) bool, as measured at
    points, are changed to those of the last state, which need not be the best. s and rho: scale and blend of the
    element step. start, corners: `Topology.node_corners`.
    """
