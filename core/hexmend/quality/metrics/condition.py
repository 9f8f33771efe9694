"""Condition number of the worst corner, scaled to 1 for a cube; +inf for an inverted hex."""

import math

from hexmend.kernels import metrics
from hexmend.quality.metric import Metric, kernel_metric

CONDITION = Metric(
    name="condition",
    title="Condition number",
    formula="greatest over the eight corners of |S||S⁻¹| / 3, ∞ with a corner of σ ≤ 0",
    source="Verdict, SAND2007-1751 (maximum aspect Frobenius); Knupp 2000",
    full_range=(1.0, math.inf),
    acceptable=(1.0, 3.0),
    better=-1,
    meaning="High values worsen the condition of the stiffness matrix: iterative solvers take longer and lose digits.",
    of=kernel_metric(metrics.corners, rows=2, row=1, worst=math.inf),
).register()
