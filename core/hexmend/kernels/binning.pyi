"""
Counting values by bins; on one thread, because a window's thread asks.
"""

from typing import Annotated

import numpy
from numpy.typing import NDArray


def count(values: Annotated[NDArray[numpy.float64], dict(shape=(None,), order='C', device='cpu', writable=False)], inverted: Annotated[NDArray[numpy.bool_], dict(shape=(None,), order='C', device='cpu', writable=False)], low: float, scale: float, open_low: bool, open_high: bool, counts: Annotated[NDArray[numpy.int64], dict(shape=(None,), order='C', device='cpu')]) -> None:
    """
    How many values (m,) float64 lie in each of equal bins from low on, scale bins for every 1.

    Writes counts (bins + 3,) int64, at least one bin: after the bins those above and below them, where these ends
    are open, else they belong to the bin there; last those that are inverted (m,) bool, or no numbers.
    """
