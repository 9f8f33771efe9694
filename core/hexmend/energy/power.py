"""How the energies of hexes come together in the objective, (3.3)."""

from __future__ import annotations

from typing import NamedTuple


class Power(NamedTuple):
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

        >>> Power(2.0, 1.0).least, Power(3.0, 0.0).least
        (0.0, 1.0)
        """
        return (1 - self.offset) ** self.p


#: The sum of squares of (B.20).
SQUARES = Power()
