"""The general method: Algorithm 5.1."""

from __future__ import annotations

import dataclasses
from collections.abc import Generator
from dataclasses import dataclass
from typing import Any

import numpy as np

from hexmend.arrays import largest_norm
from hexmend.iteration import Outcome, Step
from hexmend.mesh.mesh import Mesh
from hexmend.mesh.solid_cells import rows_by_kind
from hexmend.parameters import parameter
from hexmend.quality import measure, measure_against_target
from hexmend.smoothers.base import METHODS, Steps, method
from hexmend.smoothers.base_optimiser import TargetedSmoother
from hexmend.smoothers.constrained_steps import constrained_steps
from hexmend.smoothers.sliding_smoother import SlidingSmoother
from hexmend.terminal_text import count_phrase


@method
@dataclass(frozen=True)
class General(TargetedSmoother):
    """GETMe first; then, unless its result is good enough, the optimiser that suits the mesh."""

    name = "general"
    title = "General (GETMe, then an optimiser)"
    help = "GETMe; then global Newton if hexes have similar size and none is inverted, else local steepest descent."
    source = "Wilson 5.1, Algorithm 5.1"
    optimises = True
    keeps_linear_motion = True
    bytes_per_hex = 2700  # of the global Newton's method that it may go on with

    q_target: float = parameter(
        0.9, low=0, high=1, help="Least q(H) at which GETMe's result is accepted; with 1 an optimiser always follows."
    )
    max_size_ratio: float = parameter(
        3.0,
        low=1,
        high=1e6,
        help="Hexes are of similar size up to this ratio of the 95th to the 5th percentile of their mean edge lengths.",
    )
    getme_tolerance: float = parameter(
        1e-4,
        low=0,
        high=1,
        unit="mean edge length",
        help="GETMe has converged when no node moves further (A.1).",
        advanced=True,
    )
    getme_iterations: int = parameter(500, low=0, high=100_000, help="Iteration limit of GETMe.", advanced=True)

    def steps(self, mesh: Mesh) -> Steps:
        mesh = mesh.keeping_surface()
        points = yield from self._getme(mesh)
        quality = measure_against_target(mesh, points, measure(points, mesh.elements))
        if not quality.n_inverted and quality.q.min() >= self.q_target:
            return Outcome.SUFFICIENT
        ratio = edge_length_ratio(points, mesh.elements)
        similar, count = ratio <= self.max_size_ratio, quality.n_inverted
        inverted = count_phrase(count, "inverted hex", "inverted hexes") if count else "no inverted hexes"
        chosen = METHODS["global-nr" if similar and not count else "local-sd"]
        sizes = f"{'similar' if similar else 'different'} sizes (ratio {ratio:.2g})"
        decision = f"After GETMe: {sizes}, {inverted}: {chosen.title}."
        rest = constrained_steps(chosen(**self._sliding_values()), mesh.with_points(points))
        next(rest)
        try:
            step = next(rest)
        except StopIteration as end:
            return end.value
        yield dataclasses.replace(step, decision=decision)
        return (yield from rest)

    def _sliding_values(self) -> dict[str, Any]:
        return {one.name: getattr(self, one.name) for one in dataclasses.fields(SlidingSmoother)}

    def _getme(self, mesh: Mesh) -> Generator[Step, None, np.ndarray]:
        """Run GETMe to its end; returns the points."""
        points, unit = mesh.points, mesh.mean_edge_length or 1.0
        getme = constrained_steps(METHODS["getme"](**self._sliding_values()), mesh)
        yield dataclasses.replace(next(getme), intermediate=True)
        for _, step in zip(range(self.getme_iterations), getme, strict=False):
            move = largest_norm(step.points - points) / unit
            points = step.points
            yield dataclasses.replace(step, intermediate=True)
            if move < self.getme_tolerance:
                break
        return points


def edge_length_ratio(points: np.ndarray, hexes: np.ndarray) -> float:
    """Ratio of the 95th to the 5th percentile of the hexes' mean edge lengths; inf if some have no extent."""
    total = np.zeros(len(hexes))
    for kind, rows in rows_by_kind(hexes):
        for a, b in kind.edges:
            total[rows] += np.linalg.norm(points[hexes[rows, a]] - points[hexes[rows, b]], axis=1)
        total[rows] /= len(kind.edges)
    low, high = np.percentile(total, [5, 95])
    return float(high / low) if low > 0 else np.inf
