"""Targets of the hexes of a mesh."""

from typing import Annotated

import numpy
from numpy.typing import NDArray


class TargetMatrices:
    """Target matrices W = diag(lengths) along each hex's directions."""

    def __init__(self, inverse_lengths: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order='C', device='cpu', writable=False)], size_weight: float = 0.0) -> None:
        """
        inverse_lengths (m, 3) float64, along x, y and z of each hex; not copied. size_weight is the weight
        of the size term.
        """
