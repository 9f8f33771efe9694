"""A node's patch, ready to be asked for its energy at other places of the node."""

from __future__ import annotations

import numpy as np

from hexmend.energy import ObjectiveNorm
from hexmend.kernels import local
from hexmend.mesh.mesh import Mesh

#: Places at which a curve is drawn, and how far it reaches: so many times the step that was accepted, or a little more
#: than the first trial.
PLACES, FAR, MORE = 96, 6.0, 1.05


class Patch:
    """The energy of one free node.

    Parameters
    ----------
    mesh : Mesh
    points : (n, 3) float64
        Of all nodes.
    node : int
    power : ObjectiveNorm
    delta : float
    unit : float, optional
        The length that is taken for 1; without it, the mean edge length of the patch.

    Attributes
    ----------
    hexes : (k,) int32
    unit : float
        0 where the patch has no extent.
    energy : float
    gradient, hessian : (3,), (3, 3) float64
    """

    def __init__(
        self, mesh: Mesh, points: np.ndarray, node: int, power: ObjectiveNorm, delta: float, unit: float | None = None
    ):
        star = mesh.topology.node_corners[node]
        self.hexes = star // 8
        self.power, self.delta = power, float(delta)
        self._factor, self.energy, gradient, second = local.patch_energy(
            points, mesh.hexes, star, 1 / unit if unit else 0.0, self.delta, self.power
        )
        self._where = points, mesh.hexes, star, self._factor
        self.unit = 1 / self._factor if self._factor else 0.0
        self.gradient = np.array(gradient)
        xx, xy, xz, yy, yz, zz = second
        self.hessian = np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])

    def curve(self, direction: np.ndarray, reach: float) -> np.ndarray:
        """The energy along a direction, in `unit`, from alpha = 0 to `reach`: alpha, energy, (PLACES, 2)."""
        answer = np.empty((PLACES, 2))
        answer[:, 0] = np.linspace(0, reach, PLACES)
        local.energy_along(*self._where, direction, self.delta, self.power, answer)
        return answer

    def value(self, direction: np.ndarray, alpha: float) -> float:
        """The energy at alpha of a direction (3,), in `unit`."""
        answer = np.array([[alpha, 0.0]])
        local.energy_along(*self._where, direction, self.delta, self.power, answer)
        return float(answer[0, 1])


def reach_of(first: float, alpha: float) -> float:
    """How far the curve is drawn beside a line search that accepted `alpha`."""
    return MORE * (min(first, FAR * alpha) if alpha > 0 else first)
