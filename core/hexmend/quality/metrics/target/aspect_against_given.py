"""Aspect against given: change of the proportions of a hex from those of its target; 1 without a target."""

import math

import numpy as np

from hexmend.mesh.edge_length import hex_lengths
from hexmend.mesh.mesh import Mesh
from hexmend.quality.measure import ElementQuality
from hexmend.quality.metric import Metric


def _of_mesh(mesh: Mesh, quality: ElementQuality) -> np.ndarray:
    if mesh.element_target is None:
        return np.ones(mesh.n_hexes)
    ratios = hex_lengths(mesh.points, mesh.hexes) / mesh.element_target.lengths
    least = ratios.min(axis=1)
    return np.divide(ratios.max(axis=1), least, out=np.full(mesh.n_hexes, math.inf), where=least > 0)


ASPECT_AGAINST_GIVEN = Metric(
    name="aspect-against-given",
    title="Aspect vs given",
    formula="greatest / least of lᵢ / tᵢ: mean edge lengths along the three directions over those of the target",
    source="Hexmend",
    full_range=(1.0, math.inf),
    acceptable=(1.0, 2.0),
    better=-1,
    meaning="High values mean that grading, such as that of boundary layers, has changed.",
    of=lambda points, hexes, quality: np.ones(len(hexes)),
    of_mesh=_of_mesh,
).register()
