"""
The second stage of GETMe: the worst hex takes its step, again and again, from a priority queue.
"""

from typing import Annotated

import numpy
from numpy.typing import NDArray


def sweep(points: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order='C', device='cpu')], hexes: Annotated[NDArray[numpy.int32], dict(shape=(None, 8), order='C', device='cpu', writable=False)], start: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], corners: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], free: Annotated[NDArray[numpy.bool_], dict(shape=(None,), order='C', device='cpu', writable=False)], candidates: Annotated[NDArray[numpy.int32], dict(shape=(None,), order='C', device='cpu', writable=False)], q: Annotated[NDArray[numpy.float64], dict(shape=(None,), order='C', device='cpu')], sound: Annotated[NDArray[numpy.bool_], dict(shape=(None,), order='C', device='cpu')], s: float, rho: float, penalty: float, setback: float) -> int:
    """
    As many element steps as there are candidates, each of the hex that is worst at the time; returns how many
    were taken back.

    A step that would invert a sound hex is taken back. The hex that took a step pays a penalty, lest it be
    chosen for ever: it counts as better by `penalty` where the step was kept, by `setback` where it was taken
    back. points (n, 3), changed, end at the best state on the way: fewest inverted hexes, then highest q_min,
    then highest q_mean. free (n,) bool; candidates (k,) int32: the hexes that have a free node. q (m,)
    float64 and sound (m,) bool, as measured at points, are changed to those of the last state, which need
    not be the best. start, corners: `Topology.node_corners`.
    """
