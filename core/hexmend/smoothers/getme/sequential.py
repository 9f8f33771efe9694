"""Sequential GETMe, which follows simultaneous GETMe."""

from __future__ import annotations

from dataclasses import dataclass
from functools import partial

import numpy as np

from hexmend.boundary import SlidingBoundary
from hexmend.iteration import Outcome, Step
from hexmend.kernels import worst_first as kernels
from hexmend.mesh.mesh import Mesh
from hexmend.parameters import parameter
from hexmend.quality import ElementQuality, measure
from hexmend.smoothers.base import Steps, method
from hexmend.smoothers.getme.simultaneous import merit
from hexmend.smoothers.sliding_smoother import SlidingSmoother, Sweeps

#: Least rise of q_min in a sweep that counts.
RISE = 1e-4

#: Halvings of the relaxation before the method ends.
HALVINGS = 6


@method
@dataclass(frozen=True)
class SequentialGETMe(SlidingSmoother):
    """Transform the worst hex, again and again; a sweep makes as many steps as there are hexes."""

    name = "getme-sequential"
    title = "GETMe, sequential"
    help = "Raises q_min: step after step the worst hex is made more regular. Best after simultaneous GETMe."
    source = "Wilson 3.1.2; Vartziotis and Wipper 2011"
    bytes_per_hex = 400

    scaling: float = parameter(1.0, low=0.01, high=10, help="s: how far a corner goes along its triangle's normal.")
    relaxation: float = parameter(
        0.1, low=0.001, high=1, help="rho: share of a step that is taken; halved after a sweep without a rise of q_min."
    )
    penalty: float = parameter(
        0.001, low=0, high=1, unit="q(H)", help="By how much better a hex that moved counts for the rest of the sweep."
    )
    rejection_penalty: float = parameter(
        0.01, low=1e-6, high=1, unit="q(H)", help="By how much better a hex counts whose step was rejected."
    )

    def steps(self, mesh: Mesh) -> Steps:
        sliding = self.sliding(mesh)
        mesh = mesh if sliding is None else sliding.mesh
        sweeps = Sweeps(sliding, mesh.n_nodes)
        points, quality = mesh.points, measure(mesh.points, mesh.hexes)
        relaxation = self.relaxation
        yield Step(points)
        while relaxation >= self.relaxation / 2**HALVINGS:
            points, taken_back = sweeps(points, partial(self._sweep, mesh, sliding, quality, relaxation))
            before, quality = quality, measure(points, mesh.hexes)
            # Algorithm A.1 does not apply: a sweep may end where it began, and a finer one still raise q_min.
            yield Step(points, {"relaxation": relaxation, "taken_back": taken_back}, intermediate=True, quality=quality)
            if not np.any((merit(quality) - merit(before))[:2] > RISE):
                relaxation /= 2
        return Outcome.NO_IMPROVEMENT

    def _sweep(
        self,
        mesh: Mesh,
        sliding: SlidingBoundary | None,
        quality: ElementQuality,
        relaxation: float,
        moved: np.ndarray,
        stays: np.ndarray,
    ) -> int:
        """Move all points except those that must stay; returns the number of rejected steps."""
        free, surface = mesh.free & ~stays, None if sliding is None else sliding.sliding_surface
        candidates = np.flatnonzero(free[mesh.hexes].any(axis=1)).astype(np.int32)
        q, sound = quality.q.copy(), ~quality.inverted
        settings = kernels.WorstFirstSettings(self.scaling, relaxation, self.penalty, self.rejection_penalty)
        return kernels.sweep(moved, mesh.topology.hex_mesh, free, candidates, q, sound, settings, surface)
