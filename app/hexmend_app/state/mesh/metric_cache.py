"""Cache of metric values for all that shows them: colours, range filter and histogram."""

from __future__ import annotations

from weakref import WeakKeyDictionary

import numpy as np

from hexmend.mesh.mesh import Mesh
from hexmend.quality import METRICS, ElementQuality

#: Maximum number of cached metrics of one state.
_MAX_CACHED_METRICS = 3

#: Values by metric, for the quality of each state.
CACHE: WeakKeyDictionary[ElementQuality, dict[str, np.ndarray]] = WeakKeyDictionary()


def metric_values(metric: str, mesh: Mesh, quality: ElementQuality) -> np.ndarray:
    """Return the value of each hex, (m,) float64, not to be modified; cached as long as `quality` lives.

    Workers call this in advance to relieve the window.

    Parameters
    ----------
    metric : str
        Name in `hexmend.quality.METRICS`.
    mesh : Mesh
    quality : ElementQuality
        Quality of its hexes.
    """
    cached = CACHE.setdefault(quality, {})
    values = cached.get(metric)
    if values is None:
        values = METRICS[metric].values(mesh, quality)
        while len(cached) >= _MAX_CACHED_METRICS:
            cached.pop(next(iter(cached)), None)
        cached[metric] = values
    return values
