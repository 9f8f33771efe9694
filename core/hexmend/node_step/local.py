"""The step of one node by a local method: Algorithms A.2 to A.5 on its patch."""

from __future__ import annotations

import numpy as np

from hexmend.kernels import local
from hexmend.mesh.mesh import Mesh
from hexmend.node_step.patch import Patch, curve_length
from hexmend.node_step.record import NodeStep, StepStatus, Trial
from hexmend.smoothers.local.single_node import LocalDescent

_STATUS = {
    local.MOVED: StepStatus.MOVED,
    local.NO_DESCENT: StepStatus.NO_DESCENT,
    local.FLAT: StepStatus.STATIONARY,
    local.INFINITE: StepStatus.INFINITE,
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
    patch, before = Patch(mesh, points, node, smoother.power, delta), points[node].copy()
    status, direction_of_step, slope, fallback, shift, alpha, place, trials = local.recorded_step(
        points, mesh.hexes, mesh.topology.node_corners[node], smoother.step_settings(delta)
    )
    moved, searched, direction = status == local.MOVED, len(trials) > 0, np.array(direction_of_step)
    return NodeStep(
        method=smoother.name,
        node=node,
        before=before,
        after=np.array(place) if moved else before,
        status=_STATUS[status],
        delta=delta,
        **patch.energy_fields(),
        energy_after=float(trials[-1, 1]) if moved else patch.energy,
        direction=direction * patch.unit,
        slope=slope,
        alpha=alpha,
        fallback=fallback,
        shift=shift,
        trials=tuple(Trial(*row) for row in trials.tolist()),
        curve=patch.curve(direction, curve_length(smoother.initial_step, alpha)) if searched else np.empty((0, 2)),
    )
