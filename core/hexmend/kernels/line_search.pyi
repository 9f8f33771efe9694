"""Step length: Algorithm A.5."""

from collections.abc import Callable


class LineSearch:
    """Backtracking line search with the Armijo condition, Algorithm A.5."""

    def __init__(self, initial_step: float = 1.0, backtrack_factor: float = 0.7, c1: float = 0.0001, max_backtracks: int = 100) -> None:
        """
        initial_step is the first step length alpha, backtrack_factor the factor lambda by which a rejected
        step is shortened, c1 the share of the slope that a step must descend.
        """

    @property
    def initial_step(self) -> float: ...

    @property
    def backtrack_factor(self) -> float: ...

    @property
    def c1(self) -> float: ...

    @property
    def max_backtracks(self) -> int: ...

    def with_initial_step(self, initial_step: float) -> LineSearch:
        """Search that begins with another step length."""

    def __call__(self, energy_along: Callable, value: float, slope: float) -> tuple[float, int]:
        """
        Find a step that descends: (alpha, number of backtracks); alpha is 0 if none descends.

        energy_along maps alpha to f(x + alpha p), +inf beyond the barrier; value is f(x), slope the
        derivative along p, below 0. The search also ends where the expected descent is lost in the rounding
        of value.
        """
