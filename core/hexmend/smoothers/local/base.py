"""Base of the local optimisers: the energy of a patch, and the line search on it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from hexmend.boundary import SlidingBoundary
from hexmend.energy import POLICIES, DeltaPolicy, MeshEnergy
from hexmend.energy.quads import SurfaceQuads
from hexmend.energy.target import hex_sizes
from hexmend.kernels import local
from hexmend.mesh.mesh import Mesh
from hexmend.optimise.constrained_sweeps import ConstrainedSweeps, newton_steps, steepest_descents
from hexmend.parameters import parameter
from hexmend.quality import measure
from hexmend.smoothers.base import Sweep
from hexmend.smoothers.base_optimiser import Optimiser

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
        return self.policy.at(measure(points, mesh.elements), hex_sizes(mesh))

    @property
    def policy(self) -> DeltaPolicy:
        """Policy of delta, in mean edge lengths."""
        return POLICIES[self.delta_policy](self.delta * DELTA_UNITS[self.delta_unit] ** 3)

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
        term = None if quads is None else quads.at(points, delta, self.policy).of_kernels(quads.unit)
        return lambda moved: (sliding.sliding_surface, sliding.tangents(moved), term)
