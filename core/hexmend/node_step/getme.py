"""A node's step by GETMe: each of its hexes has a place for it."""

from __future__ import annotations

import itertools

import numpy as np

from hexmend.iteration import Step
from hexmend.kernels.element_step import element_steps
from hexmend.mesh.mesh import Mesh
from hexmend.node_step.explain import explained
from hexmend.node_step.mean_step import straight_step
from hexmend.node_step.record import NodeStep, Pull, StepStatus
from hexmend.quality import measure
from hexmend.smoothers.base import Smoother
from hexmend.smoothers.general import General
from hexmend.smoothers.getme.sequential import SequentialGETMe
from hexmend.smoothers.getme.simultaneous import GETMe


@explained.register
def _(smoother: GETMe, mesh: Mesh, node: int) -> NodeStep:
    hexes, places, q = _places(smoother, mesh, node)
    weights = smoother.weigh(q)
    weights = weights / weights.sum()
    pulls = tuple(Pull("hex", *row) for row in zip(hexes.tolist(), places, weights.tolist(), strict=True))
    step = _next(smoother, mesh)
    after = step.points[node].copy()
    return straight_step(smoother, mesh, node, after, weights @ places, pulls, notes=step.diagnostics)


@explained.register
def _(smoother: SequentialGETMe, mesh: Mesh, node: int) -> NodeStep:
    hexes, places, _ = _places(smoother, mesh, node)
    pulls = tuple(Pull("hex", h, place, None) for h, place in zip(hexes.tolist(), places, strict=True))
    step = _next(smoother, mesh)
    after = step.points[node].copy()
    return straight_step(smoother, mesh, node, after, pulls=pulls, stays=StepStatus.STAYS, notes=step.diagnostics)


@explained.register
def _(smoother: General, mesh: Mesh, node: int) -> NodeStep:
    return explained(GETMe(), mesh, node)


def _next(smoother: Smoother, mesh: Mesh) -> Step:
    """The next step of all nodes."""
    steps = smoother.steps(mesh)
    step = next(itertools.islice(steps, 1, None))
    steps.close()
    return step


def _places(smoother: GETMe | SequentialGETMe, mesh: Mesh, node: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """The hexes of a node, (k,); where each of them wants it, (k, 3); their q(H), (k,)."""
    corners = mesh.topology.node_corners[node]
    hexes = np.ascontiguousarray(mesh.hexes[corners // 8])
    places = np.empty((len(hexes), 8, 3))
    element_steps(mesh.points, hexes, smoother.scaling, smoother.relaxation, places)
    return corners // 8, places[np.arange(len(hexes)), corners % 8], measure(mesh.points, hexes).q
