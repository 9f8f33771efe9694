"""Laplacian smoothing: Algorithm 3.1."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from hexmend.iteration import Step
from hexmend.kernels import laplacian as kernels
from hexmend.mesh.mesh import Mesh
from hexmend.mesh.topology import CSR
from hexmend.parameters import parameter
from hexmend.smoothers.base import Steps, Sweep, method
from hexmend.smoothers.laplacian.constrained_means import ConstrainedMeans
from hexmend.smoothers.sliding_smoother import SlidingSmoother, Sweeps, moving
from hexmend.smoothers.visit_order import ORDERS


class FixedBoundarySweeps:
    """Sweeps in place, each from the result of the one before.

    Where the order of the nodes is repeated and most of them have the node before them as neighbour, as on structured
    meshes, sweeps by wavefronts give the same bits in half the time.

    Parameters
    ----------
    ring : CSR
        Edge neighbours of the nodes.
    """

    def __init__(self, ring: CSR):
        self._ring = ring
        self._nodes: np.ndarray | None = None
        self._sweeps: kernels.LaplacianSweeps | None = None
        self._repeated = False

    def __call__(self, points: np.ndarray, nodes: np.ndarray) -> np.ndarray:
        """Return the points (n, 3) after a sweep over nodes (k,) int32; an order that comes again is the same array."""
        start, items = self._ring.start, self._ring.items
        if nodes is not self._nodes:
            self._nodes, self._sweeps, self._repeated = nodes, None, False
        elif not self._repeated:
            self._repeated = True
            if kernels.most_wait(start, items, nodes):
                self._sweeps = kernels.LaplacianSweeps(points, start, items, nodes)
        if self._sweeps is not None:
            moved = np.empty_like(points)
            self._sweeps.next(moved)
        else:
            moved = points.copy()
            kernels.in_place(moved, start, items, nodes)
        return moved


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
        fixed_boundary = FixedBoundarySweeps(ring)
        points, number = mesh.points, 0

        def sweep(moved: np.ndarray, stays: np.ndarray) -> None:
            kernels.in_place(moved, ring.start, ring.items, moving(nodes, stays), surface)

        yield Step(points)
        while True:
            nodes = sequence(points, number)
            if self.update == "in-place":
                points = fixed_boundary(points, nodes) if sliding is None else sweeps(points, sweep)[0]
            else:
                moved = points.copy()
                kernels.simultaneous(points, ring.start, ring.items, nodes, moved)
                points = moved if sliding is None else sliding.reject_moves(points, sliding.projected(moved))
            yield Step(points)
            number += 1
