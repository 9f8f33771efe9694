"""Smart Laplacian smoothing: Algorithm 3.1 in which harmful moves are rejected (3.1.1)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from hexmend.iteration import Step
from hexmend.kernels import laplacian as kernels
from hexmend.mesh.mesh import Mesh
from hexmend.parameters import parameter
from hexmend.smoothers.base import Steps, Sweep, method
from hexmend.smoothers.laplacian.laplacian import ConstrainedMeans
from hexmend.smoothers.sliding_smoother import SlidingSmoother, Sweeps, moving


@method
@dataclass(frozen=True)
class SmartLaplacian(SlidingSmoother):
    """Each node goes to the mean of its edge neighbours unless that harms an attached hex."""

    name = "smart-laplacian"
    title = "Smart Laplacian"
    help = "Laplacian smoothing that rejects every move that inverts an attached hex. Never adds an inverted hex."
    source = "Wilson 3.1.1"
    bytes_per_hex = 400

    guard: str = parameter(
        "inversion",
        choices=("inversion", "quality"),
        help="Moves that are rejected: those that invert an attached hex, or also those that lower its least q(H).",
    )

    def constrained_sweep(self, mesh: Mesh, linear: np.ndarray) -> Sweep:
        return ConstrainedMeans(mesh, linear, self.guard)

    def steps(self, mesh: Mesh) -> Steps:
        sliding, ring = self.sliding(mesh), mesh.topology.rings
        surface = None
        if sliding is not None:
            mesh, ring, surface = sliding.mesh, sliding.rings, sliding.sliding_surface
        hex_mesh = mesh.topology.hex_mesh
        nodes = np.flatnonzero(mesh.free).astype(np.int32)
        points, sweeps = mesh.points, Sweeps(sliding, mesh.n_nodes)

        def sweep(moved: np.ndarray, stays: np.ndarray) -> int:
            may_move, keep = moving(nodes, stays), self.guard == "quality"
            return kernels.smart_sweep(moved, hex_mesh, ring.start, ring.items, may_move, keep, surface)

        yield Step(points)
        while True:
            points, rejected = sweeps(points, sweep)
            yield Step(points, {"rejected_steps": rejected})
