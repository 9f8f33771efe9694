"""eta(H), the energy of a hex: (3.1), (3.2), (B.20)."""

from __future__ import annotations

import numpy as np

from hexmend.arrays import as_hexes, as_points
from hexmend.energy.power import SQUARES, Power
from hexmend.kernels import objective as kernels


def energies(
    points: np.ndarray,
    hexes: np.ndarray,
    delta: float = 0.0,
    left_out: np.ndarray | None = None,
    offset: float = 1.0,
) -> np.ndarray:
    """Energy of every hex: mean of eta(T) over its corners minus `offset`.

    Parameters
    ----------
    points : (n, 3) float64
    hexes : (m, 8) int32
    delta : float
        In the unit of sigma, the cube of the points' unit of length.
    left_out : (m,) uint8, optional
        Bit t set: corner tetrahedron t of the hex is left out, as if it were perfect.
    offset : float
        See `Power`.

    Returns
    -------
    (m,) float64
        For a cube 0, if the offset is 1; +inf for an inverted hex at delta = 0.

    Examples
    --------
    >>> from hexmend.hexahedron import UNIT_CUBE
    >>> energies(UNIT_CUBE, np.arange(8, dtype=np.int32)[None])
    array([0.])
    """
    eta = np.empty(len(hexes))
    out = np.zeros(len(hexes), np.uint8) if left_out is None else left_out
    kernels.energies(as_points(points), as_hexes(hexes), float(delta), float(offset), out, eta)
    return eta


def objective(points: np.ndarray, hexes: np.ndarray, delta: float = 0.0, power: Power = SQUARES) -> float:
    """(sum eta(H)^p)^(1/p) over all hexes, (3.3).

    Examples
    --------
    >>> from hexmend.hexahedron import UNIT_CUBE
    >>> float(objective(UNIT_CUBE, np.arange(8, dtype=np.int32)[None]))
    0.0
    """
    p, offset = power
    return float(np.power(energies(points, hexes, delta, None, offset), p).sum() ** (1 / p))
