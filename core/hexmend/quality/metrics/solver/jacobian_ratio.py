"""Jacobian ratio: the greatest determinant over the least; +inf for an invalid hex."""

import math

import numpy as np

from hexmend.quality.finite_volume.geometry import divide
from hexmend.quality.metric import Metric
from hexmend.quality.validity import jacobian_bounds


def _ratio(bounds: np.ndarray) -> np.ndarray:
    least, greatest = bounds.T
    return np.where(least > 0, np.maximum(divide(greatest, least, math.inf), 1.0), math.inf)


JACOBIAN_RATIO = Metric(
    name="jacobian-ratio",
    title="Jacobian ratio",
    formula=(
        "greatest / least det J in the hex, by certified bounds within 2 %, ∞ where det J is not positive everywhere; "
        "of second-order hexes by their own map"
    ),
    source=(
        "Johnen, Remacle, Geuzaine 2013; acceptable below the warning limit of the ANSYS Theory Reference, Element "
        "Shape Testing"
    ),
    full_range=(1.0, math.inf),
    acceptable=(1.0, 30.0),
    better=-1,
    meaning="High values mean a map to the hex that is far from linear: quadrature loses accuracy.",
    of=lambda points, hexes, quality: _ratio(jacobian_bounds(points, hexes)),
    of_mesh=lambda mesh, quality: _ratio(jacobian_bounds(mesh.points, mesh.hexes, mesh.mid_nodes)),
).register()
