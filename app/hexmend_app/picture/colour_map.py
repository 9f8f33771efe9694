"""Colour maps by name: those of matplotlib, and those of entry points."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property, partial

import numpy as np

from hexmend.registry import Registry, load_entry_points
from hexmend_app.resources import resource

#: Default map, and map of changes.
DEFAULT_MAP, CHANGE_MAP = "viridis", "BrBG"


@dataclass(frozen=True)
class ColourMap:
    """A colour map.

    Parameters
    ----------
    name : str
        Name in files and on the command line.
    help : str
        One sentence for users.
    colours : callable
        Returns the colours as (256, 3) uint8, from dark to light; called when they are first needed.
    title : str
        Name in the window; by default `name`.
    diverging : bool
        The map has a neutral colour in the middle, which suits changes but not values.
    """

    name: str
    help: str
    colours: Callable[[], np.ndarray]
    title: str = ""
    diverging: bool = False

    @cached_property
    def table(self) -> np.ndarray:
        """Colours, (256, 3) uint8, read-only."""
        colours = self.colours()
        colours.flags.writeable = False
        return colours


def load_colour_maps() -> None:
    """Import the modules of entry points, which registers their maps."""
    load_entry_points("hexmend.colour_maps", "colour map", COLOUR_MAPS.expect)


COLOUR_MAPS: Registry[ColourMap] = Registry("colour map", load_colour_maps)


def _stored(name: str) -> np.ndarray:
    """Return the colours of a map of matplotlib from a file, so that matplotlib need not be imported."""
    with np.load(resource("colour_maps.npz")) as tables:
        return tables[name]


for _name, _title, _help in (
    ("viridis", "", "From violet over green to yellow."),
    ("cividis", "", "From blue to yellow; looks nearly the same with all kinds of colour vision."),
    ("plasma", "", "From blue over red to yellow."),
    ("inferno", "", "From black over red to pale yellow."),
    (CHANGE_MAP, "brown – teal", "For changes: from brown for worse over white for none to teal for better."),
):
    COLOUR_MAPS.add(_name, ColourMap(_name, _help, partial(_stored, _name), _title, diverging=_name == CHANGE_MAP))


def value_maps() -> tuple[str, ...]:
    """Return the names of the maps for values, which are all maps except diverging maps."""
    return tuple(name for name, colour_map in COLOUR_MAPS.items() if not colour_map.diverging)


def between(*stops: Sequence[int]) -> np.ndarray:
    """Return a colour table that interpolates colours linearly.

    Parameters
    ----------
    *stops : (red, green, blue)
        At least two colours, 0 to 255, at equal distances in the map.

    Returns
    -------
    (256, 3) uint8

    >>> between((0, 0, 0), (255, 255, 255))[[0, 100, 255]].tolist()
    [[0, 0, 0], [100, 100, 100], [255, 255, 255]]
    """
    channels, x = np.array(stops, float).T, np.linspace(0, len(stops) - 1, 256)
    table = np.stack([np.interp(x, np.arange(len(stops)), channel) for channel in channels], axis=1)
    return table.round().astype(np.uint8)
