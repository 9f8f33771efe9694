"""The step of one node by a local method: Algorithms A.2 to A.5 on its patch."""

from __future__ import annotations

import numpy as np

from hexmend.energy.target import target_matrices
from hexmend.kernels import local
from hexmend.mesh.mesh import Mesh
from hexmend.smoothers.local.single_node import LocalDescent
from hexmend_app.state.node_step.patch import Patch, curve_length
from hexmend_app.state.node_step.record import NodeStep, StepStatus, Trial

_STATUS = {
    local.StepStatus.MOVED: StepStatus.MOVED,
    local.StepStatus.NO_DESCENT: StepStatus.NO_DESCENT,
    local.StepStatus.FLAT: StepStatus.STATIONARY,
    local.StepStatus.INFINITE: StepStatus.INFINITE,
}


def local_step(smoother: LocalDescent, mesh: Mesh, points: np.ndarray, node: int, delta: float) -> NodeStep:
    """Return the step that `local.sweep` makes for a node.

    Parameters
    ----------
    points : (n, 3) float64
        Present positions of all nodes.
    delta : float
        The delta of the sweep, (3.2).
    """
    patch, star = Patch(mesh, points, node, smoother.norm, delta), mesh.topology.node_corners[node]
    step = local.recorded_step(points, mesh.hexes, star, smoother.step_settings(delta, target_matrices(mesh)))
    moved, direction, trials = step.status is local.StepStatus.MOVED, np.array(step.direction), step.trials
    return NodeStep(
        **patch.fields(),
        method=smoother.name,
        after=np.array(step.place) if moved else patch.before,
        status=_STATUS[step.status],
        energy_after=float(trials[-1, 1]) if moved else patch.energy,
        direction=direction * patch.unit,
        slope=step.slope,
        alpha=step.alpha,
        fallback=step.fallback,
        shift=step.shift,
        trials=tuple(Trial(*row) for row in trials.tolist()),
        curve=patch.curve(direction, curve_length(smoother.initial_step, step.alpha))
        if len(trials)
        else np.empty((0, 2)),
    )
