"""Laplacian smoothing: Algorithm 3.1."""

from __future__ import annotations

from dataclasses import dataclass

from hexmend.kernels import laplacian as kernels
from hexmend.kernels import sliding as on_surface
from hexmend.mesh import Mesh
from hexmend.optimise import Step
from hexmend.parameters import parameter
from hexmend.smoothers.order import ORDERS
from hexmend.smoothers.sliding_smoother import SlidingSmoother
from hexmend.smoothers.smoother import Steps, method


@method
@dataclass(frozen=True)
class Laplacian(SlidingSmoother):
    """Each node goes to the mean of its edge neighbours; one that slides, of those on its own curve or patch."""

    name = "laplacian"
    title = "Laplacian"
    help = "Moves each node to the mean of its edge neighbours. Fast, but inverts hexes in concave regions."
    source = "Wilson 3.1.1, Algorithm 3.1"

    update: str = parameter(
        "in-place",
        choices=("in-place", "simultaneous"),
        help="Whether a node sees where the nodes before it went (Algorithm 3.1), or all move at once.",
    )
    order: str = parameter(
        "natural",
        choices=tuple(ORDERS),
        help="In what order nodes are updated in place, 5.2.6: natural is by number, inward from the fixed ones.",
    )

    def steps(self, mesh: Mesh) -> Steps:
        sliding, ring = self.sliding(mesh), mesh.topology.rings
        if sliding is not None:
            mesh, ring = sliding.mesh, sliding.rings
        sequence = ORDERS[self.order](mesh)
        points, sweep = mesh.points, 0
        yield Step(points)
        while True:
            nodes = sequence(points, sweep)
            moved = points.copy()
            if self.update == "simultaneous":
                kernels.simultaneous(points, ring.start, ring.items, nodes, moved)
                if sliding is not None:
                    moved[sliding.nodes] = sliding.put_back(moved[sliding.nodes])
            elif sliding is None:
                kernels.in_place(moved, ring.start, ring.items, nodes)
            else:
                on_surface.laplacian(moved, ring.start, ring.items, nodes, *sliding.ground)
            points = moved
            yield Step(points)
            sweep += 1
