"""The next step of any method for one node."""

from __future__ import annotations

from functools import singledispatch

from hexmend.errors import MeshError
from hexmend.mesh.mesh import Mesh
from hexmend.mesh.validation import as_index
from hexmend.smoothers import Smoother
from hexmend.smoothers.global_.base import GlobalDescent
from hexmend.smoothers.local.single_node import LocalDescent
from hexmend_app.state.node_step.global_step import global_step
from hexmend_app.state.node_step.local import local_step
from hexmend_app.state.node_step.mean_step import next_step, step_to_target
from hexmend_app.state.node_step.record import NodeStep, StepStatus


def explain(mesh: Mesh, smoother: Smoother, node: int) -> NodeStep:
    """Explain the step that a method would make for a free node of the mesh as it is.

    For local methods, Laplacian and smart Laplacian, which move one node after the other, it is the step of this node
    as if its turn were now; for others its part of the next iteration.

    Parameters
    ----------
    mesh : Mesh
    smoother : Smoother
    node : int
        Number of a free node, from 0.

    Returns
    -------
    NodeStep

    Raises
    ------
    MeshError
        If the node does not exist or is fixed.

    Examples
    --------
    >>> from hexmend.gallery import make
    >>> from hexmend.smoothers import METHODS
    >>> step = explain(make("cube", size=27, scramble=0.3), METHODS["local-sd"](), 21)
    >>> step.status.name, step.trials[-1].alpha == step.alpha, step.trials[-1].energy < step.energy
    ('MOVED', True, True)
    """
    node = as_index(node, mesh.n_nodes, "node")
    if mesh.fixed[node]:
        raise MeshError(f"node {node} is fixed or on the boundary: expected a free interior node")
    if mesh.linear_motion is not None and mesh.linear_motion.marks(mesh.n_nodes)[node]:
        return next_iteration_step(smoother, mesh, node)
    return explain_free_node(smoother, mesh, node)


@singledispatch
def explain_free_node(smoother: Smoother, mesh: Mesh, node: int) -> NodeStep:
    """Explain the step for a free node; by default it is taken from the method's next iteration."""
    return next_iteration_step(smoother, mesh, node)


def next_iteration_step(smoother: Smoother, mesh: Mesh, node: int) -> NodeStep:
    """Return the part of one node in the next iteration of a method."""
    step = next_step(smoother, mesh)
    if step is None:
        return step_to_target(smoother, mesh, node, mesh.points[node].copy(), stays=StepStatus.FINISHED)
    after = step.points[node].copy()
    return step_to_target(smoother, mesh, node, after, stays=StepStatus.UNCHANGED, notes=step.diagnostics)


@explain_free_node.register
def _(smoother: LocalDescent, mesh: Mesh, node: int) -> NodeStep:
    return local_step(smoother, mesh, mesh.points, node, smoother.delta_at(mesh, mesh.points))


@explain_free_node.register
def _(smoother: GlobalDescent, mesh: Mesh, node: int) -> NodeStep:
    return global_step(smoother, mesh, node)
