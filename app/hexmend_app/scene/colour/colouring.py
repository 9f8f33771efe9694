"""Colours of hexes by a colour map, and special colours, such as that of inverted hexes."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from hexmend.boundary.displacement import DISPLACEMENT_QUANTITIES, ROUNDING, hex_quantity
from hexmend_app.picture.appearance import ColourScale, RangeMode
from hexmend_app.picture.colour_map import CHANGE_MAP, COLOUR_MAPS
from hexmend_app.scene.colour.value_range import better, declared_range
from hexmend_app.theme.palette import INVERTED as MAGENTA

#: Colours of what shows no value: the outside of the mesh, and what is opened by a cut or a filter.
OUTSIDE, OPENED = (0xF2, 0xF2, 0xEF), (0xF6, 0xC9, 0x4C)

#: Colour of inverted elements, in no map of ours: magenta. In colours of changes it is that of the newly inverted; what
#: was so before is duller, and what no longer is is yellow.
INVERTED = tuple(bytes.fromhex(MAGENTA[1:]))
_STILL, _MENDED = (0x8E, 0x4B, 0x76), (0xF0, 0xE4, 0x42)


@dataclass(frozen=True)
class SpecialColour:
    """Colour of a group of hexes, whatever their values."""

    name: str
    colour: tuple[int, int, int]


_INVERTED = (SpecialColour("inverted", INVERTED),)
_CHANGED = (
    SpecialColour("newly inverted", INVERTED),
    SpecialColour("still inverted", _STILL),
    SpecialColour("mended", _MENDED),
)

# A fitted range is at least this wide, relative to its values: less is rounding.
_NARROWEST = 1e-6


@dataclass(frozen=True, eq=False)
class Colouring:
    """A `ColourScale` with known ends of its range, as view, picture and colour bar use it.

    Parameters
    ----------
    title : str
        Of the metric.
    low, high : float
        Values of the first and the last colour.
    table : (256, 3) uint8
        The colours, that of the lowest value first.
    apart : tuple of SpecialColour
    """

    title: str
    low: float
    high: float
    table: np.ndarray
    special_colours: tuple[SpecialColour, ...] = _INVERTED

    def colours(self, values: np.ndarray, kinds: np.ndarray) -> np.ndarray:
        """Return the colour of each hex, (k, 3) uint8.

        Parameters
        ----------
        values : (k,) float64
            Values beyond the ends of the range have the ends' colours.
        kinds : (k,) bool or uint8
            1 for what has the first colour of `apart` whatever its value, 2 for the second...; 0 for the others.
        """
        with np.errstate(over="ignore", invalid="ignore"):  # far beyond an end is beyond it
            place = (np.asarray(values) - self.low) * (255.999 / (self.high - self.low))
        np.clip(place, 0, 255, out=place)
        # What has no value (nan) is inverted, or else drawn as the lowest.
        answer = self.table[np.nan_to_num(place, copy=False, nan=0.0).astype(np.uint8)]
        return self._special(answer, kinds)

    def neutral(self, opened: np.ndarray, kinds: np.ndarray) -> np.ndarray:
        """Return the colours of faces in neutral colours, (k, 3) uint8, with special colours.

        Parameters
        ----------
        opened : (k,) bool
            True for faces inside the mesh.
        kinds : (k,) bool or uint8
            As for `colours`.
        """
        return self._special(np.array([OUTSIDE, OPENED], np.uint8)[opened.astype(np.intp)], kinds)

    def _special(self, colours: np.ndarray, kinds: np.ndarray) -> np.ndarray:
        for kind, one in enumerate(self.special_colours, start=1):
            colours[kinds == kind] = one.colour
        return colours

    def label(self, value: float) -> str:
        """Format a value for the colour bar, with three digits of the range."""
        return range_label(value, self.low, self.high)


def resolve(
    scale: ColourScale,
    values: np.ndarray,
    inverted: np.ndarray,
    neighbour: tuple[float, float] | None = None,
    title: str = "",
) -> Colouring:
    """Find the ends of the range of a scale; view, pictures and colour bars all use this function.

    Parameters
    ----------
    scale : ColourScale
    values : (m,) float64
        Of all elements, hidden ones too, so that colours do not change as a cut is moved.
    inverted : (m,) bool
        They have a colour of their own, so no range is fitted to them unless there are no others.
    beside : (low, high), optional
        Values of other meshes that a fitted range includes, so that colours can be compared.
    title : str
        Of what the colours show, where it is not the metric's.
    """
    ends, change = declared_ends(scale), scale.metric == "q-change"
    if ends is None:
        low, high = fitted(values, inverted)
        ends = (low, high) if neighbour is None else (min(low, neighbour[0]), max(high, neighbour[1]))
        if scale.metric in DISPLACEMENT_QUANTITIES:
            most = max(abs(end) for end in ends)
            most = most if most > ROUNDING else 1.0
            ends = (-most if change else 0.0, most)
    colours = COLOUR_MAPS[CHANGE_MAP if change else scale.map].table
    if scale.reverse != (better(scale.metric) < 0):
        colours = colours[::-1]
    return Colouring(title or hex_quantity(scale.metric).title, *ends, colours, _CHANGED if change else _INVERTED)


def declared_ends(scale: ColourScale) -> tuple[float, float] | None:
    """Return the range of a scale; None if it is fitted to the values."""
    if scale.mode is RangeMode.PINNED:
        return scale.pinned
    return None if scale.mode is RangeMode.FITTED else declared_range(scale.metric, scale.mode)


def fitted(values: np.ndarray, inverted: np.ndarray) -> tuple[float, float]:
    """Return the range of values (m,) without those of `inverted` hexes, (m,) bool, widened if it is empty."""
    finite = np.isfinite(values)
    chosen = values[finite & ~inverted]
    if not chosen.size:
        chosen = values[finite]
    if not chosen.size:
        return 0.0, 1.0
    low, high = float(chosen.min()), float(chosen.max())
    lacking = max(_NARROWEST * max(abs(low), abs(high)), 1e-300) - (high - low)
    return (low, high) if lacking <= 0 else (low - lacking / 2, high + lacking / 2)


def range_label(value: float, low: float, high: float) -> str:
    """Format a value between `low` and `high` with three digits of their difference.

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
