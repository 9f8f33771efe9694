"""Values of metrics, worked out once for all that shows them: colours, range filter and histogram."""

from __future__ import annotations

from weakref import WeakKeyDictionary

import numpy as np

from hexmend.quality import METRICS, ElementQuality

#: Metrics that are remembered of one mesh at one time: those that are looked at by turns.
_MOST = 3

#: Values by metric, of each mesh at one time.
REMEMBERED: WeakKeyDictionary[ElementQuality, dict[str, np.ndarray]] = WeakKeyDictionary()


def metric_values(metric: str, points: np.ndarray, hexes: np.ndarray, figures: ElementQuality) -> np.ndarray:
    """Value of each hex, (m,) float64, to be read only; remembered as long as `figures` lives.

    A worker that calls this before it hands its figures over spares the window the work.

    Parameters
    ----------
    metric : str
        A name of `hexmend.quality.METRICS`.
    points : (n, 3) float64
    hexes : (m, 8) int32
    figures : ElementQuality
        Of the hexes at these points.
    """
    known = REMEMBERED.setdefault(figures, {})
    found = known.get(metric)
    if found is None:
        found = METRICS[metric].of(points, hexes, figures)
        while len(known) >= _MOST:
            known.pop(next(iter(known)), None)
        known[metric] = found
    return found
