"""Taper: how much the axes change from one side to the other; +inf where an axis has no length."""

import math

from hexmend.kernels import metrics
from hexmend.quality.metric import Metric, kernel_metric

TAPER = Metric(
    name="taper",
    title="Taper",
    formula="greatest |Xᵢⱼ| / min(|Xᵢ|, |Xⱼ|), Xᵢⱼ the cross derivatives, ∞ with an axis of no length",
    source="Verdict, SAND2007-1751",
    full_range=(0.0, math.inf),
    acceptable=(0.0, 0.5),
    better=-1,
    meaning=(
        "High values mean opposite faces of different size: the map to the hex is far from linear, which makes "
        "quadrature inaccurate."
    ),
    of=kernel_metric(metrics.axes, rows=3, row=2, worst=math.inf),
).register()
