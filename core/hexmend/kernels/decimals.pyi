"""Numbers as decimal text, in bytes."""

from typing import Annotated

import numpy
from numpy.typing import NDArray


def decimal_lines(values: Annotated[NDArray[numpy.float64], dict(shape=(None,), order='C', device='cpu', writable=False)], width: int, last: Annotated[NDArray[numpy.int64], dict(shape=(None,), order='C', device='cpu', writable=False)]) -> bytes:
    """
    Rows of `width` numbers, each the shortest text that gives the same number back, and behind them one of
    `last` (rows,), whole numbers, if it has any.
    """

def whole_lines(values: Annotated[NDArray[numpy.int64], dict(shape=(None,), order='C', device='cpu', writable=False)], width: int) -> bytes:
    """Rows of `width` whole numbers."""
