"""Filters of the shown hexes as values without Qt and VTK."""

from __future__ import annotations

import math
from collections.abc import Collection
from dataclasses import dataclass

from hexmend.errors import ParameterError
from hexmend.quality import METRICS
from hexmend_app.codec.conversion import ConfigTable, option

#: Largest number of a hex that can be listed.
_MAX_NUMBER = 2**31 - 1


@dataclass(frozen=True)
class Isolate(ConfigTable):
    """Hexes that are shown with their surroundings only.

    Parameters
    ----------
    hexes : tuple of int
        Hex numbers, from 0.
    rings : int
        Rings of hexes around them; each adds the hexes that share a node.
    """

    hexes: tuple[int, ...] = option((), low=0, high=_MAX_NUMBER)
    rings: int = option(1, low=0, high=1000)


@dataclass(frozen=True)
class Show(ConfigTable):
    """Filters of the shown hexes; by default all are shown.

    Parameters
    ----------
    quality : tuple of 2 floats, optional
        Smallest and largest value of shown hexes; -inf and inf for no bound.
    metric : str
        Metric of the range.
    inverted : bool
        Show inverted hexes too, independent of their value.
    peel : int
        Number of layers of hexes to hide, from the boundary inwards.
    isolate : Isolate, optional
        Show only these hexes and their neighbours.
    hidden : frozenset of int
        Numbers of hexes that are hidden individually.
    shrink : float
        Fraction by which each hex is shrunk.
    outline : bool
        Draw sharp edges, and the outline of the whole mesh while part of it is hidden.
    marked : frozenset of int
        Numbers of hexes whose edges are marked; in saved pictures, the selected hex.
    """

    quality: tuple[float, float] | None = option(open_ended=True)
    metric: str = option("q")
    inverted: bool = option(False)
    peel: int = option(0, low=0, high=100_000)
    isolate: Isolate | None = option()
    hidden: frozenset[int] = option(frozenset(), low=0, high=_MAX_NUMBER)
    shrink: float = option(0.0, low=0, high=0.95)
    outline: bool = option(True)
    marked: frozenset[int] = option(frozenset(), low=0, high=_MAX_NUMBER)

    def check(self) -> None:
        """Raise `ParameterError` for an unknown metric or an invalid range."""
        known_metric(self.metric, METRICS)
        if self.quality is not None and not self.quality[0] <= self.quality[1]:
            raise ParameterError(f"quality = {list(self.quality)} is no range: expected the lower number first")

    @property
    def by_quality(self) -> Show | None:
        """The filter by quality without the others; None if all values are shown."""
        return None if self.quality is None else Show(self.quality, self.metric, self.inverted)

    @property
    def low(self) -> float:
        """Smallest value of the metric of shown hexes."""
        return -math.inf if self.quality is None else self.quality[0]

    @property
    def high(self) -> float:
        """Largest value of the metric of shown hexes; -inf if inverted hexes alone are shown."""
        return math.inf if self.quality is None else self.quality[1]

    @property
    def largest_hex(self) -> int:
        """Largest listed number; -1 if no hexes are listed."""
        isolated = () if self.isolate is None else self.isolate.hexes
        return max(max(hexes, default=-1) for hexes in (self.hidden, self.marked, isolated))

    def check_numbers(self, hexes: int) -> None:
        """Raise `ParameterError` if a listed hex does not exist in a mesh with a number of hexes."""
        if self.largest_hex >= hexes:
            raise ParameterError(f"[show] names hex {self.largest_hex}: expected one of the mesh, below {hexes:,}")


def known_metric(name: str, known: Collection[str]) -> None:
    """Raise `ParameterError` if a metric is unknown."""
    if name not in known:
        raise ParameterError(f"metric = {name!r} is unknown: expected one of {', '.join(known)}")
