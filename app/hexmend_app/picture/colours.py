"""Colours of the hexes, and the quantities that they show, as values without Qt and VTK."""

from __future__ import annotations

import math
from dataclasses import dataclass
from enum import StrEnum

from hexmend.errors import ParameterError
from hexmend.quality import METRICS, HexQuantity
from hexmend_app.codec.conversion import ConfigTable, option
from hexmend_app.picture.colour_map import COLOUR_MAPS, DEFAULT_MAP
from hexmend_app.picture.displacement import DISPLACEMENT_QUANTITIES, hex_quantity
from hexmend_app.picture.visibility import known_metric

#: The material of a hex; its values are names, each with a colour of its own.
MATERIAL = HexQuantity(
    name="material",
    title="Material",
    formula="block, set, physical volume or region that holds the hex",
    source="the file of the mesh",
    full_range=(-math.inf, math.inf),
    acceptable=(-math.inf, math.inf),
    better=0,
    meaning="Hexes of the same material have the same colour.",
)


def colour_quantities() -> dict[str, HexQuantity]:
    """Return all quantities by name: quality metrics, displacements, and the material."""
    return {**METRICS, **DISPLACEMENT_QUANTITIES, MATERIAL.name: MATERIAL}


def colour_quantity(name: str) -> HexQuantity:
    """Return the quantity of a name; raises `ParameterError` for an unknown one."""
    return MATERIAL if name == MATERIAL.name else hex_quantity(name)


class Range(StrEnum):
    """Definition of a colour range that is not given by numbers."""

    FULL = "full"
    """All values that the metric can have."""
    FITTED = "fitted"
    """From the smallest to the largest value of the mesh, except one percent that is far outside of most."""
    ACCEPTABLE = "acceptable"
    """Values that are usually acceptable for solvers."""


@dataclass(frozen=True)
class Colours(ConfigTable):
    """Colours of the hexes; `hexmend_app.scene.colour.colouring.resolve` computes their range.

    Parameters
    ----------
    metric : str
        Quality metric, as listed by `hexmend info --metrics`, movement, or material.
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
        known_metric(self.metric, colour_quantities())
        if self.map not in COLOUR_MAPS:
            raise ParameterError(f"map = {self.map!r} is unknown: expected one of {', '.join(COLOUR_MAPS)}")
        if isinstance(self.range, tuple) and not self.range[0] < self.range[1]:
            raise ParameterError(f"range = {list(self.range)} is no range: expected the lower number first")
