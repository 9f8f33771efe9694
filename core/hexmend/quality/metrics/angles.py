"""Smallest and largest angle of the faces; 0 and 180 degrees where an edge has no length."""

from hexmend.kernels import faces
from hexmend.quality.metric import Metric, kernel_metric

MIN_ANGLE = Metric(
    name="min-angle",
    title="Smallest angle",
    formula="least angle of two adjacent edges over the 24 corners of the faces, 0 with an edge of no length",
    source="Verdict, SAND2007-1751, of a quadrilateral",
    full_range=(0.0, 90.0),
    acceptable=(45.0, 90.0),
    better=1,
    meaning="Small angles mean sheared faces: the stiffness matrix is worse conditioned.",
    of=kernel_metric(faces.angles, rows=2, row=0, worst=0.0),
    unit="degrees",
).register()

MAX_ANGLE = Metric(
    name="max-angle",
    title="Largest angle",
    formula="greatest angle of two adjacent edges over the 24 corners of the faces, 180 with an edge of no length",
    source="Verdict, SAND2007-1751, of a quadrilateral",
    full_range=(0.0, 180.0),
    acceptable=(90.0, 135.0),
    better=-1,
    meaning="Angles near 180 degrees make gradients inaccurate: the hex is nearly flat at a corner.",
    of=kernel_metric(faces.angles, rows=2, row=1, worst=180.0),
    unit="degrees",
).register()
