"""q of target: q(H) of the hex as its target maps it to a cube; q(H) itself in a mesh without a target."""

from hexmend.quality.mesh_quality import measure_against_target
from hexmend.quality.metric import Metric

Q_OF_TARGET = Metric(
    name="q-of-target",
    title="q of target",
    formula="q(H) with S W⁻¹ in place of S, W being the three lengths of the target; q(H) without a target",
    source="Knupp 2012, target-matrix paradigm; Wilson (2.8)–(2.10)",
    full_range=(0.0, 1.0),
    acceptable=(0.3, 1.0),
    better=1,
    meaning="Low values mean angles or proportions far from those that the target asks for.",
    of=lambda points, hexes, quality: quality.q,
    of_mesh=lambda mesh, quality: measure_against_target(mesh, mesh.points, quality).q,
).register()
