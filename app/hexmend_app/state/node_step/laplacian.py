"""The step of one node by Laplacian or smart Laplacian smoothing: to the mean of its edge neighbours."""

from __future__ import annotations

import numpy as np

from hexmend.kernels import laplacian as kernels
from hexmend.mesh.mesh import Mesh
from hexmend.smoothers.laplacian.laplacian import Laplacian
from hexmend.smoothers.laplacian.smart_laplacian import SmartLaplacian
from hexmend_app.state.node_step.explain import explain_free_node
from hexmend_app.state.node_step.mean_step import step_to_target
from hexmend_app.state.node_step.record import NodeStep, Pull


@explain_free_node.register
def _(smoother: Laplacian, mesh: Mesh, node: int) -> NodeStep:
    target, pulls = _mean(mesh, node)
    return step_to_target(smoother, mesh, node, target, target, pulls)


@explain_free_node.register
def _(smoother: SmartLaplacian, mesh: Mesh, node: int) -> NodeStep:
    target, pulls = _mean(mesh, node)
    ring, points, alone = mesh.topology.rings, mesh.points.copy(), np.array([node], np.int32)
    keep = smoother.guard == "quality"
    kernels.smart_sweep(points, mesh.topology.hex_mesh, ring.start, ring.items, alone, keep)
    return step_to_target(smoother, mesh, node, points[node], target, pulls)


def _mean(mesh: Mesh, node: int) -> tuple[np.ndarray, tuple[Pull, ...]]:
    """Return the mean of the edge neighbours, (3,), and the neighbours with their weights."""
    ring, points = mesh.topology.rings, mesh.points.copy()
    kernels.in_place(points, ring.start, ring.items, np.array([node], np.int32))
    neighbours = ring[node].tolist()
    return points[node], tuple(Pull("node", i, mesh.points[i], 1 / len(neighbours)) for i in neighbours)
