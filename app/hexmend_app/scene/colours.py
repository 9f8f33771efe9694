"""Colours of elements: maps that all kinds of colour vision can read, and a colour of its own for what is inverted."""

from __future__ import annotations

from functools import cache

import numpy as np

#: The maps on offer, each perceptually uniform; the first is the default.
MAPS = ("viridis", "cividis", "plasma", "inferno")

#: Colour of inverted elements, in no map of ours: magenta.
INVERTED = (0xE6, 0x19, 0x8A)


@cache
def table(name: str) -> np.ndarray:
    """A colour map as (256, 3) uint8, the worst quality first.

    Raises
    ------
    KeyError
        For a map that is not among `MAPS`.
    """
    if name not in MAPS:
        raise KeyError(f"there is no colour map {name!r}: known are {', '.join(MAPS)}")
    from matplotlib import colormaps

    colours = (colormaps[name](np.linspace(0, 1, 256))[:, :3] * 255).round().astype(np.uint8)
    colours.flags.writeable = False
    return colours


def colours(values: np.ndarray, inverted: np.ndarray, colour_range: tuple[float, float], name: str) -> np.ndarray:
    """Colour of each element, (k, 3) uint8.

    Parameters
    ----------
    values : (k,) float64
        Values beyond the ends of the range have the ends' colours.
    inverted : (k,) bool
        These have the colour `INVERTED`, whatever their value.
    colour_range : (low, high)
    name : str
        Of `MAPS`.
    """
    low, high = colour_range
    place = (np.asarray(values) - low) * (255.999 / max(high - low, 1e-300))
    answer = table(name)[np.clip(place, 0, 255).astype(np.uint8)]
    answer[inverted] = INVERTED
    return answer
