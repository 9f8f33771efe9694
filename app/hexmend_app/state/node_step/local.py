"""The step of one node by a local method, Algorithms A.2 to A.5 on its patch; and one sweep, node by node."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from hexmend.energy.target import target_matrices
from hexmend.kernels import local
from hexmend.mesh.mesh import Mesh
from hexmend.mesh.validation import as_index
from hexmend.smoothers.local.single_node import LocalDescent
from hexmend.smoothers.visit_order import ORDERS
from hexmend.terminal_text import count_phrase
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
    step = local.recorded_step(points, mesh.elements, star, smoother.step_settings(delta, target_matrices(mesh)))
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


class Sweep(Iterator[NodeStep]):
    """Iterator that moves one free node after the other, in the order in which `LocalDescent` visits them.

    Parameters
    ----------
    mesh : Mesh
        Is not changed.
    smoother : LocalDescent

    Attributes
    ----------
    nodes : (k,) int32
        The node of each step: the free nodes in the order of the first sweep of a run, each as often as the method
        steps at a node before the next.
    done : int
        Number of steps that have been made.
    delta : float
        The delta of the sweep, (3.2), determined at its beginning.

    Examples
    --------
    >>> from hexmend.gallery import make
    >>> from hexmend.smoothers import METHODS
    >>> sweep = Sweep(make("cube", size=27, scramble=0.3), METHODS["local-sd"]())
    >>> [step.node for step in sweep] == sweep.nodes.tolist()
    True
    """

    def __init__(self, mesh: Mesh, smoother: LocalDescent):
        self.mesh, self.smoother = mesh, smoother
        self.nodes = ORDERS[smoother.order](mesh)(mesh.points, 0).repeat(smoother.repeats)
        self.done = 0
        self.delta = smoother.delta_at(mesh, mesh.points)
        self._points = mesh.points.copy()

    def __next__(self) -> NodeStep:
        if self.finished:
            raise StopIteration
        step = self.preview(int(self.nodes[self.done]))
        self._points[step.node] = step.after
        self.done += 1
        return step

    @property
    def finished(self) -> bool:
        """True if all steps have been made."""
        return self.done == self.nodes.size

    @property
    def points(self) -> np.ndarray:
        """Copy of the present positions of all nodes, (n, 3) float64."""
        return self._points.copy()

    @property
    def title(self) -> str:
        """Short text about what was done, for lists of changes."""
        return f"sweep of {self.smoother.name}, {count_phrase(-(-self.done // self.smoother.repeats), 'node')}"

    def preview(self, node: int) -> NodeStep:
        """Return the step that the method would make for a node at the present positions."""
        node = as_index(node, self.mesh.n_nodes, "node")
        return local_step(self.smoother, self.mesh, self._points, node, self.delta)

    def position(self, node: int) -> int:
        """Return the number of the first step at a free node, from 0."""
        return int(np.flatnonzero(self.nodes == node)[0])

    def finish(self) -> NodeStep | None:
        """Make the remaining steps by the kernel; return the last, or None if none remained."""
        if self.finished:
            return None
        last, settings = self.nodes.size - 1, self.smoother.step_settings(self.delta, target_matrices(self.mesh))
        groups = self.mesh.topology.wavefronts(self.nodes[self.done : last])
        local.sweep(self._points, self.mesh.topology.hex_mesh, groups.start, groups.items, settings)
        self.done = last
        return next(self)
