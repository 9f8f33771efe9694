"""Laplacian smoothing: Algorithm 3.1."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from hexmend.boundary import SlidingBoundary
from hexmend.iteration import Step
from hexmend.kernels import laplacian as kernels
from hexmend.mesh.mesh import Mesh
from hexmend.mesh.topology import CSR
from hexmend.parameters import parameter
from hexmend.smoothers.base import Steps, method
from hexmend.smoothers.sliding_smoother import SlidingSmoother, Sweeps
from hexmend.smoothers.visit_order import ORDERS


@method
@dataclass(frozen=True)
class Laplacian(SlidingSmoother):
    """Move each node to the mean of its edge neighbours; a sliding node to that of those on its curve or patch."""

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
        help="In what order nodes are updated in place, 5.2.6: natural is by number, inward from the fixed ones.",
    )

    def steps(self, mesh: Mesh) -> Steps:
        sliding, ring = self.sliding(mesh), mesh.topology.rings
        surface = None
        if sliding is not None:
            mesh, ring, surface = sliding.mesh, sliding.rings, sliding.sliding_surface
        sequence, sweeps = ORDERS[self.order](mesh), Sweeps(sliding, mesh.n_nodes)
        points, sweep = mesh.points, 0
        yield Step(points)
        while True:
            nodes = sequence(points, sweep)
            if self.update == "simultaneous":
                points = self._at_once(points, ring, nodes, sliding)
            else:

                def one_by_one(moved: np.ndarray, stays: np.ndarray, nodes: np.ndarray = nodes) -> None:
                    nodes = nodes[~stays[nodes]]
                    kernels.in_place(moved, ring.start, ring.items, nodes, surface)

                points, _ = sweeps(points, one_by_one)
            yield Step(points)
            sweep += 1

    @staticmethod
    def _at_once(points: np.ndarray, ring: CSR, nodes: np.ndarray, sliding: SlidingBoundary | None) -> np.ndarray:
        moved = points.copy()
        kernels.simultaneous(points, ring.start, ring.items, nodes, moved)
        if sliding is None:
            return moved
        moved[sliding.nodes] = sliding.project(moved[sliding.nodes])
        return sliding.reject_moves(points, moved)
