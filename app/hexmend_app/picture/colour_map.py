"""Colour maps by name: every module of `hexmend_app.picture.colour_maps` registers its own."""

from __future__ import annotations

import pkgutil
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property
from importlib import import_module

import numpy as np

from hexmend.registry import Registry

#: The map that is used until another one is chosen, and the map of changes.
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
        Returns the colours as (256, 3) uint8, from the dark end to the light one; called when they are first drawn.
    title : str
        Name in the window, if it is not `name`.
    diverging : bool
        The map has a neutral colour in its middle: it suits changes, not values.
    """

    name: str
    help: str
    colours: Callable[[], np.ndarray]
    title: str = ""
    diverging: bool = False

    @cached_property
    def table(self) -> np.ndarray:
        """The colours, (256, 3) uint8, read-only."""
        colours = self.colours()
        colours.flags.writeable = False
        return colours


def load_colour_maps() -> None:
    """Import every module of the folder of colour maps."""
    package = import_module("hexmend_app.picture.colour_maps")
    for module in pkgutil.iter_modules(package.__path__):
        import_module(f"{package.__name__}.{module.name}")


COLOUR_MAPS: Registry[ColourMap] = Registry("colour map", load_colour_maps)


def value_maps() -> tuple[str, ...]:
    """Return the names of the maps for values: all but diverging ones."""
    return tuple(name for name, one in COLOUR_MAPS.items() if not one.diverging)


def between(*stops: Sequence[int]) -> np.ndarray:
    """Interpolate colours linearly.

    Parameters
    ----------
    *stops : (red, green, blue)
        At least two colours, 0 to 255, evenly spaced over the map.

    Returns
    -------
    (256, 3) uint8

    >>> between((0, 0, 0), (255, 255, 255))[[0, 100, 255]].tolist()
    [[0, 0, 0], [100, 100, 100], [255, 255, 255]]
    """
    colours, at = np.array(stops, float), np.linspace(0, len(stops) - 1, 256)
    return np.stack([np.interp(at, np.arange(len(stops)), one) for one in colours.T], axis=1).round().astype(np.uint8)
