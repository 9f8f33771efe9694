"""Visible hexes of a scene, and their colours."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum

from hexmend.boundary.displacement import DISPLACEMENT_QUANTITIES
from hexmend.errors import ParameterError
from hexmend.quality import METRICS
from hexmend_app.codec.config_table import ConfigTable, option
from hexmend_app.picture.appearance import ColourScale, Isolation, Look, RangeMode, ValueRange
from hexmend_app.picture.colour_map import COLOUR_MAPS, DEFAULT_MAP

#: Hexes that are named one by one.
_MOST = 300_000


@dataclass(frozen=True)
class Isolate(ConfigTable):
    """Elements that are shown with what is around them, and nothing else.

    Parameters
    ----------
    hexes : tuple of int
        Their numbers, from 0.
    rings : int
        How often neighbours that share a node are taken in.
    """

    hexes: tuple[int, ...] = option((), low=0, high=2**31 - 1, most=_MOST)
    rings: int = option(1, low=0, high=1000)


@dataclass(frozen=True)
class Show(ConfigTable):
    """Visible hexes; all without keys.

    Parameters
    ----------
    quality : tuple of 2 floats, optional
        The least and the greatest value of what is shown; -inf and inf bound nothing.
    metric : str
        The metric that these are values of.
    inverted : bool
        Show inverted elements too, whatever their value.
    peel : int
        Hide elements with fewer than so many others between them and the boundary.
    isolate : Isolate, optional
        Such as { hexes = [12, 15], rings = 1 }: show these with their neighbours alone.
    hidden : tuple of int
        Elements that are hidden one by one, by number from 0.
    shrink : float
        The share of its size by which each element is drawn smaller.
    outline : bool
        Draw sharp edges, and the outline of the whole where a part is hidden.
    """

    quality: tuple[float, float] | None = option(open_ended=True)
    metric: str = option("q")
    inverted: bool = option(False)
    peel: int = option(0, low=0, high=100_000)
    isolate: Isolate | None = option()
    hidden: tuple[int, ...] = option((), low=0, high=2**31 - 1, most=_MOST)
    shrink: float = option(0.0, low=0, high=0.95)
    outline: bool = option(True)

    def check(self) -> None:
        """A metric that there is, and the lower value first."""
        known_metric(self.metric, METRICS)
        if self.quality is not None and not self.quality[0] <= self.quality[1]:
            raise ParameterError(f"quality = {list(self.quality)} is no range: expected the lower number first")

    @classmethod
    def as_in(cls, look: Look) -> Show:
        """Make the table from an appearance."""
        some, alone = look.quality_range, look.isolation
        bounds = {} if some is None else {"quality": (some.low, some.high), "metric": some.metric}
        return cls(
            **bounds,
            inverted=some is not None and some.inverted,
            peel=look.peel,
            isolate=None if alone is None else Isolate(alone.hexes, alone.rings),
            hidden=tuple(sorted(look.dug)),
            shrink=look.shrink,
            outline=look.outline,
        )

    def fields(self) -> dict[str, object]:
        """The same, as fields of a look."""
        some, alone = self.quality, self.isolate
        return {
            "quality_range": None if some is None else ValueRange(self.metric, *some, self.inverted),
            "peel": self.peel,
            "isolation": None if alone is None else Isolation(alone.hexes, alone.rings),
            "dug": frozenset(self.hidden),
            "shrink": self.shrink,
            "outline": self.outline,
        }

    def check_numbers(self, hexes: int) -> None:
        """Raise `ParameterError` unless a mesh of so many hexes has those that are named one by one."""
        named = (*self.hidden, *(self.isolate.hexes if self.isolate is not None else ()))
        if named and max(named) >= hexes:
            raise ParameterError(f"[show] names hex {max(named):,}: expected one of the mesh, below {hexes:,}")


class Range(StrEnum):
    """Origin of the two ends of the colour range, where they are not given as numbers."""

    FULL = "full"
    """Those that the metric can take."""
    FITTED = "fitted"
    """The least and the greatest of the mesh."""
    ACCEPTABLE = "acceptable"
    """Those that solvers are usually content with."""


@dataclass(frozen=True)
class Colours(ConfigTable):
    """Meaning of the colours of the hexes.

    Parameters
    ----------
    metric : str
        A quality metric, as `hexmend info --metrics` names them, or a movement.
    map : str
        viridis, cividis, plasma or inferno.
    range : Range or tuple of 2 floats
        full, fitted or acceptable, or the values at both ends.
    reverse : bool
        Run through the map from its other end.
    neutral : bool
        White outside and one colour inside, instead of values.
    """

    metric: str = option("q")
    map: str = option(DEFAULT_MAP)
    range: Range | tuple[float, float] = option(Range.FULL)
    reverse: bool = option(False)
    neutral: bool = option(False)

    def check(self) -> None:
        """A metric and a map that there are, and the lower value first."""
        known_metric(self.metric, {**METRICS, **DISPLACEMENT_QUANTITIES})
        if self.map not in COLOUR_MAPS:
            raise ParameterError(f"map = {self.map!r} is unknown: expected one of {', '.join(COLOUR_MAPS)}")
        if isinstance(self.range, tuple) and not self.range[0] < self.range[1]:
            raise ParameterError(f"range = {list(self.range)} is no range: expected the lower number first")

    @classmethod
    def as_in(cls, look: Look) -> Colours:
        """The colours of a look."""
        scale = look.scale
        ends = scale.pinned if scale.mode is RangeMode.PINNED else Range(scale.mode.value)
        return cls(scale.metric, scale.map, ends, scale.reverse, look.neutral)

    @property
    def scale(self) -> ColourScale:
        """The same, as a look has it."""
        pinned = isinstance(self.range, tuple)
        ends = (RangeMode.PINNED, self.range) if pinned else (RangeMode(self.range.value),)
        named = dict(zip(("mode", "pinned"), ends, strict=False))
        return ColourScale(self.metric, self.map, **named, reverse=self.reverse)


def known_metric(name: str, known: object) -> None:
    """Raise `ParameterError` for a metric that there is not."""
    if name not in known:
        raise ParameterError(f"metric = {name!r} is unknown: expected one of {', '.join(known)}")
