"""Check for inverted hexes, which every solver's report has whether or not that solver looks for them."""

from __future__ import annotations

from hexmend.solver_checks.check import Check, Level

INVERSION = Check(
    name="inverted hexes",
    of=lambda measures: measures.quality.scaled_jacobian,
    unit_of_count="hexes",
    better=1,
    limit=0.0,
    level=Level.ERROR,
    definition="scaled Jacobian: least over the corners of the volume of unit edges",
    source="Hexmend, for every solver: its own checks can miss a hex that is inverted at one corner",
    inclusive=True,
)
