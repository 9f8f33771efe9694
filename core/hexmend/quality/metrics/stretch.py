"""Stretch: the shortest edge against the longest diagonal; 0 where an edge has no length."""

import math

from hexmend.kernels import metrics
from hexmend.quality.metric import Metric, kernel_metric

STRETCH = Metric(
    name="stretch",
    title="Stretch",
    formula="√3 · shortest edge / longest diagonal, 0 with an edge of no length",
    source="Verdict, SAND2007-1751",
    full_range=(0.0, math.inf),
    acceptable=(0.25, 1.0),
    better=1,
    meaning="Low values mean an edge that is short for the hex's size, which limits the time step of explicit solvers.",
    of=kernel_metric(metrics.lengths, rows=3, row=1, worst=0.0),
).register()
