"""The energy of a node's patch at other positions of the node."""

from __future__ import annotations

from typing import Any

import numpy as np

from hexmend.energy import ObjectiveNorm
from hexmend.energy.target import target_matrices
from hexmend.kernels import local
from hexmend.mesh.mesh import Mesh

#: Samples of the energy along a direction.
SAMPLES = 96

#: Largest length of a curve, in accepted step lengths.
MAX_LENGTH = 6.0

#: Factor by which a curve is longer than what it shows.
MARGIN = 1.05


class Patch:
    """The energy of one free node as a function of its position.

    Parameters
    ----------
    mesh : Mesh
    points : (n, 3) float64
        Positions of all nodes.
    node : int
    norm : ObjectiveNorm
    delta : float
    unit : float, optional
        Unit of length; by default the mean edge length of the patch, or that of its hexes' targets.

    Attributes
    ----------
    before : (3,) float64
        Position of the node.
    hexes : (k,) int32
    unit : float
        0 for a patch without extent.
    energy : float
    gradient, hessian : (3,), (3, 3) float64
    """

    def __init__(
        self, mesh: Mesh, points: np.ndarray, node: int, norm: ObjectiveNorm, delta: float, unit: float | None = None
    ):
        star = mesh.topology.node_corners[node]
        self.hexes = star // 8
        self.node, self.before, self.norm, self.delta = node, points[node].copy(), norm, float(delta)
        self._target, factor = target_matrices(mesh), 1 / unit if unit else 0.0
        at = local.patch_energy(points, mesh.elements, star, factor, self.delta, self.norm, self._target)
        self._patch = points, mesh.elements, star, at.factor
        self.unit = 1 / at.factor if at.factor else 0.0
        self.energy, self.gradient = at.value, np.array(at.gradient)
        xx, xy, xz, yy, yz, zz = at.hessian
        self.hessian = np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])

    def fields(self) -> dict[str, Any]:
        """Return the fields of `NodeStep` that describe the node, its patch and the energy."""
        names = ("node", "before", "hexes", "unit", "norm", "delta", "energy", "gradient", "hessian")
        return {name: getattr(self, name) for name in names}

    def curve(self, direction: np.ndarray, length: float) -> np.ndarray:
        """Return alpha and energy, (SAMPLES, 2), along a direction (3,) in `unit`, from alpha = 0 to `length`."""
        return self._energies(direction, np.linspace(0, length, SAMPLES))

    def value(self, direction: np.ndarray, alpha: float) -> float:
        """Return the energy at a step length alpha along a direction (3,) in `unit`."""
        return float(self._energies(direction, alpha)[0, 1])

    def _energies(self, direction: np.ndarray, alpha: np.ndarray | float) -> np.ndarray:
        rows = np.zeros((np.size(alpha), 2))
        rows[:, 0] = alpha
        local.energy_along(*self._patch, direction.tolist(), self.delta, self.norm, rows, self._target)
        return rows


def curve_length(first: float, alpha: float) -> float:
    """Return the length, as alpha, of the curve to be drawn for a line search that accepted `alpha`."""
    return MARGIN * (min(first, MAX_LENGTH * alpha) if alpha > 0 else first)
