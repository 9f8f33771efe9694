"""Scaled Jacobian: the least corner volume of unit edges; the figure that other tools print."""

from hexmend.quality.metric import Metric

SCALED_JACOBIAN = Metric(
    name="scaled-jacobian",
    title="Scaled Jacobian",
    formula="least over the eight corners of σ / (|e₁||e₂||e₃|)",
    source="Knupp 2000; Verdict Library Reference Manual",
    full_range=(-1.0, 1.0),
    acceptable=(0.2, 1.0),
    better=1,
    meaning="At 0 and below the hex is inverted at a corner: most solvers refuse it.",
    of=lambda points, hexes, quality: quality.scaled_jacobian,
).register()
