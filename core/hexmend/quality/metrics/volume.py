"""Volume inside the bilinear faces, negative for a hex turned inside out."""

import math

from hexmend.kernels import faces
from hexmend.quality.metric import Metric, kernel_metric

VOLUME = Metric(
    name="volume",
    title="Volume",
    formula="sum over the six faces of (a + b + c + d)·((c − a) × (d − b)) / 24",
    source="Verdict, SAND2007-1751 (24 tetrahedra)",
    full_range=(-math.inf, math.inf),
    acceptable=(0.0, math.inf),
    better=0,
    meaning="Below 0 the hex is inside out; a jump from one hex to the next reflects waves and costs accuracy.",
    of=kernel_metric(faces.volume, rows=1, row=0, worst=-math.inf),
    unit="mesh unit³",
).register()
