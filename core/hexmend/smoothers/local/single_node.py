"""Base of the local methods that move one node at a time: Algorithm 3.2.

Base of the local optimisers: the energy of a patch, and the line search on it.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from hexmend.boundary import SlidingBoundary
from hexmend.energy import MeshEnergy
from hexmend.energy.quads import SurfaceQuads
from hexmend.energy.target import target_matrices
from hexmend.iteration import Step
from hexmend.kernels import local
from hexmend.kernels.target import TargetMatrices
from hexmend.mesh.mesh import Mesh
from hexmend.optimise.constrained_sweeps import ConstrainedSweeps, newton_steps, steepest_descents
from hexmend.parameters import parameter
from hexmend.quality import measure
from hexmend.smoothers.base import Steps, Sweep
from hexmend.smoothers.base_optimiser import Optimiser
from hexmend.smoothers.sliding_smoother import Sweeps
from hexmend.smoothers.visit_order import ORDERS, VisitOrder

#: Units of delta in mean edge lengths: a patch of eight hexes is two wide.
DELTA_UNITS = {"edge": 1.0, "extent": 2.0}


@dataclass(frozen=True)
class LocalOptimiser(Optimiser):
    """Steps with line search on the energy of one patch after another, each scaled to unit mean edge length."""

    #: Search direction of a node.
    direction: ClassVar[local.Direction] = local.Direction.NEWTON

    delta_unit: str = parameter(
        "edge",
        choices=tuple(DELTA_UNITS),
        help="Unit of length for delta: the patch's mean edge length, or its extent of two edges (Table 4.4).",
        advanced=True,
    )

    @property
    def repeats(self) -> int:
        """Number of steps at a node before the next."""
        return 1

    def constrained_sweep(self, mesh: Mesh, linear: np.ndarray) -> Sweep:
        energy = MeshEnergy(mesh, self.norm)
        sweeps = ConstrainedSweeps(energy, linear)
        find = steepest_descents if self.direction == local.Direction.STEEPEST_DESCENT else newton_steps

        def sweep(points: np.ndarray) -> np.ndarray:
            x = energy.to_edge_units(points)
            sweeps(x, self.delta_at(mesh, points), find, self.line_search, self.repeats)
            return np.where(linear[:, None], x * energy.unit, points)

        return sweep

    def delta_at(self, mesh: Mesh, points: np.ndarray) -> float:
        """delta of a sweep that begins with the nodes at points (n, 3): zero in the feasible region, 3.2.4."""
        return self.softening if measure(points, mesh.elements).n_inverted else 0.0

    @property
    def softening(self) -> float:
        """The parameter delta in mean edge lengths."""
        return self.delta * DELTA_UNITS[self.delta_unit] ** 3

    def surface_arguments(
        self, sliding: SlidingBoundary | None, quads: SurfaceQuads | None, points: np.ndarray, delta: float
    ) -> Callable[[np.ndarray], tuple]:
        """Make a function that returns the arguments of `local.sweep` about the surface, for a sweep from some points.

        Parameters
        ----------
        sliding : SlidingBoundary or None
        quads : SurfaceQuads or None
            If they count.
        points : (n, 3) float64
            At which their normals are held.
        delta : float
            Of the hexes.

        Returns
        -------
        callable
            Maps the points (n, 3) that are to be swept to the arguments.
        """
        if sliding is None:
            return lambda moved: ()
        term = None if quads is None else quads.at(points, delta, self.softening).of_kernels(quads.unit)
        return lambda moved: (sliding.sliding_surface, sliding.tangents(moved), term)


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
