"""q(H): mean quality of the eight corner tetrahedra; the measure that the thesis smooths by."""

from hexmend.quality.metric import Metric

Q = Metric(
    name="q",
    title="q(H)",
    formula="mean over the eight corners of 3 σ^(2/3) / |S|², 0 at a corner with σ ≤ 0",
    source="Wilson (2.8)–(2.10); Knupp 2000; Vartziotis and Wipper 2011",
    full_range=(0.0, 1.0),
    acceptable=(0.3, 1.0),
    better=1,
    meaning="Low values slow iterative solvers down and cost accuracy: the hex is far from a cube.",
    of=lambda points, hexes, quality: quality.q,
).register()
