"""Laplacian smoothing: Algorithm 3.1."""

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
class Laplacian(Smoother):
    """Each node goes to the mean of its edge neighbours."""

    name = "laplacian"
    title = "Laplacian"
    help = "Moves each node to the mean of its edge neighbours. Fast, but inverts hexes in concave regions."
    source = "Wilson 3.1.1, Algorithm 3.1"

    update: str = parameter(
        "in-place",
        choices=("in-place", "simultaneous"),
        help="Whether a node sees where the nodes before it went (Algorithm 3.1), or all move at once.",
    )

    def steps(self, mesh: Mesh) -> Steps:
        ring = mesh.topology.rings
        nodes = np.flatnonzero(mesh.free).astype(np.int32)
        points = mesh.points
        yield Step(points)
        while True:
            moved = points.copy()
            if self.update == "in-place":
                kernels.in_place(moved, ring.start, ring.items, nodes)
            else:
                kernels.simultaneous(points, ring.start, ring.items, nodes, moved)
            points = moved
            yield Step(points)
