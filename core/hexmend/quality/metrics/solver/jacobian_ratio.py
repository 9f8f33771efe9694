"""Jacobian ratio: the greatest determinant over the least; +inf for an inverted hex."""

import math

import numpy as np

from hexmend.mesh.mesh import Mesh
from hexmend.mesh.second_order import jacobian_range
from hexmend.quality.finite_volume.geometry import divide
from hexmend.quality.measure import ElementQuality, corner_determinants
from hexmend.quality.metric import Metric


def _of_corners(points: np.ndarray, hexes: np.ndarray, quality: ElementQuality) -> np.ndarray:
    sigma = corner_determinants(points, hexes)
    return _ratio(sigma.min(axis=1, initial=math.inf), sigma.max(axis=1, initial=-math.inf))


def _of_mesh(mesh: Mesh, quality: ElementQuality) -> np.ndarray:
    """The ratio of corners; of second-order hexes that of their nodes and Gauss points."""
    ratio = _of_corners(mesh.points, mesh.hexes, quality)
    if mesh.mid_nodes is None:
        return ratio
    least, greatest = jacobian_range(mesh.points, mesh.hexes, mesh.mid_nodes).T
    return np.where(np.isnan(least), ratio, _ratio(least, greatest))


def _ratio(least: np.ndarray, greatest: np.ndarray) -> np.ndarray:
    return np.where(least > 0, np.maximum(divide(greatest, least, math.inf), 1.0), math.inf)


JACOBIAN_RATIO = Metric(
    name="jacobian-ratio",
    title="Jacobian ratio",
    formula=(
        "greatest / least of σ at the eight corners, ∞ with a least of 0 or below; of second-order hexes at the nodes "
        "and the 3 × 3 × 3 Gauss points"
    ),
    source="ANSYS Theory Reference, Element Shape Testing; acceptable below its warning limit",
    full_range=(1.0, math.inf),
    acceptable=(1.0, 30.0),
    better=-1,
    meaning="High values mean a map to the hex that is far from linear: quadrature loses accuracy.",
    of=_of_corners,
    of_mesh=_of_mesh,
).register()
