"""Diagonal ratio: the shortest diagonal over the longest; 0 where none has a length."""

from hexmend.kernels import metrics
from hexmend.quality.metric import Metric, kernel_metric

DIAGONAL = Metric(
    name="diagonal",
    title="Diagonal ratio",
    formula="shortest / longest of the four diagonals, 0 where none has a length",
    source="Verdict, SAND2007-1751",
    full_range=(0.0, 1.0),
    acceptable=(0.65, 1.0),
    better=1,
    meaning="Low values mean a sheared hex, whose stiffness depends on the direction of the load.",
    of=kernel_metric(metrics.lengths, rows=3, row=2, worst=0.0),
).register()
