"""The next step of any method for one node."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import singledispatch
from itertools import islice
from typing import Any

import numpy as np

from hexmend.energy import MeshEnergy
from hexmend.errors import MeshError
from hexmend.iteration import Step
from hexmend.kernels import laplacian as kernels
from hexmend.kernels.element_step import element_steps
from hexmend.kernels.line_search import LineSearch
from hexmend.mesh.mesh import Mesh
from hexmend.mesh.validation import as_index
from hexmend.optimise.descent import descend
from hexmend.quality import measure
from hexmend.smoothers import Smoother
from hexmend.smoothers.constrained_steps import constrained_steps
from hexmend.smoothers.general import General
from hexmend.smoothers.getme.sequential import SequentialGETMe
from hexmend.smoothers.getme.simultaneous import GETMe
from hexmend.smoothers.global_.descent import GlobalDescent
from hexmend.smoothers.laplacian.laplacian import Laplacian
from hexmend.smoothers.laplacian.smart_laplacian import SmartLaplacian
from hexmend.smoothers.local.single_node import LocalDescent
from hexmend_app.state.node_step.local import local_step
from hexmend_app.state.node_step.patch import MARGIN, Patch, curve_length
from hexmend_app.state.node_step.record import NodeStep, Pull, StepStatus, Trial

#: delta of the energy that is shown for a patch with an inverted hex; methods of this kind have no delta.
DISPLAY_DELTA = 0.01
#: Samples of the energy along the direction; each needs the energy of the whole mesh.
_SAMPLES = 25


class _RecordedSearch(LineSearch):
    """A line search that records its trials."""

    def __init__(self, search: LineSearch):
        super().__init__(search.initial_step, search.backtrack_factor, search.c1, search.max_backtracks)
        self.trials: list[Trial] = []

    def __call__(self, energy_along: Callable[[float], float], value: float, slope: float) -> tuple[float, int]:
        """Find a step that descends, with the parameters and the result of `LineSearch`."""

        def recorded(alpha: float) -> float:
            energy = energy_along(alpha)
            self.trials.append(Trial(alpha, energy, value + self.c1 * alpha * slope))
            return energy

        return super().__call__(recorded, value, slope)


def global_step(smoother: GlobalDescent, mesh: Mesh, node: int) -> NodeStep:
    """Return the part of one node in the method's next step."""
    energy = MeshEnergy(mesh, smoother.norm)
    search = _RecordedSearch(smoother.line_search)
    x = energy.to_edge_units(mesh.points)
    delta = smoother.delta_at(energy, mesh.points)
    patch = Patch(mesh, mesh.points, node, smoother.norm, delta, energy.unit)
    known = patch.fields() | {"method": smoother.name, "unit": energy.unit, "is_global": True}
    taken = descend(energy, x, delta, smoother.direction(), search)
    if taken is None or not taken.slope < 0:
        status = StepStatus.INFINITE if taken is None else StepStatus.STATIONARY
        known["energy"] = known["energy_after"] = np.inf if taken is None else taken.value
        return NodeStep(**known, after=patch.before, status=status)
    known["energy"], moved, row = taken.value, taken.alpha > 0, int(np.searchsorted(energy.nodes, node))
    curve = np.empty((_SAMPLES, 2))
    curve[:, 0] = np.linspace(0, curve_length(smoother.initial_step, taken.alpha), _SAMPLES)
    curve[:, 1] = [energy.value(energy.moved(x, taken.direction.vector, float(alpha)), delta) for alpha in curve[:, 0]]
    return NodeStep(
        **known,
        after=energy.to_mesh_units(taken.x)[node] if moved else patch.before,
        status=StepStatus.MOVED if moved else StepStatus.NO_DESCENT,
        energy_after=search.trials[-1].energy if moved else taken.value,
        direction=taken.direction.vector[row] * energy.unit,
        slope=taken.slope,
        alpha=taken.alpha,
        shift=taken.direction.shift,
        trials=tuple(search.trials),
        curve=curve,
        diagnostics=taken.diagnostics(delta),
    )


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
    inverted = measure(mesh.points, np.ascontiguousarray(mesh.elements[hexes])).n_inverted > 0
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
    hexes = np.ascontiguousarray(mesh.elements[corners // 8])
    targets = np.empty((len(hexes), 8, 3))
    element_steps(mesh.points, hexes, smoother.scaling, smoother.relaxation, targets)
    return corners // 8, targets[np.arange(len(hexes)), corners % 8], measure(mesh.points, hexes).q
