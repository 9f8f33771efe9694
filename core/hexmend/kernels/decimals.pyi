"""Numbers as text."""

from typing import Annotated

import numpy
from numpy.typing import NDArray


def lines(values: Annotated[NDArray[numpy.float64], dict(shape=(None,), order='C', device='cpu', writable=False)], width: int) -> bytes:
    """
    Rows of `width` numbers, each the shortest text that gives the same number back.
    """
