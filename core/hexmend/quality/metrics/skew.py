"""Skew: how far the principal axes are from right angles; 1 where an axis has no length."""

from hexmend.kernels import metrics
from hexmend.quality.metric import Metric, kernel_metric

SKEW = Metric(
    name="skew",
    title="Skew",
    formula="greatest |cos| of the angle of two principal axes, 1 with an axis of no length",
    source="Verdict, SAND2007-1751",
    full_range=(0.0, 1.0),
    acceptable=(0.0, 0.5),
    better=-1,
    meaning="High values mean a sheared hex: gradients across it are less accurate.",
    of=kernel_metric(metrics.axes, rows=3, row=1, worst=1.0),
).register()
