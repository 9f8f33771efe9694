"""A node's step by a method without a search direction: where it wants the node, and the energy on the way there."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from hexmend.mesh.mesh import Mesh
from hexmend.node_step.patch import MORE, Patch
from hexmend.node_step.record import NodeStep, Pull, StepStatus
from hexmend.quality import measure
from hexmend.smoothers.base import Smoother

#: delta of the energy that is shown where a hex of the patch is inverted: such a method has none of its own.
SOFTNESS = 0.01


def straight_step(
    smoother: Smoother,
    mesh: Mesh,
    node: int,
    after: np.ndarray,
    target: np.ndarray | None = None,
    pulls: tuple[Pull, ...] = (),
    stays: StepStatus = StepStatus.TAKEN_BACK,
    notes: Mapping[str, Any] | None = None,
) -> NodeStep:
    """The record of a step whose end is known.

    Parameters
    ----------
    after : (3,) float64
        Where the method puts the node.
    target : (3,) float64, optional
        Where it would go if nothing stood in the way; without it, `after`.
    stays : StepStatus
        Why the node stays, if it does.
    """
    before = mesh.points[node].copy()
    wanted, target = target is not None, after if target is None else target
    hexes = mesh.topology.node_corners[node] // 8
    tangled = measure(mesh.points, np.ascontiguousarray(mesh.hexes[hexes])).n_inverted > 0
    power, delta = smoother.power, SOFTNESS if tangled else 0.0
    patch = Patch(mesh, mesh.points, node, power, delta)
    way, gone = target - before, after - before
    far = float(way @ way)
    alpha = float(gone @ way) / far if far > 0 else 0.0
    verdict = StepStatus.THERE if far == 0 and wanted else stays
    if gone.any():
        verdict = (
            StepStatus.MOVED if np.allclose(after, target, rtol=0, atol=1e-9 * patch.unit) else StepStatus.SHORTENED
        )
    direction = way / patch.unit if patch.unit else way
    return NodeStep(
        smoother.name, node, hexes, before, after, verdict, patch.unit, power, delta, patch.energy, patch.gradient,
        patch.hessian,
        energy_after=patch.value(direction, alpha),
        direction=way,
        slope=float(patch.gradient @ direction),
        alpha=alpha,
        curve=patch.curve(direction, 1.2 * MORE) if far > 0 else np.empty((0, 2)),
        pulls=pulls,
        notes=notes or {},
    )  # fmt: skip
