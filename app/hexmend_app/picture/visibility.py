"""Tables of a scene for the shown hexes and their colours."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum

from hexmend.boundary.displacement import DISPLACEMENT_QUANTITIES
from hexmend.errors import ParameterError
from hexmend.quality import METRICS
from hexmend_app.codec.config_table import ConfigTable, option
from hexmend_app.picture.appearance import ColourScale, Isolation, Look, RangeMode, ValueRange
from hexmend_app.picture.colour_map import COLOUR_MAPS, DEFAULT_MAP

#: Maximum number of hexes that are listed individually.
_MAX_HEXES = 300_000


@dataclass(frozen=True)
class Isolate(ConfigTable):
    """Hexes that are shown with their surroundings only.

    Parameters
    ----------
    hexes : tuple of int
        Hex numbers, from 0.
    rings : int
        Number of rings of hexes around them; each ring adds the hexes that share a node.
    """

    hexes: tuple[int, ...] = option((), low=0, high=2**31 - 1, most=_MAX_HEXES)
    rings: int = option(1, low=0, high=1000)


@dataclass(frozen=True)
class Show(ConfigTable):
    """Filters of the shown hexes; by default all are shown.

    Parameters
    ----------
    quality : tuple of 2 floats, optional
        Smallest and largest value of the metric of shown hexes; -inf and inf for no bound.
    metric : str
        Metric of the range.
    inverted : bool
        Show inverted hexes too, independent of their value.
    peel : int
        Number of layers of hexes to hide, from the boundary inwards.
    isolate : Isolate, optional
        Show only these hexes and their neighbours, for example { hexes = [12, 15], rings = 1 }.
    hidden : tuple of int
        Hexes that are hidden individually, by number from 0.
    shrink : float
        Fraction by which each hex is shrunk.
    outline : bool
        Draw sharp edges, and the outline of the whole mesh while part of it is hidden.
    """

    quality: tuple[float, float] | None = option(open_ended=True)
    metric: str = option("q")
    inverted: bool = option(False)
    peel: int = option(0, low=0, high=100_000)
    isolate: Isolate | None = option()
    hidden: tuple[int, ...] = option((), low=0, high=2**31 - 1, most=_MAX_HEXES)
    shrink: float = option(0.0, low=0, high=0.95)
    outline: bool = option(True)

    def check(self) -> None:
        """Raise `ParameterError` for an unknown metric or an invalid range."""
        known_metric(self.metric, METRICS)
        if self.quality is not None and not self.quality[0] <= self.quality[1]:
            raise ParameterError(f"quality = {list(self.quality)} is no range: expected the lower number first")

    @classmethod
    def from_look(cls, look: Look) -> Show:
        """Return the table of a look."""
        bounds, isolation = look.quality_range, look.isolation
        quality = {} if bounds is None else {"quality": (bounds.low, bounds.high), "metric": bounds.metric}
        return cls(
            **quality,
            inverted=bounds is not None and bounds.inverted,
            peel=look.peel,
            isolate=None if isolation is None else Isolate(isolation.hexes, isolation.rings),
            hidden=tuple(sorted(look.dug)),
            shrink=look.shrink,
            outline=look.outline,
        )

    def fields(self) -> dict[str, object]:
        """Return the fields of a look that the table determines."""
        bounds, isolate = self.quality, self.isolate
        return {
            "quality_range": None if bounds is None else ValueRange(self.metric, *bounds, self.inverted),
            "peel": self.peel,
            "isolation": None if isolate is None else Isolation(isolate.hexes, isolate.rings),
            "dug": frozenset(self.hidden),
            "shrink": self.shrink,
            "outline": self.outline,
        }

    def check_numbers(self, hexes: int) -> None:
        """Raise `ParameterError` if a listed hex does not exist in a mesh with a number of hexes."""
        listed = (*self.hidden, *(self.isolate.hexes if self.isolate is not None else ()))
        if listed and max(listed) >= hexes:
            raise ParameterError(f"[show] names hex {max(listed):,}: expected one of the mesh, below {hexes:,}")


class Range(StrEnum):
    """Definition of a colour range that is not given by numbers."""

    FULL = "full"
    """All values that the metric can have."""
    FITTED = "fitted"
    """From the smallest to the largest value of the mesh."""
    ACCEPTABLE = "acceptable"
    """Values that are usually acceptable for solvers."""


@dataclass(frozen=True)
class Colours(ConfigTable):
    """Colours of the hexes.

    Parameters
    ----------
    metric : str
        Quality metric, as listed by `hexmend info --metrics`, or movement.
    map : str
        Name of a colour map, such as viridis, cividis, plasma or inferno.
    range : Range or tuple of 2 floats
        full, fitted or acceptable, or the values at both ends.
    reverse : bool
        Reverse the map.
    neutral : bool
        White boundary and one colour for exposed faces, instead of values.
    """

    metric: str = option("q")
    map: str = option(DEFAULT_MAP)
    range: Range | tuple[float, float] = option(Range.FULL)
    reverse: bool = option(False)
    neutral: bool = option(False)

    def check(self) -> None:
        """Raise `ParameterError` for an unknown metric or map, or an invalid range."""
        known_metric(self.metric, {**METRICS, **DISPLACEMENT_QUANTITIES})
        if self.map not in COLOUR_MAPS:
            raise ParameterError(f"map = {self.map!r} is unknown: expected one of {', '.join(COLOUR_MAPS)}")
        if isinstance(self.range, tuple) and not self.range[0] < self.range[1]:
            raise ParameterError(f"range = {list(self.range)} is no range: expected the lower number first")

    @classmethod
    def from_look(cls, look: Look) -> Colours:
        """Return the table of a look."""
        scale = look.scale
        ends = scale.pinned if scale.mode is RangeMode.PINNED else Range(scale.mode.value)
        return cls(scale.metric, scale.map, ends, scale.reverse, look.neutral)

    @property
    def scale(self) -> ColourScale:
        """The scale of a look with these colours."""
        if isinstance(self.range, tuple):
            return ColourScale(self.metric, self.map, RangeMode.PINNED, self.range, self.reverse)
        return ColourScale(self.metric, self.map, RangeMode(self.range.value), reverse=self.reverse)


def known_metric(name: str, known: object) -> None:
    """Raise `ParameterError` if a metric is unknown."""
    if name not in known:
        raise ParameterError(f"metric = {name!r} is unknown: expected one of {', '.join(known)}")
