"""What any method would do to a node next."""

from __future__ import annotations

from functools import singledispatch

from hexmend.errors import MeshError
from hexmend.mesh.mesh import Mesh
from hexmend.mesh.validation import as_index
from hexmend.node_step.global_step import whole_step
from hexmend.node_step.local import local_step
from hexmend.node_step.mean_step import straight_step
from hexmend.node_step.record import NodeStep, StepStatus
from hexmend.smoothers import Smoother
from hexmend.smoothers.global_.base import GlobalDescent
from hexmend.smoothers.local.single_node import LocalDescent


def explain(mesh: Mesh, smoother: Smoother, node: int) -> NodeStep:
    """What a method would do to a free node of a mesh as it is, and why.

    A local method, Laplacian and smart Laplacian visit node after node: told is what they would do if this node's turn
    were now. Of others it is the node's part of the next iteration.

    Parameters
    ----------
    mesh : Mesh
    smoother : Smoother
    node : int

    Raises
    ------
    MeshError
        Where the node does not exist or is fixed.

    Examples
    --------
    >>> from hexmend.gallery import make
    >>> from hexmend.smoothers import METHODS
    >>> step = explain(make("cube", size=27, scramble=0.3), METHODS["local-sd"](), 21)
    >>> step.verdict.name, step.trials[-1].alpha == step.alpha, step.trials[-1].energy < step.energy
    ('MOVED', True, True)
    """
    node = as_index(node, mesh.n_nodes, "node")
    if mesh.fixed[node]:
        raise MeshError(f"node {node} is fixed, and no method moves it: name a free node")
    return explained(smoother, mesh, node)


@singledispatch
def explained(smoother: Smoother, mesh: Mesh, node: int) -> NodeStep:
    """What a method does to a free node; for one that is not known better, its next iteration and no reason."""
    steps = smoother.steps(mesh)
    next(steps)
    step = next(steps, None)
    steps.close()
    after = mesh.points[node].copy() if step is None else step.points[node].copy()
    notes = {} if step is None else step.diagnostics
    stays = StepStatus.FINISHED if step is None else StepStatus.STAYS
    return straight_step(smoother, mesh, node, after, stays=stays, notes=notes)


@explained.register
def _(smoother: LocalDescent, mesh: Mesh, node: int) -> NodeStep:
    return local_step(smoother, mesh, mesh.points, node, smoother.delta_at(mesh, mesh.points))


@explained.register
def _(smoother: GlobalDescent, mesh: Mesh, node: int) -> NodeStep:
    return whole_step(smoother, mesh, node)
