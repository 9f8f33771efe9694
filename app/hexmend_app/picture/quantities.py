"""Quantities that colour hexes: quality metrics, displacements, and the material."""

from __future__ import annotations

import math

from hexmend.quality import METRICS, HexQuantity
from hexmend_app.picture.displacement import DISPLACEMENT_QUANTITIES, hex_quantity

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
    """Return all quantities by name."""
    return {**METRICS, **DISPLACEMENT_QUANTITIES, MATERIAL.name: MATERIAL}


def colour_quantity(name: str) -> HexQuantity:
    """Return the quantity of a name; raises `ParameterError` for an unknown one."""
    return MATERIAL if name == MATERIAL.name else hex_quantity(name)
