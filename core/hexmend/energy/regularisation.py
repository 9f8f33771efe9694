"""delta: how far the barrier of (3.2) is softened while a mesh is tangled; zero as soon as it is not (3.2.4)."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Protocol

from hexmend.quality import ElementQuality


class DeltaPolicy(Protocol):
    """Gives delta for each iteration."""

    def at(self, figures: ElementQuality, unit: float) -> float:
        """Delta for a mesh of these figures.

        Parameters
        ----------
        figures : ElementQuality
        unit : float
            Mean edge length of the mesh.

        Returns
        -------
        float
            In the cube of the mean edge length (of the mesh or of the patch, whichever is minimised over); 0 if no hex
            is inverted.
        """


@dataclass(frozen=True)
class FixedDelta:
    """The thesis's policy: one value while any hex is inverted.

    Parameters
    ----------
    value : float
        In the cube of the mean edge length.
    """

    value: float = 0.01

    def at(self, figures: ElementQuality, unit: float) -> float:
        return self.value if figures.n_inverted else 0.0


@dataclass(frozen=True)
class AdaptiveDelta:
    """delta^2 = e (e - sigma) with the worst sigma of the mesh: its h(sigma) is e, and h falls no lower anywhere.

    Deeply inverted elements make delta large, which keeps the Hessian well conditioned; as they recover it falls to e
    (thesis 5.2.4 asks for such a decrease).

    Parameters
    ----------
    least : float
        e, in the cube of the mean edge length.
    """

    least: float = 0.01

    def at(self, figures: ElementQuality, unit: float) -> float:
        if not figures.n_inverted:
            return 0.0
        worst = min(float(figures.sigma.min()) / unit**3, 0.0)
        return math.sqrt(self.least * (self.least - worst))


#: Policies by the name that a method's parameter gives.
POLICIES = {"fixed": FixedDelta, "adaptive": AdaptiveDelta}
