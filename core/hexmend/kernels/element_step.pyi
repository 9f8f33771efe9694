"""GETMe's element step, which makes one hex more regular."""

from typing import Annotated

import numpy
from numpy.typing import NDArray


def element_steps(points: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order='C', device='cpu', writable=False)], hexes: Annotated[NDArray[numpy.int32], dict(shape=(None, 8), order='C', device='cpu', writable=False)], s: float, rho: float, places: Annotated[NDArray[numpy.float64], dict(shape=(None, 8, 3), order='C', device='cpu')]) -> None:
    """
    Targets of the corners of every hex; writes places (m, 8, 3).

    Corner k moves to c_k + s n_k/sqrt(|n_k|), centroid and normal of the triangle of the centroids of its
    three faces; the hex is scaled to its old mean edge length and blended with the old one by rho.
    Vartziotis and Wipper 2011, CMAME 200:1186; thesis 3.1.2.
    """
