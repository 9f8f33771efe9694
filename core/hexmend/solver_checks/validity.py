"""Check for invalid hexes, which every solver's report has whether or not that solver looks for them."""

from __future__ import annotations

import numpy as np

from hexmend.quality.validity import jacobian_bounds
from hexmend.solver_checks.check import Check, Level
from hexmend.solver_checks.measures import Measures


def jacobian_ratios(measures: Measures) -> np.ndarray:
    """Certified lower bound of the least det J of each hex over the greatest, (m,); above 0 just where it is valid."""
    mesh = measures.mesh
    bounds = jacobian_bounds(mesh.points, mesh.hexes, mesh.mid_nodes)
    scale = np.abs(bounds).max(axis=1)
    ratios = np.divide(bounds[:, 0], scale, out=np.zeros(len(bounds)), where=(scale > 0) & np.isfinite(scale))
    smallest = np.finfo(np.float64).tiny
    return np.where(measures.quality.invalid, np.minimum(ratios, 0.0), np.maximum(ratios, smallest))


VALIDITY = Check(
    name="invalid hexes",
    of=jacobian_ratios,
    unit_of_count="hexes",
    better=1,
    limit=0.0,
    level=Level.ERROR,
    definition="certified lower bound of the least Jacobian determinant everywhere in a hex over the greatest",
    source="Hexmend, for every solver: its own checks can miss hexes that are inverted at a corner or invalid inside",
    inclusive=True,
)
