"""
Histograms. They run on one thread, because the window's thread calls them.
"""

from typing import Annotated

import numpy
from numpy.typing import NDArray


def count(values: Annotated[NDArray[numpy.float64], dict(shape=(None,), order='C', device='cpu', writable=False)], inverted: Annotated[NDArray[numpy.bool_], dict(shape=(None,), order='C', device='cpu', writable=False)], low: float, scale: float, open_low: bool, open_high: bool, counts: Annotated[NDArray[numpy.int64], dict(shape=(None,), order='C', device='cpu')]) -> None:
    """
    Count values (m,) float64 in equal bins from `low` on, `scale` bins per unit.

    Writes counts (bins + 3,) int64, at least one bin: the bins; the values above and below them, where
    that end is open (else they count in the outermost bin); the values that are inverted (m,) bool or NaN.
    """
