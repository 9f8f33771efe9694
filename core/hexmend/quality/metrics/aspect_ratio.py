"""Aspect ratio of the principal axes, Verdict's "maximum edge ratio"; +inf where an axis has no length."""

import math

from hexmend.kernels import metrics
from hexmend.quality.metric import Metric, kernel_metric

ASPECT_RATIO = Metric(
    name="aspect-ratio",
    title="Aspect ratio",
    formula="longest / shortest of the principal axes Xᵢ, ∞ with an axis of no length",
    source="Verdict, SAND2007-1751 (maximum edge ratio); acceptable range of Cubit, as Verdict's ends at 1.3",
    full_range=(1.0, math.inf),
    acceptable=(1.0, 4.0),
    better=-1,
    meaning=(
        "High values suit a solution that changes along the short axis only, as in a boundary layer; "
        "elsewhere they cost accuracy."
    ),
    of=kernel_metric(metrics.axes, rows=3, row=0, worst=math.inf),
).register()
