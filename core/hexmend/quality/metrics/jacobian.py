"""Jacobian: the least determinant of the map at the corners and the centre."""

import math

import numpy as np

from hexmend.errors import MeshError
from hexmend.kernels import metrics
from hexmend.quality.measure import ElementQuality
from hexmend.quality.metric import Metric, kernel_metric

_at_centre = kernel_metric(metrics.centre, rows=1, row=0, worst=-math.inf)


def _least(points: np.ndarray, hexes: np.ndarray, quality: ElementQuality) -> np.ndarray:
    """Least of the centre's determinant and of sigma at the corners, the same that `ElementQuality.inverted` tests."""
    if len(quality.sigma) != len(hexes):
        raise MeshError(f"the quality is that of {len(quality.sigma)} hexes: expected that of the same {len(hexes)}")
    return np.fmin(quality.sigma, _at_centre(points, hexes, quality))


JACOBIAN = Metric(
    name="jacobian",
    title="Jacobian",
    formula="least of σ at the eight corners and of det[X₁, X₂, X₃] / 64 at the centre",
    source="Verdict, SAND2007-1751; Knupp 2000",
    full_range=(-math.inf, math.inf),
    acceptable=(0.0, math.inf),
    better=1,
    meaning="At 0 and below the map to the hex folds: integrals over it are meaningless, and most solvers stop.",
    of=_least,
    unit="mesh unit³",
).register()
