"""Shape: the worst of the eight corners' mean ratios, where q(H) is their mean."""

from hexmend.kernels import metrics
from hexmend.quality.metric import Metric, kernel_metric

SHAPE = Metric(
    name="shape",
    title="Shape",
    formula="least over the eight corners of 3 σ^(2/3) / |S|², 0 with a corner of σ ≤ 0",
    source="Verdict, SAND2007-1751",
    full_range=(0.0, 1.0),
    acceptable=(0.3, 1.0),
    better=1,
    meaning=(
        "Low values mean a corner that is flat, sheared or stretched: errors there grow, and the "
        "stiffness matrix is worse conditioned."
    ),
    of=kernel_metric(metrics.corners, rows=2, row=0, worst=0.0),
).register()
