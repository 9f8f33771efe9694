"""Base of the local methods that move one node at a time: Algorithm 3.2."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from hexmend.energy.target import target_matrices
from hexmend.iteration import Step
from hexmend.kernels import local
from hexmend.kernels.target import TargetMatrices
from hexmend.mesh.mesh import Mesh
from hexmend.parameters import parameter
from hexmend.smoothers.base import Steps
from hexmend.smoothers.local.base import LocalOptimiser
from hexmend.smoothers.sliding_smoother import Sweeps
from hexmend.smoothers.visit_order import ORDERS, VisitOrder


@dataclass(frozen=True)
class LocalDescent(LocalOptimiser):
    """Steps with line search at each free node in turn, on the node's patch scaled to unit mean edge length."""

    bytes_per_hex = 400

    order: str = parameter(
        "colour",
        choices=tuple(ORDERS),
        help="Order of the nodes in a sweep (5.2.6): inward is level by level from the fixed nodes.",
    )
    steps_per_node: int = parameter(
        1,
        low=1,
        high=100,
        help="Steps at a node before the next: more than one did not pay in the thesis (3.2.2). Sliding nodes keep "
        "their tangents meanwhile.",
        advanced=True,
    )

    def steps(self, mesh: Mesh) -> Steps:
        sliding = self.sliding(mesh)
        mesh = mesh if sliding is None else sliding.mesh
        corners, visits = mesh.topology.node_corners, VisitOrder(mesh, self.order, self.steps_per_node)
        # Each visit asks the hexes at its node.
        derivatives = self.steps_per_node * int(np.diff(corners.start)[mesh.free].sum())
        points, number, sweeps = mesh.points, 0, Sweeps(sliding, mesh.n_nodes)
        target, quads = target_matrices(mesh), self.surface_quads(sliding)

        def sweep(moved: np.ndarray, stays: np.ndarray) -> int:
            visited, settings = groups.without(stays), self.step_settings(delta, target)
            return local.sweep(moved, mesh.topology.hex_mesh, visited.start, visited.items, settings, *surface(moved))

        visits.groups(points, number)
        yield Step(points, surface=quads and quads.objective(points))
        while True:
            delta, groups = self.delta_at(mesh, points), visits.groups(points, number)
            surface = self.surface_arguments(sliding, quads, points, delta)
            points, energies = sweeps(points, sweep)
            counts = {"energy_evaluations": energies, "derivative_evaluations": derivatives}
            yield Step(points, {"delta": delta, **counts}, surface=quads and quads.objective(points))
            number += 1

    @property
    def repeats(self) -> int:
        return self.steps_per_node

    def step_settings(self, delta: float, target: TargetMatrices | None = None) -> local.NodeStepSettings:
        """Settings of a node's step in a sweep with that delta and the target of the mesh."""
        return local.NodeStepSettings(self.direction, delta, self.norm, self.line_search, target)
