"""Energy eta(H) of hexes: (3.1), (3.2), (B.20)."""

from __future__ import annotations

import numpy as np

from hexmend.energy.norm import SQUARES, ObjectiveNorm
from hexmend.errors import MeshError
from hexmend.kernels import objective as kernels
from hexmend.kernels.target import TargetMatrices
from hexmend.mesh.validation import as_hexes, as_points


def energies(
    points: np.ndarray,
    hexes: np.ndarray,
    delta: float = 0.0,
    omitted: np.ndarray | None = None,
    offset: float = 1.0,
    target: TargetMatrices | None = None,
) -> np.ndarray:
    """Compute the energy of every hex, the mean of eta(T) over its corners minus `offset`.

    Parameters
    ----------
    points : (n, 3) float64
    hexes : (m, 8) int32
    delta : float
        Regularisation parameter in the unit of sigma, the cube of the points' unit of length; with a target it has no
        unit, as sigma is that of S W^-1.
    omitted : (m,) uint8, optional
        Corner tetrahedron t of a hex is left out, as if it were perfect, if bit t is set.
    offset : float
        See `ObjectiveNorm`.
    target : TargetMatrices, optional
        Of these hexes, in the points' unit of length; see `hexmend.mesh.element_target`.

    Returns
    -------
    (m,) float64
        0 for a cube, or a block as the target wants it, if the offset is 1; +inf for an inverted hex at delta = 0.

    Raises
    ------
    MeshError
        For arrays of another shape or type, and for a node that does not exist.

    Examples
    --------
    >>> from hexmend.mesh.hexahedron import UNIT_CUBE
    >>> energies(UNIT_CUBE, np.arange(8, dtype=np.int32)[None])
    array([0.])
    """
    points = as_points(points)
    hexes = as_hexes(hexes, len(points))
    eta = np.empty(len(hexes))
    out = as_omitted_corners(omitted, len(hexes))
    kernels.energies(points, hexes, float(delta), float(offset), out, eta, target)
    return eta


def as_omitted_corners(omitted: np.ndarray | None, hexes: int) -> np.ndarray:
    """Check the corner tetrahedra to be left out of hexes.

    Parameters
    ----------
    omitted : (m,) uint8 or None
        See `energies`; None leaves out none.
    hexes : int
        Number of hexes.

    Returns
    -------
    (m,) uint8

    Raises
    ------
    MeshError
        For an array of another length or type.
    """
    if omitted is None:
        return np.zeros(hexes, np.uint8)
    if not isinstance(omitted, np.ndarray) or omitted.shape != (hexes,) or omitted.dtype != np.uint8:
        raise MeshError(f"omitted is not an array ({hexes},) of type uint8: expected a byte for each hex")
    return np.ascontiguousarray(omitted)


def pack_corners(marks: np.ndarray) -> np.ndarray:
    """Pack marks of the corners of hexes, (k, 8) bool, into a byte for each hex, (k,) uint8: bit t is corner t."""
    return np.packbits(marks, axis=1, bitorder="little")[:, 0]


def unpack_corners(packed: np.ndarray) -> np.ndarray:
    """Unpack what `pack_corners` packed, (k,) uint8, as (k, 8) bool."""
    return np.unpackbits(packed[:, None], axis=1, bitorder="little").astype(bool)


def objective(points: np.ndarray, hexes: np.ndarray, delta: float = 0.0, norm: ObjectiveNorm = SQUARES) -> float:
    """Compute the objective (sum eta(H)^p)^(1/p) over all hexes, (3.3).

    Parameters
    ----------
    points : (n, 3) float64
    hexes : (m, 8) int32
    delta : float
        See `energies`.
    norm : ObjectiveNorm
        p and offset.

    Returns
    -------
    float

    Examples
    --------
    >>> from hexmend.mesh.hexahedron import UNIT_CUBE
    >>> float(objective(UNIT_CUBE, np.arange(8, dtype=np.int32)[None]))
    0.0
    """
    p, offset = norm
    return float(np.power(energies(points, hexes, delta, None, offset), p).sum() ** (1 / p))
