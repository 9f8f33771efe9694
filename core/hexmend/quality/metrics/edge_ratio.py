"""Edge ratio: the longest edge over the shortest; +inf where an edge has no length."""

import math

from hexmend.kernels import metrics
from hexmend.quality.metric import Metric, kernel_metric

EDGE_RATIO = Metric(
    name="edge-ratio",
    title="Edge ratio",
    formula="longest / shortest of the twelve edges, ∞ with an edge of no length",
    source="Verdict, SAND2007-1751; acceptable range of HyperMesh, as Verdict has none",
    full_range=(1.0, math.inf),
    acceptable=(1.0, 5.0),
    better=-1,
    meaning=(
        "High values resolve the solution unevenly: gradients along the long edges are lost, and the "
        "short ones set the time step."
    ),
    of=kernel_metric(metrics.lengths, rows=3, row=0, worst=math.inf),
).register()
