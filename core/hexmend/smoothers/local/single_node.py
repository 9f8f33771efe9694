"""Base of the local methods that move one node at a time: Algorithm 3.2."""

from __future__ import annotations

from dataclasses import dataclass
from functools import partial
from typing import ClassVar

import numpy as np

from hexmend.boundary import SlidingBoundary
from hexmend.iteration import Step
from hexmend.kernels import local
from hexmend.mesh.mesh import Mesh
from hexmend.mesh.topology import CSR
from hexmend.parameters import parameter
from hexmend.smoothers.base import Steps
from hexmend.smoothers.local.base import LocalOptimiser
from hexmend.smoothers.sliding_smoother import Sweeps
from hexmend.smoothers.visit_order import ORDERS, VisitOrder


@dataclass(frozen=True)
class LocalDescent(LocalOptimiser):
    """One step with line search per free node and sweep, on the node's patch scaled to unit mean edge length."""

    #: Search direction, one of `hexmend.kernels.local`.
    direction: ClassVar[int]
    bytes_per_hex = 400

    order: str = parameter(
        "colour",
        choices=tuple(ORDERS),
        help="In what order a sweep visits the nodes, 5.2.6: inward is level by level from the fixed ones.",
    )

    def steps(self, mesh: Mesh) -> Steps:
        sliding = self.sliding(mesh)
        mesh = mesh if sliding is None else sliding.mesh
        corners, visits = mesh.topology.node_corners, VisitOrder(mesh, self.order)
        derivatives = int(np.diff(corners.start)[mesh.free].sum())  # each visit asks the hexes at its node
        points, sweep, sweeps = mesh.points, 0, Sweeps(sliding, mesh.n_nodes)
        visits.groups(points, sweep)
        yield Step(points)
        while True:
            delta, groups = self.delta_at(mesh, points), visits.groups(points, sweep)
            points, energies = sweeps(points, partial(self._sweep, mesh, sliding, groups, delta))
            yield Step(points, {"delta": delta, "energies": energies, "derivatives": derivatives})
            sweep += 1

    def _sweep(
        self,
        mesh: Mesh,
        sliding: SlidingBoundary | None,
        groups: CSR,
        delta: float,
        points: np.ndarray,
        stays: np.ndarray,
    ) -> int:
        """Move all points except those that must stay; returns the number of evaluations of a hex's energy."""
        visited, settings = groups.without(stays), self.step_settings(delta)
        surface = () if sliding is None else (sliding.sliding_surface, sliding.tangents(points))
        return local.sweep(points, mesh.topology.hex_mesh, visited.start, visited.items, settings, *surface)

    def step_settings(self, delta: float) -> local.NodeStepSettings:
        """Settings of a node's step in a sweep with that delta."""
        return local.NodeStepSettings(self.direction, delta, self.power, self.line_search)
