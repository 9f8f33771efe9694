"""Fits of boundaries that move to the surfaces that they had."""

from __future__ import annotations

import numpy as np

from hexmend.boundary import SlidingBoundary
from hexmend.boundary.classification import NodeClass
from hexmend.energy import MeshEnergy, ObjectiveNorm
from hexmend.energy.barriers.surface_fit import FitTolerances, SurfaceFit
from hexmend.mesh.mesh import Mesh

TOLERANCE = 0.2


def fit_of(mesh: Mesh) -> tuple[SurfaceFit, MeshEnergy, np.ndarray]:
    """Make a fit with all boundary nodes free, the energy of the mesh with all nodes free, and positions."""
    sliding, none = SlidingBoundary(mesh), np.zeros(mesh.n_nodes, dtype=bool)
    energy = MeshEnergy(mesh.with_fixed(none), ObjectiveNorm(1.0))
    free = sliding.surface.node_class != NodeClass.INSIDE
    fit = SurfaceFit(sliding, free, none, FitTolerances(TOLERANCE, TOLERANCE, TOLERANCE, is_limit=True), energy.unit)
    return fit, energy, energy.to_edge_units(mesh.points)


def on_top(x: np.ndarray) -> np.ndarray:
    """Mark the nodes of the flat face where z is greatest, (n,) bool."""
    return x[:, 2] > x[:, 2].max() - 1e-9


def moved(x: np.ndarray, marks: int | np.ndarray, shift: list[float] | np.ndarray) -> np.ndarray:
    """Return positions with some nodes displaced."""
    there = x.copy()
    there[marks] += shift
    return there
