"""Quality of every hex of a mesh, measured in one pass."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from hexmend.kernels import elements
from hexmend.mesh.fields import as_set
from hexmend.mesh.solid_cells import rows_by_kind
from hexmend.mesh.validation import as_bools, as_points_and_hexes
from hexmend.quality.validity import Validity, certify
from hexmend.quantity import format_quality
from hexmend.terminal_text import count_phrase

#: Values of an `ElementQuality`.
_VALUES = ("q", "sigma", "scaled_jacobian", "eta", "validity")


@dataclass(frozen=True, eq=False, repr=False)
class ElementQuality:
    """Quality of every hex of a mesh.

    Parameters
    ----------
    q : (m,) float64
        q(H) in [0, 1], (2.10).
    sigma : (m,) float64
        Least corner determinant, (2.9), in the cube of the mesh's unit of length.
    scaled_jacobian : (m,) float64
        Scaled Jacobian, in [-1, 1].
    eta : (m,) float64
        Energy eta(H) at delta = 0, (B.20): 0 for a cube, +inf for an inverted hex.
    validity : (m,) uint8
        Numbers of `Validity`: whether det J is positive everywhere in the hex.
    against_target : bool
        True if q and eta are measured against the target of the mesh; see `measure_against_target`.
    """

    q: np.ndarray
    sigma: np.ndarray
    scaled_jacobian: np.ndarray
    eta: np.ndarray
    validity: np.ndarray
    against_target: bool = False

    @cached_property
    def inverted(self) -> np.ndarray:
        """True for hexes with a corner determinant that is not positive, (m,) bool."""
        return ~(self.sigma > 0)

    @cached_property
    def n_inverted(self) -> int:
        """Number of hexes that are marked in `inverted`; the figure `inverted` of summaries and iterations."""
        return int(np.count_nonzero(self.inverted))

    @cached_property
    def invalid(self) -> np.ndarray:
        """True for hexes whose det J is not certified as positive everywhere, also the inverted ones, (m,) bool."""
        return self.inverted | (self.validity != Validity.VALID)

    @cached_property
    def n_invalid(self) -> int:
        """Number of hexes that are marked in `invalid`; the figure `invalid` of summaries and iterations."""
        return int(np.count_nonzero(self.invalid))

    @property
    def n_undecided(self) -> int:
        """Number of hexes whose det J is within rounding of 0; they count as invalid."""
        return int(np.count_nonzero(self.validity == Validity.UNDECIDED))

    def of(self, which: np.ndarray) -> ElementQuality:
        """Return the quality of some hexes, (m,) bool or (k,) int."""
        values = {name: getattr(self, name)[which] for name in _VALUES}
        return ElementQuality(**values, against_target=self.against_target)

    def made_from(self, points: np.ndarray, hexes: np.ndarray, mid_nodes: np.ndarray | None = None) -> None:
        """Note the arguments of `measure`, if they are immutable: see `release`."""
        if not (points.flags.writeable or hexes.flags.writeable):
            self.__dict__["_source"] = points, hexes, mid_nodes

    def release(self) -> None:
        """Free the memory of the values; whoever reads one measures the hexes again.

        Without effect where the points are not known, or may have changed.
        """
        if "_source" in self.__dict__:
            for name in (*_VALUES, "inverted", "invalid"):
                self.__dict__.pop(name, None)

    def __getstate__(self) -> dict[str, Any]:
        return {name: getattr(self, name) for name in (*_VALUES, "against_target")}

    def __getattr__(self, name: str) -> np.ndarray:
        source = self.__dict__.get("_source")
        if name not in _VALUES or source is None:
            raise AttributeError(f"{type(self).__name__} has no attribute {name}")
        if name == "validity":  # few who measure hexes ask for it
            self.__dict__[name] = certify(*source)
        else:
            again = measure(*source)
            self.__dict__.update({key: again.__dict__[key] for key in _VALUES if key != "validity"})
        return self.__dict__[name]

    def __repr__(self) -> str:
        least = f"q min {format_quality(self.q.min())}" if len(self.q) else "no values"
        hexes = count_phrase(len(self.q), "hex", "hexes")
        return f"<ElementQuality of {hexes}: {self.n_inverted:,} inverted, {self.n_invalid:,} invalid; {least}>"


def measure(points: np.ndarray, hexes: np.ndarray, mid_nodes: np.ndarray | None = None) -> ElementQuality:
    """Measure the quality of every hex.

    Parameters
    ----------
    points : (n, 3) float64
    hexes : (m, 8) int32
    mid_nodes : (m, 19) int32, optional
        As `Mesh.mid_nodes`: the validity of second-order hexes is that of their curved map; all else is of the corners.

    Returns
    -------
    ElementQuality

    Raises
    ------
    MeshError
        For arrays of another shape or type, and for a node that does not exist.

    Examples
    --------
    >>> from hexmend.mesh.hexahedron import UNIT_CUBE
    >>> measure(UNIT_CUBE, np.arange(8, dtype=np.int32)[None]).q
    array([1.])
    """
    points, hexes = as_points_and_hexes(points, hexes)
    q, sigma, jacobian, eta = np.empty((4, len(hexes)))
    elements.measure(points, hexes, q, sigma, jacobian, eta)
    may_change = points.flags.writeable or hexes.flags.writeable  # else it is certified when that is asked for
    validity = certify(points, hexes, mid_nodes) if may_change else np.empty(0, np.uint8)
    quality = ElementQuality(q, sigma, jacobian, eta, validity)
    quality.made_from(points, hexes, mid_nodes)
    if not may_change:
        del quality.__dict__["validity"]
    return quality


def fixed_tetrahedra(hexes: np.ndarray, fixed: np.ndarray) -> np.ndarray:
    """Find the corner tetrahedra of cells (m, 8) whose four nodes are all fixed, (m, 8) bool; fixed (n,) bool.

    Corners that a cell does not have are not among them.
    """
    all_stay = np.empty((len(hexes), 8), dtype=bool)
    for kind, rows in rows_by_kind(hexes):
        stays, of_kind = fixed[hexes[rows]], np.zeros((len(all_stay[rows]), 8), dtype=bool)
        for corner, (apex, *ends) in enumerate(kind.corners):
            np.copyto(of_kind[:, corner], stays[:, apex])
            for end in ends:
                of_kind[:, corner] &= stays[:, end]
        all_stay[rows] = of_kind
    return all_stay


def locked_tetrahedra(points: np.ndarray, hexes: np.ndarray, fixed: np.ndarray, inverted: np.ndarray) -> np.ndarray:
    """Find the corner tetrahedra with sigma <= 0 whose four nodes are all fixed.

    No method that keeps the fixed nodes can mend the hex of such a corner.

    Parameters
    ----------
    points : (n, 3) float64
    hexes : (m, 8) int32
    fixed : (n,) bool
    inverted : (m,) bool
        The inverted hexes, as `measure` finds them.

    Returns
    -------
    (m, 8) bool

    Raises
    ------
    MeshError
        For an array of another shape or type.
    """
    points, hexes = as_points_and_hexes(points, hexes)
    fixed = as_bools(fixed, "fixed", len(points))
    where = np.flatnonzero(as_bools(inverted, "inverted", len(hexes)))
    locked = np.zeros((len(hexes), 8), dtype=bool)
    locked[where] = fixed_tetrahedra(hexes[where], fixed) & ~(corner_determinants(points, hexes, where) > 0)
    return locked


def locked_hexes(points: np.ndarray, hexes: np.ndarray, fixed: np.ndarray, inverted: np.ndarray) -> np.ndarray:
    """True for each hex with a tetrahedron of `locked_tetrahedra`, (m,) bool; no untangler leaves fewer inverted."""
    return np.any(locked_tetrahedra(points, hexes, fixed, inverted), axis=1)


def corner_determinants(points: np.ndarray, hexes: np.ndarray, which: np.ndarray | None = None) -> np.ndarray:
    """Compute sigma of the eight corner tetrahedra of hexes, (2.9), bit for bit as `measure` does.

    Parameters
    ----------
    points : (n, 3) float64
    hexes : (m, 8) int32
    which : (k,) int, optional
        Numbers of hexes; all by default.

    Returns
    -------
    (k, 8) float64
        In the cube of the points' unit of length.
    """
    points, chosen = as_points_and_hexes(points, hexes)
    if which is not None:
        chosen = chosen[as_set(which, "which", len(chosen))]
    sigma = np.empty((len(chosen), 8))
    elements.corner_determinants(points, chosen, sigma)
    return sigma


def corner_qualities(points: np.ndarray, hexes: np.ndarray) -> np.ndarray:
    """Compute q(T) = 3 sigma^(2/3)/|S|^2 of the eight corner tetrahedra of hexes, (2.8).

    Parameters
    ----------
    points : (n, 3) float64
    hexes : (k, 8) int

    Returns
    -------
    (k, 8) float64
        Columns are in the order of the corners; 0 where sigma <= 0.

    Examples
    --------
    >>> from hexmend.mesh.hexahedron import UNIT_CUBE
    >>> corner_qualities(UNIT_CUBE, np.arange(8)[None])
    array([[1., 1., 1., 1., 1., 1., 1., 1.]])
    """
    points, hexes = as_points_and_hexes(points, hexes)
    q = np.empty((len(hexes), 8))
    elements.corner_qualities(points, hexes, q)
    return q
