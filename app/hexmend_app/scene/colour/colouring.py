"""Colours of hexes by a colour map, and special colours, for example of invalid hexes."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from hexmend.quality import ElementQuality
from hexmend_app.picture.colour_map import CHANGE_MAP, COLOUR_MAPS
from hexmend_app.picture.colours import MATERIAL, Colours, Range, colour_quantity
from hexmend_app.picture.displacement import DISPLACEMENT_QUANTITIES, ROUNDING
from hexmend_app.scene.colour.material_colours import material_table
from hexmend_app.scene.colour.ticks import ticks_with_ends
from hexmend_app.scene.colour.value_range import better, declared_range
from hexmend_app.theme import palette

#: Neutral colours: of boundary faces, and of faces inside the mesh that a cut or a filter exposes.
OUTSIDE, OPENED = (0xF2, 0xF2, 0xEF), (0xF6, 0xC9, 0x4C)

#: Colour of cells for which a metric has no value.
NO_VALUE = (0xA8, 0xAD, 0xB5)

#: Colours of invalid hexes: magenta of the inverted ones, which no colour map contains, and a lighter magenta of those
#: that are invalid inside. Colours of changes use magenta for newly invalid hexes, a duller magenta for hexes that are
#: still invalid, and yellow for repaired hexes.
INVERTED, INVALID_INSIDE = (
    (red, green, blue) for red, green, blue in map(bytes.fromhex, (palette.INVERTED[1:], palette.INVALID_INSIDE[1:]))
)
_STILL, _MENDED = (0x8E, 0x4B, 0x76), (0xF0, 0xE4, 0x42)


@dataclass(frozen=True)
class SpecialColour:
    """Colour of a group of hexes, independent of their values."""

    name: str
    colour: tuple[int, int, int]


INVALID_COLOURS = (SpecialColour("inverted", INVERTED), SpecialColour("invalid inside", INVALID_INSIDE))
_CHANGED = (
    SpecialColour("newly invalid", INVERTED),
    SpecialColour("still invalid", _STILL),
    SpecialColour("mended", _MENDED),
)

#: Percentiles of a robust range: its ends, and the middle half. Of larger meshes every so many values are taken.
_PERCENTILES, _SAMPLE = (0.5, 25, 75, 99.5), 200_000

#: Number of values below which all count.
_FEW = 200

#: Distance of far values from the middle half, in spans of it.
_FAR = 6.0

#: Minimum width of a fitted range relative to its values, for values that differ by rounding only.
_MIN_WIDTH = 1e-6


@dataclass(frozen=True, eq=False)
class Colouring:
    """`Colours` with their resolved range, for views, pictures and colour bars.

    Parameters
    ----------
    title : str
        Title of the metric.
    low, high : float
        Values of the first and the last colour.
    table : (256, 3) uint8
        Colours from the lowest to the highest value.
    special_colours : tuple of SpecialColour
    names : tuple of str
        Names of the values 0, 1, ... of materials, whose colours are then the rows of the table, (k, 3).
    beyond : (bool, bool)
        True if hexes with the first and with the last colour have values below and above the range.
    """

    title: str
    low: float
    high: float
    table: np.ndarray
    special_colours: tuple[SpecialColour, ...] = INVALID_COLOURS
    names: tuple[str, ...] = ()
    beyond: tuple[bool, bool] = (False, False)

    def colours(self, values: np.ndarray, kinds: np.ndarray) -> np.ndarray:
        """Return the colour of each hex, (k, 3) uint8.

        Parameters
        ----------
        values : (k,) float64
            Values outside the range get the colour of its nearest end.
        kinds : (k,) bool or uint8
            k for hexes with special colour number k, counted from 1; 0 for the others.
        """
        if self.names:
            return self._with_special(self.table[np.asarray(values, dtype=np.intp)], kinds)
        with np.errstate(over="ignore", invalid="ignore"):  # overflow is clipped
            row = (np.asarray(values) - self.low) * (255.999 / (self.high - self.low))
        np.clip(row, 0, 255, out=row)
        colours = self.table[np.nan_to_num(row, copy=False, nan=0.0).astype(np.uint8)]
        colours[np.isnan(values)] = NO_VALUE
        return self._with_special(colours, kinds)

    def neutral(self, opened: np.ndarray, kinds: np.ndarray) -> np.ndarray:
        """Return neutral colours of faces, (k, 3) uint8, with special colours.

        Parameters
        ----------
        opened : (k,) bool
            True for faces inside the mesh.
        kinds : (k,) bool or uint8
            As for `colours`.
        """
        return self._with_special(np.array([OUTSIDE, OPENED], np.uint8)[opened.astype(np.intp)], kinds)

    def _with_special(self, colours: np.ndarray, kinds: np.ndarray) -> np.ndarray:
        for kind, special in enumerate(self.special_colours, start=1):
            colours[kinds == kind] = special.colour
        return colours

    def label(self, value: float) -> str:
        """Format a value for the colour bar, to three digits of the range; name a material."""
        if self.names:
            return self.names[round(value)]
        return end_label(value, self.low, self.high, self.beyond)

    def ticks(self, space: float, wanted: int | tuple[float, ...]) -> list[float]:
        """Return the tick values of the colour bar.

        Parameters
        ----------
        space : float
            Minimum distance of values, as a fraction of the bar.
        wanted : int or tuple of float
            Maximum number of values, both ends first, or the values.
        """
        if isinstance(wanted, tuple):
            return [value for value in wanted if self.low <= value <= self.high]
        return ticks_with_ends(self.low, self.high, space, wanted)[: wanted if wanted < 2 else None]


def invalid_kinds(quality: ElementQuality) -> np.ndarray:
    """Return the number of the special colour of each hex, (m,) uint8: 1 if inverted, 2 if invalid inside, else 0."""
    return quality.invalid.astype(np.uint8) + (quality.invalid & ~quality.inverted)


def are_invalid(colours: np.ndarray) -> np.ndarray:
    """Return True for colours, (k, 3) uint8, of hexes that are inverted or invalid inside, (k,) bool."""
    return (colours == INVERTED).all(axis=1) | (colours == INVALID_INSIDE).all(axis=1)


def resolve(
    colours: Colours,
    values: np.ndarray,
    invalid: np.ndarray,
    ends_of_views: tuple[float, float] | None = None,
    title: str = "",
    names: tuple[str, ...] = (),
) -> Colouring:
    """Resolve the range of colours; views, pictures and colour bars all use this function.

    Parameters
    ----------
    colours : Colours
    values : (m,) float64
        Values of all hexes, hidden ones too, so that colours do not change with a cut.
    invalid : (m,) bool
        Invalid hexes have special colours; a range is fitted to them only if there are no others.
    ends_of_views : (low, high), optional
        Range of the values of other views, which a fitted range includes to make colours comparable.
    title : str
        Title of the colours; by default that of the metric.
    names : tuple of str
        Names of the materials, if the colours show these.
    """
    if colours.metric == MATERIAL.name:
        return Colouring(title or MATERIAL.title, 0.0, len(names) - 1.0, material_table(len(names)), names=names)
    ends, change = declared_ends(colours), colours.metric == "q-change"
    if ends is None:
        low, high = fitted(values, invalid)
        ends = (low, high) if ends_of_views is None else (min(low, ends_of_views[0]), max(high, ends_of_views[1]))
        if colours.metric in DISPLACEMENT_QUANTITIES:
            largest = max(abs(end) for end in ends)
            largest = largest if largest > ROUNDING else 1.0
            ends = (-largest if change else 0.0, largest)
    table = COLOUR_MAPS[CHANGE_MAP if change else colours.map].table
    if colours.reverse != (better(colours.metric) < 0):
        table = table[::-1]
    title, chosen = title or colour_quantity(colours.metric).title, values[np.isfinite(values) & ~invalid]
    least, most = colour_quantity(colours.metric).full_range  # exceeded only by rounding
    beyond = bool(ends[0] > least and (chosen < ends[0]).any()), bool(ends[1] < most and (chosen > ends[1]).any())
    return Colouring(title, *ends, table, _CHANGED if change else INVALID_COLOURS, beyond=beyond)


def declared_ends(colours: Colours) -> tuple[float, float] | None:
    """Return the range of colours; None if it is fitted to the values. Materials have a range without a meaning."""
    if colours.metric == MATERIAL.name:
        return 0.0, 1.0
    if isinstance(colours.range, tuple):
        return colours.range
    return None if colours.range is Range.FITTED else declared_range(colours.metric, colours.range)


def fitted(values: np.ndarray, invalid: np.ndarray) -> tuple[float, float]:
    """Return the range of values, (m,), except those of `invalid` hexes, (m,) bool; a point is widened.

    Values far outside of most, by more than `_FAR` times the span of their middle half, are left out up to one percent.
    """
    chosen = _ordinary(values, invalid)
    if not chosen.size:
        return 0.0, 1.0
    low, high = _robust_ends(chosen)
    missing = max(_MIN_WIDTH * max(abs(low), abs(high)), 1e-300) - (high - low)
    return (low, high) if missing <= 0 else (low - missing / 2, high + missing / 2)


def _ordinary(values: np.ndarray, invalid: np.ndarray) -> np.ndarray:
    """Return the finite values of hexes that are not invalid; of all, if these have none."""
    finite = np.isfinite(values)
    chosen = values[finite & ~invalid]
    return chosen if chosen.size else values[finite]


def _robust_ends(values: np.ndarray) -> tuple[float, float]:
    """Return the smallest and largest value, except a few that are far outside of most."""
    low, high = float(values.min()), float(values.max())
    if values.size < _FEW:
        return low, high
    first, lower, upper, last = (float(v) for v in np.percentile(values[:: 1 + values.size // _SAMPLE], _PERCENTILES))
    fence = _FAR * (upper - lower)
    if upper > lower:
        low = low if low >= lower - fence else max(low, min(first, lower - fence))
        high = high if high <= upper + fence else min(high, max(last, upper + fence))
    return low, high


def end_label(value: float, low: float, high: float, beyond: tuple[bool, bool]) -> str:
    """Format a value between `low` and `high`; an end beyond which there are values with ≤ or ≥.

    >>> end_label(0.0, 0, 1, (True, False)), end_label(1.0, 0, 1, (True, False)), end_label(-0.5, -1, 1, (True, True))
    ('≤ 0', '1', '−0.5')
    """
    sign = "≤ " if value == low and beyond[0] else "≥ " if value == high and beyond[1] else ""
    return sign + range_label(value, low, high).replace("-", "−")


def range_label(value: float, low: float, high: float) -> str:
    """Format a value between `low` and `high` to three digits of their difference.

    >>> range_label(0.25, 0, 1), range_label(0.31234, 0.3121, 0.3138), range_label(2e6, 0, 4e6)
    ('0.25', '0.31234', '2e+06')
    >>> range_label(1000002, 1000000, 1000004)
    '1000002'
    """
    size, span = max(abs(low), abs(high)), high - low
    if not span > 0:
        return f"{value:.4g}"
    smallest = math.floor(math.log10(span)) - 2
    if not 1e-3 <= size < 1e5:
        return f"{0.0 if abs(value) < 1e-6 * span else value:.{math.floor(math.log10(size)) - smallest + 1}g}"
    decimals = max(-smallest, 0)
    text = f"{value:.{decimals}f}"
    text = text.rstrip("0").rstrip(".") if "." in text else text
    return "0" if text == "-0" else text
