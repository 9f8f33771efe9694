"""Norm that combines the energies of hexes in the objective, (3.3).

Policies for delta, which regularises the barrier of (3.2) while a mesh is tangled; 0 for a valid mesh (3.2.4).
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import NamedTuple, Protocol

import numpy as np

_SUPERSCRIPTS = str.maketrans("0123456789", "⁰¹²³⁴⁵⁶⁷⁸⁹")


class ObjectiveNorm(NamedTuple):
    """Exponent p and offset of the objective: the sum of eta(H)^p, with eta(H) = mean of eta(T) minus offset.

    Parameters
    ----------
    p : float
        Exponent, at least 1.
    offset : float
        In [0, 1]: with 1, (B.20) as printed, a cube has no energy; 0 is needed in chapter 4 for q_norm to be
        equivalent to the objective (4.1.1).
    """

    p: float = 2.0
    offset: float = 1.0

    @property
    def cube_value(self) -> float:
        """Contribution of a cube.

        >>> ObjectiveNorm(2.0, 1.0).cube_value, ObjectiveNorm(3.0, 0.0).cube_value
        (0.0, 1.0)
        """
        return self.contribution(0.0)

    def contribution(self, eta: float) -> float:
        """Compute the contribution of a hex from its eta(H) by (B.20), that is with offset 1.

        >>> ObjectiveNorm(2.0, 1.0).contribution(1.0), ObjectiveNorm(2.0, 0.0).contribution(1.0)
        (1.0, 4.0)
        """
        return (eta + 1 - self.offset) ** self.p

    @property
    def formula(self) -> str:
        """Formula of the objective in tables and charts.

        >>> ObjectiveNorm().formula, ObjectiveNorm(4.0, 0.0).formula, ObjectiveNorm(1.5).formula
        ('Σ η²', 'Σ η⁴, offset 0', 'Σ η^1.5')
        """
        return self.formula_with(0.0)

    def formula_with(self, weight: float) -> str:
        """Formula of the objective with boundary quads of some weight.

        >>> ObjectiveNorm(4.0, 0.0).formula_with(0.1)
        'Σ η⁴ + 0.1 Σ η⁴ of quads, offset 0'
        """
        number = f"{self.p:g}"
        power = "" if number == "1" else number.translate(_SUPERSCRIPTS) if number.isdigit() else f"^{number}"
        quads = f" + {weight:g} Σ η{power} of quads" if weight else ""
        return f"Σ η{power}{quads}" + ("" if self.offset == 1 else f", offset {self.offset:g}")


class SurfaceObjective(NamedTuple):
    """Term of the objective over the quads of a sliding boundary: weight times the sum of eta(Q)^p, at delta = 0.

    Parameters
    ----------
    weight : float
        Weight of a quad relative to a hex.
    quads : int
        Number of quads.
    value : float or None
        The term; None while a quad is flipped.
    """

    weight: float
    quads: int
    value: float | None

    def square_value(self, norm: ObjectiveNorm) -> float:
        """Value of the term if all quads are squares."""
        return self.weight * self.quads * norm.cube_value


#: Sum of squares of (B.20).
SQUARES = ObjectiveNorm()


class Determinants(Protocol):
    """Determinants of elements, such as `hexmend.quality.ElementQuality` has."""

    @property
    def sigma(self) -> np.ndarray:
        """The least of each element, (m,)."""

    @property
    def n_inverted(self) -> int:
        """Number of inverted elements."""


class DeltaPolicy(Protocol):
    """Policy that chooses delta for each iteration."""

    def at(self, quality: Determinants, unit: np.ndarray | float) -> float:
        """Choose delta for a mesh.

        Parameters
        ----------
        quality : Determinants
            Of its hexes.
        unit : (m,) float64 or float
            Lengths to whose cubes sigma of the hexes is relative: the mean edge length of the mesh, or those of a
            target; see `hexmend.energy.target.hex_sizes`.

        Returns
        -------
        float
            In the cube of the mean edge length (of the mesh or of the patch that is optimised); 0 if no hex is
            inverted.
        """


@dataclass(frozen=True)
class FixedDelta:
    """Constant delta while any hex is inverted, the thesis's policy.

    Parameters
    ----------
    value : float
        Delta in the cube of the mean edge length.
    """

    value: float = 0.01

    def at(self, quality: Determinants, unit: np.ndarray | float) -> float:
        return self.value if quality.n_inverted else 0.0


@dataclass(frozen=True)
class AdaptiveDelta:
    """Delta that follows the least sigma of the mesh: delta^2 = e (e - sigma), so that h(sigma) >= e everywhere.

    Deeply inverted hexes make delta large, which keeps the Hessian well conditioned; as they recover, delta falls to e
    (thesis 5.2.4 asks for such a decrease).

    Parameters
    ----------
    least : float
        Constant e in the cube of the mean edge length.
    """

    least: float = 0.01

    def at(self, quality: Determinants, unit: np.ndarray | float) -> float:
        if not quality.n_inverted:
            return 0.0
        worst = min(float((quality.sigma / np.power(unit, 3)).min()), 0.0)
        return math.sqrt(self.least * (self.least - worst))


#: Policies by their names in parameters of methods.
POLICIES = {"fixed": FixedDelta, "adaptive": AdaptiveDelta}
