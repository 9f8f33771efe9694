"""Local optimisation of several nodes at a time: Algorithm 3.2 between its two extremes, 5.2.5."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from hexmend.iteration import Step
from hexmend.kernels import local
from hexmend.kernels import patches as kernels
from hexmend.kernels import sliding as on_surface
from hexmend.mesh.mesh import Mesh
from hexmend.mesh.patches import partition_patches
from hexmend.parameters import parameter
from hexmend.smoothers.base import Steps, method
from hexmend.smoothers.local.base import LocalOptimiser
from hexmend.smoothers.sliding_smoother import Sweeps


@method
@dataclass(frozen=True)
class LocalPatch(LocalOptimiser):
    """One Newton step per patch of connected free nodes, with the rest of the mesh fixed, sweep after sweep.

    Nodes that slide are in no patch: after each sweep they step one by one.
    """

    name = "local-patch"
    title = "Local Newton, large patches"
    help = "Moves patches of connected nodes, each by a Newton step of its own. Few sweeps, each dear."
    source = "Wilson 5.2.5, Algorithms 3.2, A.3 and A.5"
    bytes_per_hex = 1700

    patch: int = parameter(
        8, low=1, high=1000, unit="nodes", help="Connected free nodes that a patch is made of: 1, 8, 27, 64, 216..."
    )
    overlap: int = parameter(
        1, low=0, high=1, unit="rings", help="Rings of neighbours that move with a patch, though they have their own."
    )

    def steps(self, mesh: Mesh) -> Steps:
        sliding, patches = self.sliding(mesh), partition_patches(mesh, self.patch, self.overlap)
        if sliding is not None:
            corners, alone = mesh.topology.node_corners, mesh.topology.colouring(~sliding.mesh.fixed & mesh.fixed)
            derived = int(np.diff(corners.start)[sliding.nodes].sum())
            mesh = sliding.mesh
        points, sweeps = mesh.points, Sweeps(sliding, mesh.n_nodes)

        def slide(moved: np.ndarray, stays: np.ndarray) -> int:
            groups = alone.without(stays)
            return on_surface.local(
                moved, mesh.hexes, corners.start, corners.items, groups.start, groups.items, local.NEWTON,
                delta, self.power, self.first_step, self.shrink, self.c1, self.max_cuts,
                sliding.tangents(moved), *sliding.ground,
            )  # fmt: skip

        yield Step(points)
        while True:
            delta = self.delta_at(mesh, points)
            points = points.copy()
            energies, derivatives = kernels.sweep(
                points,
                patches.hexes,
                patches.slots,
                patches.chosen.start,
                patches.nodes.start,
                patches.nodes.items,
                patches.colours.start,
                patches.colours.items,
                delta,
                self.power,
                self.first_step,
                self.shrink,
                self.c1,
                self.max_cuts,
            )
            if sliding is not None:
                points, more = sweeps(points, slide)
                energies, derivatives = energies + more, derivatives + derived
            yield Step(points, {"delta": delta, "energies": energies, "derivatives": derivatives})
