"""How the energies of hexes come together in the objective, (3.3)."""

from __future__ import annotations

from typing import NamedTuple

_RAISED = str.maketrans("0123456789", "⁰¹²³⁴⁵⁶⁷⁸⁹")


class ObjectiveNorm(NamedTuple):
    """eta(H)^p with eta(H) = mean of eta(T) minus offset.

    Parameters
    ----------
    p : float
        At least 1.
    offset : float
        In [0, 1]: 1 is (B.20) as printed, so that a cube has no energy; 0 is what chapter 4 needs, where q_norm is said
        to be equivalent to the objective (4.1.1).
    """

    p: float = 2.0
    offset: float = 1.0

    @property
    def least(self) -> float:
        """What a cube contributes.

        >>> ObjectiveNorm(2.0, 1.0).least, ObjectiveNorm(3.0, 0.0).least
        (0.0, 1.0)
        """
        return self.of(0.0)

    def of(self, eta: float) -> float:
        """What a hex of this eta(H), as (B.20) has it, contributes.

        >>> ObjectiveNorm(2.0, 1.0).of(1.0), ObjectiveNorm(2.0, 0.0).of(1.0)
        (1.0, 4.0)
        """
        return (eta + 1 - self.offset) ** self.p

    @property
    def formula(self) -> str:
        """The objective as tables and charts write it.

        >>> ObjectiveNorm().formula, ObjectiveNorm(4.0, 0.0).formula, ObjectiveNorm(1.5).formula
        ('Σ η²', 'Σ η⁴, offset 0', 'Σ η^1.5')
        """
        number = f"{self.p:g}"
        power = "" if number == "1" else number.translate(_RAISED) if number.isdigit() else f"^{number}"
        return f"Σ η{power}" + ("" if self.offset == 1 else f", offset {self.offset:g}")


#: The sum of squares of (B.20).
SQUARES = ObjectiveNorm()
