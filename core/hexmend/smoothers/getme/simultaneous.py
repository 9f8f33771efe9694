"""Simultaneous GETMe."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from hexmend.boundary import SlidingBoundary
from hexmend.iteration import Outcome, Step
from hexmend.kernels import getme as kernels
from hexmend.kernels.element_step import element_steps
from hexmend.mesh.mesh import Mesh
from hexmend.parameters import parameter
from hexmend.quality import ElementQuality, measure
from hexmend.smoothers.base import Steps, figures_of_merit, method
from hexmend.smoothers.sliding_smoother import SlidingSmoother

#: Least rise of q_min or q_mean that counts.
RISE = 1e-6


@method
@dataclass(frozen=True)
class GETMe(SlidingSmoother):
    """Transform every hex on its own towards a regular one; each node moves to the weighted mean of its targets."""

    name = "getme"
    title = "GETMe, simultaneous"
    help = "Each hex makes a step towards a cube; nodes move to the mean of their new positions. Fast; often untangles."
    source = "Wilson 3.1.2; Vartziotis and Wipper 2011"
    bytes_per_hex = 600

    scaling: float = parameter(1.0, low=0.01, high=10, help="s: factor of a corner's step along its triangle's normal.")
    relaxation: float = parameter(0.75, low=0.01, high=1, help="rho: fraction of a hex's step.")
    weights: str = parameter(
        "quality",
        choices=("quality", "paper", "equal"),
        help="A hex's weight in the means of its nodes: 1/sqrt(q), (1 - q)^(exponent/2) as in the paper, or 1.",
    )
    exponent: float = parameter(1.0, low=0, high=10, help="Exponent of the paper's weights.")
    patience: int = parameter(
        10,
        low=1,
        high=1000,
        help="Number of iterations without a rise of q_min or q_mean after which the method ends.",
        advanced=True,
    )

    def steps(self, mesh: Mesh) -> Steps:
        sliding = self.sliding(mesh)
        mesh = mesh if sliding is None else sliding.mesh
        hex_mesh = mesh.topology.hex_mesh
        nodes = np.flatnonzero(mesh.free).astype(np.int32)
        places = np.empty((mesh.n_elements, 8, 3))
        points, quality = mesh.points, measure(mesh.points, mesh.elements)
        best = figures_of_merit(quality)
        idle = 0
        yield Step(points)
        while idle < self.patience:
            element_steps(points, mesh.elements, self.scaling, self.relaxation, places)
            moved = points.copy()
            kernels.weighted_means(places, self.hex_weights(quality.q), hex_mesh, nodes, moved)
            moved = moved if sliding is None else sliding.projected(moved)
            points, quality, relaxed = _relax_harmful_moves(mesh, points, quality, moved, sliding)
            now = figures_of_merit(quality)
            idle = 0 if np.any(now > best + RISE) else idle + 1
            best = np.maximum(best, now)
            yield Step(points, {"relaxed_nodes": relaxed}, quality=quality)
        return Outcome.NO_IMPROVEMENT

    def hex_weights(self, q: np.ndarray) -> np.ndarray:
        """Weights of hexes by their q(H), (m,) float64: the worse, the heavier; finite and positive."""
        if self.weights == "quality":
            return 1 / np.sqrt(np.maximum(q, 0.01))
        if self.weights == "paper":
            return np.maximum(1 - q, 1e-12) ** (self.exponent / 2)
        return np.ones(len(q))


def _relax_harmful_moves(
    mesh: Mesh, points: np.ndarray, quality: ElementQuality, moved: np.ndarray, sliding: SlidingBoundary | None
) -> tuple[np.ndarray, ElementQuality, int]:
    """Relax moves that would invert a valid hex; returns the points, their quality and the number of relaxed nodes."""
    after = measure(moved, mesh.elements)
    harmed = np.flatnonzero(after.inverted & ~quality.inverted).astype(np.int32)
    if not harmed.size and (sliding is None or not sliding.rejected_nodes(points, moved).size):
        return moved, after, 0
    relaxed = kernels.relax(points, mesh.topology.hex_mesh, ~quality.inverted, harmed, moved)
    if sliding is None:
        return moved, measure(moved, mesh.elements), relaxed

    def newly_inverted(x: np.ndarray) -> np.ndarray:
        return mesh.elements[measure(x, mesh.elements).inverted & ~quality.inverted]

    # Projection of a relaxed step may invert a hex again: such a step is rejected.
    moved = sliding.reject_moves(points, sliding.projected(moved), newly_inverted)
    return moved, measure(moved, mesh.elements), relaxed


#: Least rise of q_min in a sweep that counts.
SWEEP_RISE = 1e-4
