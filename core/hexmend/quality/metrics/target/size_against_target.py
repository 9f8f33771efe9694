"""Size against target: a hex's lengths over those of its target, in the geometric mean; 1 without a target."""

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
    return np.cbrt(ratios).prod(axis=1)


SIZE_AGAINST_TARGET = Metric(
    name="size-against-target",
    title="Size vs target",
    formula="∛((l₁ l₂ l₃) / (t₁ t₂ t₃)): mean edge lengths along the three directions over those of the target",
    source="Hexmend",
    full_range=(0.0, math.inf),
    acceptable=(0.5, 2.0),
    better=0,
    meaning="Far from 1 the hex is larger or smaller than the target asks for.",
    of=lambda points, hexes, quality: np.ones(len(hexes)),
    of_mesh=_of_mesh,
).register()
