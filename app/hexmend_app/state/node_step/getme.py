"""The step of one node by GETMe: each of its hexes gives a target position."""

from __future__ import annotations

import numpy as np

from hexmend.kernels.element_step import element_steps
from hexmend.mesh.mesh import Mesh
from hexmend.quality import measure
from hexmend.smoothers.general import General
from hexmend.smoothers.getme.sequential import SequentialGETMe
from hexmend.smoothers.getme.simultaneous import GETMe
from hexmend_app.state.node_step.explain import explain_free_node
from hexmend_app.state.node_step.mean_step import next_step, step_to_target
from hexmend_app.state.node_step.record import NodeStep, Pull, StepStatus


@explain_free_node.register
def _(smoother: GETMe, mesh: Mesh, node: int) -> NodeStep:
    hexes, targets, q = _targets(smoother, mesh, node)
    weights = smoother.hex_weights(q)
    weights = weights / weights.sum()
    pulls = tuple(Pull("hex", *row) for row in zip(hexes.tolist(), targets, weights.tolist(), strict=True))
    step = next_step(smoother, mesh)
    after = step.points[node].copy()
    return step_to_target(smoother, mesh, node, after, weights @ targets, pulls, notes=step.diagnostics)


@explain_free_node.register
def _(smoother: SequentialGETMe, mesh: Mesh, node: int) -> NodeStep:
    hexes, targets, _ = _targets(smoother, mesh, node)
    pulls = tuple(Pull("hex", h, target, None) for h, target in zip(hexes.tolist(), targets, strict=True))
    step = next_step(smoother, mesh)
    after = step.points[node].copy()
    return step_to_target(smoother, mesh, node, after, pulls=pulls, stays=StepStatus.UNCHANGED, notes=step.diagnostics)


@explain_free_node.register
def _(smoother: General, mesh: Mesh, node: int) -> NodeStep:
    return explain_free_node(GETMe(), mesh, node)


def _targets(smoother: GETMe | SequentialGETMe, mesh: Mesh, node: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return the hexes of a node, (k,), its target position in each, (k, 3), and their q(H), (k,)."""
    corners = mesh.topology.node_corners[node]
    hexes = np.ascontiguousarray(mesh.hexes[corners // 8])
    targets = np.empty((len(hexes), 8, 3))
    element_steps(mesh.points, hexes, smoother.scaling, smoother.relaxation, targets)
    return corners // 8, targets[np.arange(len(hexes)), corners % 8], measure(mesh.points, hexes).q
