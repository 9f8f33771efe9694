"""Change of the lengths of hexes by a run that does not aim at them."""

from __future__ import annotations

import numpy as np

from hexmend.layers.targets import MAX_DISTORTED
from hexmend.mesh.mesh import Mesh
from hexmend.quality import ElementQuality
from hexmend.target.edge_lengths import given_lengths
from hexmend.target.sheets import DISTORTED

#: Factor beyond which a length has changed much, and the share of hexes with such a length that is worth a sentence.
_MUCH, _SHARE = 2.0, 0.05
#: Approximate number of hexes that are compared.
_SAMPLE = 50_000


def grading_message(before: Mesh, after: Mesh, quality: ElementQuality) -> str:
    """Tell by which factor lengths of hexes have changed, where many have changed much; "" otherwise.

    Parameters
    ----------
    before, after : Mesh
        Meshes of the same hexes.
    quality : ElementQuality
        Of the mesh before.
    """
    if np.mean(quality.scaled_jacobian < DISTORTED) > MAX_DISTORTED:
        return ""
    sample = np.arange(0, before.n_hexes, before.n_hexes // _SAMPLE + 1)
    factors = np.exp(np.abs(np.log(given_lengths(after, sample) / given_lengths(before, sample)))).max(axis=1)
    if np.mean(factors > _MUCH) < _SHARE:
        return ""
    return f"Edge lengths change by up to a factor of {factors.max():.1f}; --target given-shape keeps them."
