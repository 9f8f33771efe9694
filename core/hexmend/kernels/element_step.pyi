"""GETMe's element step: a hex grows more regular by itself."""

from typing import Annotated

import numpy
from numpy.typing import NDArray


def element_steps(points: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order='C', device='cpu', writable=False)], hexes: Annotated[NDArray[numpy.int32], dict(shape=(None, 8), order='C', device='cpu', writable=False)], s: float, rho: float, places: Annotated[NDArray[numpy.float64], dict(shape=(None, 8, 3), order='C', device='cpu')]) -> None:
    """
    Where the corners of every hex go; writes places (m, 8, 3).

    Corner k goes to c_k + s n_k/sqrt(|n_k|), centroid and normal of the triangle of the centroids of its
    three faces; the hex keeps its mean edge length, and a share rho of the way is gone.
    Vartziotis and Wipper 2011, CMAME 200:1186; thesis 3.1.2.
    """
