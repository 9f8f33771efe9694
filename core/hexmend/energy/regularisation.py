"""Policies for delta, which regularises the barrier of (3.2) while a mesh is tangled; 0 for a valid mesh (3.2.4)."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Protocol

import numpy as np


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
