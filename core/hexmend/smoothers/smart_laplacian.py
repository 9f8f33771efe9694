"""Smart Laplacian smoothing: Algorithm 3.1 with the moves that harm taken back (3.1.1)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from hexmend.kernels import laplacian as kernels
from hexmend.mesh import Mesh
from hexmend.optimise import Step
from hexmend.parameters import parameter
from hexmend.smoothers.smoother import Smoother, Steps, method


@method
@dataclass(frozen=True)
class SmartLaplacian(Smoother):
    """Each node goes to the mean of its edge neighbours unless that harms an attached hex."""

    name = "smart-laplacian"
    title = "Smart Laplacian"
    help = "Laplacian smoothing that takes back every move which inverts an attached hex. Never adds an inverted hex."
    source = "Wilson 3.1.1"

    guard: str = parameter(
        "inversion",
        choices=("inversion", "quality"),
        help="What counts as harm: inverting an attached hex, or lowering the least q(H) of the attached hexes too.",
    )

    def steps(self, mesh: Mesh) -> Steps:
        corners, ring = mesh.topology.node_corners, mesh.topology.rings
        nodes = np.flatnonzero(mesh.free).astype(np.int32)
        points = mesh.points
        yield Step(points)
        while True:
            points = points.copy()
            taken_back = kernels.guarded(
                points,
                mesh.hexes,
                corners.start,
                corners.items,
                ring.start,
                ring.items,
                nodes,
                self.guard == "quality",
            )
            yield Step(points, {"taken_back": taken_back})
