"""Colours of elements: maps that all kinds of colour vision can read, and a colour of its own for what is inverted."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cache

import numpy as np

from hexmend.boundary.displacement import DISPLACEMENT_QUANTITIES, ROUNDING, hex_quantity
from hexmend_app.resources import resource
from hexmend_app.scene.palette import INVERTED as MAGENTA
from hexmend_app.scene.values import better, declared_range
from hexmend_app.state.look import COLOUR_MAPS, ColourScale, RangeMode

#: The maps on offer, each perceptually uniform; the first is the default. None diverges: that would need a value in the
#: middle that means something, and the one there might be, zero, parts off the inverted, which have their own colour.
MAPS = COLOUR_MAPS[:-1]

#: The map of changes, in whose middle is none: from brown for worse to teal for better.
DIVERGING = COLOUR_MAPS[-1]

#: Colours of what shows no value: the outside of the mesh, and what is opened by a cut or a filter.
OUTSIDE, OPENED = (0xF2, 0xF2, 0xEF), (0xF6, 0xC9, 0x4C)

#: Colour of inverted elements, in no map of ours: magenta. In colours of changes it is that of the newly inverted; what
#: was so before is duller, and what no longer is is yellow.
INVERTED = tuple(bytes.fromhex(MAGENTA[1:]))
_STILL, _MENDED = (0x8E, 0x4B, 0x76), (0xF0, 0xE4, 0x42)


@dataclass(frozen=True)
class Apart:
    """Elements that have a colour of their own, whatever their value."""

    name: str
    colour: tuple[int, int, int]


_INVERTED = (Apart("inverted", INVERTED),)
_CHANGED = (Apart("newly inverted", INVERTED), Apart("still inverted", _STILL), Apart("mended", _MENDED))

# A fitted range is at least this wide, relative to its values: less is rounding.
_NARROWEST = 1e-6


@cache
def table(name: str) -> np.ndarray:
    """A colour map as (256, 3) uint8, from its dark end to its light one.

    Raises
    ------
    KeyError
        For a map that is not among `MAPS`.
    """
    if name not in (*MAPS, DIVERGING):
        raise KeyError(f"there is no colour map {name!r}: known are {', '.join(MAPS)}")
    with np.load(resource("colour_maps.npz")) as kept:
        colours = kept[name]
    colours.flags.writeable = False
    return colours


@dataclass(frozen=True, eq=False)
class Colouring:
    """A `ColourScale` with the ends of its range found: what view, picture and colour bar draw by.

    Parameters
    ----------
    title : str
        Of the metric.
    low, high : float
        What the first and the last colour stand for.
    table : (256, 3) uint8
        The colours, that of the lowest value first.
    apart : tuple of Apart
    """

    title: str
    low: float
    high: float
    table: np.ndarray
    apart: tuple[Apart, ...] = _INVERTED

    def colours(self, values: np.ndarray, kinds: np.ndarray) -> np.ndarray:
        """Colour of each element, (k, 3) uint8.

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
        return self._set_apart(answer, kinds)

    def neutral(self, opened: np.ndarray, kinds: np.ndarray) -> np.ndarray:
        """Colour of faces that show no value, (k, 3) uint8, but what is set apart.

        Parameters
        ----------
        opened : (k,) bool
            Whether each lies inside the mesh.
        kinds : (k,) bool or uint8
            As for `colours`.
        """
        return self._set_apart(np.array([OUTSIDE, OPENED], np.uint8)[opened.astype(np.intp)], kinds)

    def _set_apart(self, colours: np.ndarray, kinds: np.ndarray) -> np.ndarray:
        for kind, one in enumerate(self.apart, start=1):
            colours[kinds == kind] = one.colour
        return colours

    def label(self, value: float) -> str:
        """A value as it stands on the colour bar, with three digits of the range."""
        return range_label(value, self.low, self.high)


def resolve(
    scale: ColourScale,
    values: np.ndarray,
    inverted: np.ndarray,
    beside: tuple[float, float] | None = None,
    title: str = "",
) -> Colouring:
    """Find the ends of a scale's range: here alone, so that all that shows colours agrees.

    Parameters
    ----------
    scale : ColourScale
    values : (m,) float64
        Of all elements, hidden ones too, so that colours do not change as a cut is moved.
    inverted : (m,) bool
        They have a colour of their own, so no range is fitted to them unless there are no others.
    beside : (low, high), optional
        What a range that is fitted has to span too: the values of meshes that are to be compared by their colours.
    title : str
        Of what the colours show, where it is not the metric's.
    """
    ends, change = declared_ends(scale), scale.metric == "q-change"
    if ends is None:
        low, high = fitted(values, inverted)
        ends = (low, high) if beside is None else (min(low, beside[0]), max(high, beside[1]))
        if scale.metric in DISPLACEMENT_QUANTITIES:
            most = max(abs(end) for end in ends)
            most = most if most > ROUNDING else 1.0
            ends = (-most if change else 0.0, most)
    colours = table(DIVERGING if change else scale.map)
    if scale.reverse != (better(scale.metric) < 0):
        colours = colours[::-1]
    return Colouring(title or hex_quantity(scale.metric).title, *ends, colours, _CHANGED if change else _INVERTED)


def declared_ends(scale: ColourScale) -> tuple[float, float] | None:
    """The range where it does not depend on the values; None where it is fitted to them."""
    if scale.mode is RangeMode.PINNED:
        return scale.pinned
    return None if scale.mode is RangeMode.FITTED else declared_range(scale.metric, scale.mode)


def fitted(values: np.ndarray, inverted: np.ndarray) -> tuple[float, float]:
    """The least and the greatest of values (m,), those of (m,) bool `inverted` elements left out, a little apart."""
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
    """A value between `low` and `high` in three digits of their distance.

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
