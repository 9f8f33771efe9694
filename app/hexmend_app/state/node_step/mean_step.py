"""The step of one node by a method without a search direction, such as to a mean of positions."""

from __future__ import annotations

from collections.abc import Mapping
from itertools import islice
from typing import Any

import numpy as np

from hexmend.iteration import Step
from hexmend.mesh.mesh import Mesh
from hexmend.quality import measure
from hexmend.smoothers.base import Smoother
from hexmend.smoothers.constrained_steps import constrained_steps
from hexmend_app.state.node_step.patch import MARGIN, Patch
from hexmend_app.state.node_step.record import NodeStep, Pull, StepStatus

#: delta of the energy that is shown for a patch with an inverted hex; methods of this kind have no delta.
DISPLAY_DELTA = 0.01


def next_step(smoother: Smoother, mesh: Mesh) -> Step | None:
    """Return the first step of a method on a mesh; None if it makes none."""
    steps = constrained_steps(smoother, mesh)
    step = next(islice(steps, 1, None), None)
    steps.close()
    return step


def step_to_target(
    smoother: Smoother,
    mesh: Mesh,
    node: int,
    after: np.ndarray,
    target: np.ndarray | None = None,
    pulls: tuple[Pull, ...] = (),
    stays: StepStatus = StepStatus.REJECTED,
    notes: Mapping[str, Any] | None = None,
) -> NodeStep:
    """Return the record of a step with a known end.

    Parameters
    ----------
    mesh : Mesh
    node : int
    after : (3,) float64
        Position of the node after the step.
    target : (3,) float64, optional
        Position that the method aims at; `after` by default.
    pulls : tuple of Pull
    stays : StepStatus
        Status of a node that does not move.
    notes : mapping, optional
        See `NodeStep`.
    """
    has_target, target = target is not None, after if target is None else target
    hexes = mesh.topology.node_corners[node] // 8
    inverted = measure(mesh.points, np.ascontiguousarray(mesh.hexes[hexes])).n_inverted > 0
    patch = Patch(mesh, mesh.points, node, smoother.norm, DISPLAY_DELTA if inverted else 0.0)
    direction, move = target - patch.before, after - patch.before
    squared = float(direction @ direction)
    alpha = float(move @ direction) / squared if squared > 0 else 0.0
    status = StepStatus.AT_TARGET if squared == 0 and has_target else stays
    if move.any():
        reached = np.allclose(after, target, rtol=0, atol=1e-9 * patch.unit)
        status = StepStatus.MOVED if reached else StepStatus.SHORTENED
    scaled = direction / patch.unit if patch.unit else direction
    return NodeStep(
        **patch.fields(),
        method=smoother.name,
        after=after,
        status=status,
        energy_after=patch.value(scaled, alpha),
        direction=direction,
        slope=float(patch.gradient @ scaled),
        alpha=alpha,
        curve=patch.curve(scaled, 1.2 * MARGIN) if squared > 0 else np.empty((0, 2)),
        pulls=pulls,
        diagnostics=notes or {},
    )
