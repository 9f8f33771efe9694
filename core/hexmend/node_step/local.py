"""A node's step by a local method: Algorithms A.2 to A.5 on its patch."""

from __future__ import annotations

import numpy as np

from hexmend.kernels import local
from hexmend.mesh import Mesh
from hexmend.node_step.patch import Patch, reach_of
from hexmend.node_step.record import NodeStep, Verdict
from hexmend.smoothers.local_descent import LocalDescent


def local_step(smoother: LocalDescent, mesh: Mesh, points: np.ndarray, node: int, delta: float) -> NodeStep:
    """What `local.sweep` does to a node of the mesh at points (n, 3), with the delta of the sweep."""
    patch, before = Patch(mesh, points, node, smoother.p, delta), points[node].copy()
    known = {
        "method": smoother.name, "node": node, "hexes": patch.hexes, "before": before, "unit": patch.unit,
        "p": smoother.p, "delta": delta, "energy": patch.energy, "gradient": patch.gradient, "hessian": patch.hessian,
    }  # fmt: skip
    if patch.unit == 0 or patch.energy == 0 or not patch.gradient.any():
        return NodeStep(**known, after=before, energy_after=patch.energy, verdict=Verdict.FLAT)
    if not patch.energy < np.inf:
        return NodeStep(**known, after=before, energy_after=patch.energy, verdict=Verdict.INFINITE)
    direction, slope, fallback, alpha, trials = patch.search(
        smoother.direction, smoother.first_step, smoother.shrink, smoother.c1, smoother.max_cuts
    )
    return NodeStep(
        **known,
        after=patch.moved(before, direction, alpha),
        verdict=Verdict.MOVED if alpha > 0 else Verdict.NO_DESCENT,
        energy_after=trials[-1].energy if alpha > 0 else patch.energy,
        direction=direction * patch.unit,
        slope=slope,
        alpha=alpha,
        fallback=fallback,
        shift=shift_of(patch.hessian) if smoother.direction == local.MODIFIED_NEWTON else 0.0,
        trials=trials,
        curve=patch.curve(direction, reach_of(smoother.first_step, alpha)),
    )


def shift_of(hessian: np.ndarray) -> float:
    """What A.4 adds to the eigenvalues of a Hessian (3, 3): the least is raised to a thousandth of the greatest."""
    least, _, greatest = np.linalg.eigvalsh(hessian)
    return float(0.001 * greatest - least) if least < 0.001 * greatest else 0.0
