"""Values that colours show: the one place where the app asks a metric for them."""

from __future__ import annotations

import numpy as np

from hexmend.quality import METRICS, ElementQuality
from hexmend_app.state.look import RangeMode


def values(metric: str, points: np.ndarray, hexes: np.ndarray, figures: ElementQuality) -> np.ndarray:
    """Value of each hex, (m,) float64.

    Parameters
    ----------
    metric : str
        A name of `hexmend.quality.METRICS`.
    points : (n, 3) float64
    hexes : (m, 8) int32
    figures : ElementQuality
        Of the hexes at these points.
    """
    return METRICS[metric].of(points, hexes, figures)


def better(metric: str) -> int:
    """1 for a metric of which more is better, -1 where less is, 0 where neither is."""
    return METRICS[metric].better


def declared_range(metric: str, mode: RangeMode) -> tuple[float, float] | None:
    """The range that a metric itself declares for the mode FULL or ACCEPTABLE; None where an end of it is infinite."""
    declared = METRICS[metric].full_range if mode is RangeMode.FULL else METRICS[metric].acceptable
    return tuple(map(float, declared)) if np.isfinite(declared).all() else None
