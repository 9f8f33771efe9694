"""Sequential GETMe, which follows simultaneous GETMe."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from hexmend.iteration import Outcome, Step
from hexmend.kernels import worst_first
from hexmend.mesh.mesh import Mesh
from hexmend.parameters import parameter
from hexmend.quality import measure
from hexmend.smoothers.base import Steps, figures_of_merit, method
from hexmend.smoothers.getme.simultaneous import SWEEP_RISE
from hexmend.smoothers.sliding_smoother import SlidingSmoother, Sweeps

#: Halvings of the relaxation before the method ends.
HALVINGS = 6


@method
@dataclass(frozen=True)
class SequentialGETMe(SlidingSmoother):
    """Transform the worst hex, again and again; a sweep makes as many steps as there are hexes."""

    name = "getme-sequential"
    title = "GETMe, sequential"
    help = "Raises q_min: each step makes the worst hex more regular. Best after simultaneous GETMe."
    source = "Wilson 3.1.2; Vartziotis and Wipper 2011"
    bytes_per_hex = 400

    scaling: float = parameter(1.0, low=0.01, high=10, help="s: factor of a corner's step along its triangle's normal.")
    relaxation: float = parameter(
        0.1, low=0.001, high=1, help="rho: fraction of a step; halved after a sweep that does not raise q_min."
    )
    penalty: float = parameter(
        0.001, low=0, high=1, unit="q(H)", help="Amount by which a moved hex counts as better in the rest of a sweep."
    )
    rejection_penalty: float = parameter(
        0.01, low=1e-6, high=1, unit="q(H)", help="Amount by which a hex with a rejected step counts as better."
    )

    def steps(self, mesh: Mesh) -> Steps:
        sliding = self.sliding(mesh)
        mesh = mesh if sliding is None else sliding.mesh
        sweeps = Sweeps(sliding, mesh.n_nodes)
        points, quality = mesh.points, measure(mesh.points, mesh.elements)
        relaxation, surface = self.relaxation, None if sliding is None else sliding.sliding_surface

        def sweep(moved: np.ndarray, stays: np.ndarray) -> int:
            free, q = mesh.free & ~stays, quality.q.copy()
            candidates = np.flatnonzero(free[mesh.elements].any(axis=1)).astype(np.int32)
            settings = worst_first.WorstFirstSettings(self.scaling, relaxation, self.penalty, self.rejection_penalty)
            hex_mesh, valid = mesh.topology.hex_mesh, ~quality.inverted
            return worst_first.sweep(moved, hex_mesh, free, candidates, q, valid, settings, surface)

        yield Step(points)
        while relaxation >= self.relaxation / 2**HALVINGS:
            points, rejected = sweeps(points, sweep)
            before, quality = quality, measure(points, mesh.elements)
            diagnostics = {"relaxation": relaxation, "rejected_steps": rejected}
            # Algorithm A.1 does not apply: a sweep may end where it began, and a finer one still raise q_min.
            yield Step(points, diagnostics, intermediate=True, quality=quality)
            if not np.any((figures_of_merit(quality) - figures_of_merit(before))[:2] > SWEEP_RISE):
                relaxation /= 2
        return Outcome.NO_IMPROVEMENT
