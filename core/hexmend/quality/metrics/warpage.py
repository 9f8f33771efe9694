"""Warpage of the worst face, 0 for flat faces; 2 where a corner of a face has no normal."""

from hexmend.kernels import faces
from hexmend.quality.metric import Metric, kernel_metric

WARPAGE = Metric(
    name="warpage",
    title="Warpage",
    formula="greatest over the six faces of 1 − min((n₀·n₂)³, (n₁·n₃)³), nᵢ normals at the corners, 2 without one",
    source="Verdict, SAND2007-1751, of a quadrilateral",
    full_range=(0.0, 2.0),
    acceptable=(0.0, 0.7),
    better=-1,
    meaning=(
        "High values mean faces that are not flat: contact, surface loads and finite volumes use a "
        "face that differs from that of the hex."
    ),
    of=kernel_metric(faces.warpage, rows=1, row=0, worst=2.0),
).register()
