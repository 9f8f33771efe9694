"""Norm that combines the energies of hexes in the objective, (3.3)."""

from __future__ import annotations

from typing import NamedTuple

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
