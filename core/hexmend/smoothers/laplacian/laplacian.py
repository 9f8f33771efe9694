"""Laplacian smoothing: Algorithm 3.1."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from hexmend.iteration import Step
from hexmend.kernels import laplacian as kernels
from hexmend.mesh.mesh import Mesh
from hexmend.parameters import parameter
from hexmend.smoothers.base import Steps, Sweep, method
from hexmend.smoothers.laplacian.constrained_means import ConstrainedMeans
from hexmend.smoothers.sliding_smoother import SlidingSmoother, Sweeps, moving
from hexmend.smoothers.visit_order import ORDERS


@method
@dataclass(frozen=True)
class Laplacian(SlidingSmoother):
    """Move each node to the mean of its edge neighbours; sliding nodes have neighbours on their curve or patch only."""

    name = "laplacian"
    title = "Laplacian"
    help = "Moves each node to the mean of its edge neighbours. Fast, but inverts hexes in concave regions."
    source = "Wilson 3.1.1, Algorithm 3.1"
    bytes_per_hex = 400

    update: str = parameter(
        "in-place",
        choices=("in-place", "simultaneous"),
        help="in-place: a node uses the new positions of earlier nodes (Algorithm 3.1); simultaneous: the old ones.",
    )
    order: str = parameter(
        "natural",
        choices=tuple(ORDERS),
        help="Order of updates in place (5.2.6): natural is by number, inward is by level from the fixed nodes.",
    )

    def constrained_sweep(self, mesh: Mesh, linear: np.ndarray) -> Sweep:
        return ConstrainedMeans(mesh, linear)

    def steps(self, mesh: Mesh) -> Steps:
        sliding, ring = self.sliding(mesh), mesh.topology.rings
        surface = None
        if sliding is not None:
            mesh, ring, surface = sliding.mesh, sliding.rings, sliding.sliding_surface
        sequence, sweeps = ORDERS[self.order](mesh), Sweeps(sliding, mesh.n_nodes)
        points, number = mesh.points, 0

        def sweep(moved: np.ndarray, stays: np.ndarray) -> None:
            kernels.in_place(moved, ring.start, ring.items, moving(nodes, stays), surface)

        yield Step(points)
        while True:
            nodes = sequence(points, number)
            if self.update == "in-place" and sliding is not None:
                points = sweeps(points, sweep)[0]
            elif self.update == "in-place":
                points = points.copy()
                kernels.in_place(points, ring.start, ring.items, nodes)
            else:
                moved = points.copy()
                kernels.simultaneous(points, ring.start, ring.items, nodes, moved)
                points = moved if sliding is None else sliding.reject_moves(points, sliding.projected(moved))
            yield Step(points)
            number += 1
