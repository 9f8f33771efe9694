"""Step length: Algorithm A.5."""

from __future__ import annotations

import sys
from collections.abc import Callable
from dataclasses import dataclass

#: Less descent than this share of the value cannot be told from rounding, and shorter steps descend less.
ROUNDING = 4 * sys.float_info.epsilon


@dataclass(frozen=True)
class BackLineSearch:
    """Back line search with the Armijo condition.

    Parameters
    ----------
    first : float
        First step alpha.
    shrink : float
        Factor lambda of a cut.
    c1 : float
        Share of the slope that a step must descend.
    cuts : int
        Most cuts.
    """

    first: float = 1.0
    shrink: float = 0.7
    c1: float = 1e-4
    cuts: int = 100

    def __call__(self, along: Callable[[float], float], value: float, slope: float) -> tuple[float, int]:
        """Find a step that descends.

        Parameters
        ----------
        along : callable
            f(x_k + alpha p_k) of alpha; +inf beyond the barrier.
        value, slope : float
            f(x_k) and grad f_k . p_k.

        Returns
        -------
        alpha : float
            The accepted step; 0 if none descends.
        cuts : int
            How often it was cut.
        """
        alpha = self.first
        for cut in range(self.cuts + 1):
            if along(alpha) < value + self.c1 * alpha * slope:
                return alpha, cut
            if -alpha * slope < ROUNDING * abs(value):
                return 0.0, cut
            alpha *= self.shrink
        return 0.0, self.cuts
