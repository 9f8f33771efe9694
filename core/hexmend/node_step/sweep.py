"""One sweep of a local method, node by node."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from hexmend.kernels import local
from hexmend.mesh.mesh import Mesh
from hexmend.mesh.validation import as_index
from hexmend.node_step.local import local_step
from hexmend.node_step.record import NodeStep
from hexmend.smoothers.local.single_node import LocalDescent
from hexmend.smoothers.visit_order import ORDERS


class Sweep(Iterator[NodeStep]):
    """Goes through the free nodes in the order in which `LocalDescent` visits them, and moves one after the other.

    Parameters
    ----------
    mesh : Mesh
        Stays as it is.
    smoother : LocalDescent

    Attributes
    ----------
    nodes : (k,) int32
        The free nodes in the order of the sweep, the first of a run with these places.
    done : int
        How many of them have been visited.
    delta : float
        That of the sweep, found at its beginning.

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
        self.nodes = ORDERS[smoother.order](mesh)(mesh.points, 0)
        self.done = 0
        self.delta = smoother.delta_at(mesh, mesh.points)
        self._points = mesh.points.copy()

    def __next__(self) -> NodeStep:
        if self.over:
            raise StopIteration
        step = self.look(int(self.nodes[self.done]))
        self._points[step.node] = step.after
        self.done += 1
        return step

    @property
    def over(self) -> bool:
        """Whether all nodes have been visited."""
        return self.done == self.nodes.size

    @property
    def points(self) -> np.ndarray:
        """Where the nodes are by now, (n, 3) float64; a copy."""
        return self._points.copy()

    @property
    def title(self) -> str:
        """What it has changed, in short."""
        return f"sweep of {self.smoother.name}, {self.done:,} node{'s' * (self.done != 1)}"

    def look(self, node: int) -> NodeStep:
        """What the method would do to a node if its turn were now."""
        node = as_index(node, self.mesh.n_nodes, "node")
        return local_step(self.smoother, self.mesh, self._points, node, self.delta)

    def place(self, node: int) -> int:
        """Which node of the sweep a free node is, from 0."""
        return int(np.flatnonzero(self.nodes == node)[0])

    def finish(self) -> NodeStep | None:
        """Visit all nodes that are left, at the kernel's speed; the step of the last, None where none was left."""
        if self.over:
            return None
        last, settings = self.nodes.size - 1, self.smoother.step_settings(self.delta)
        groups = self.mesh.topology.wavefronts(self.nodes[self.done : last])
        local.sweep(self._points, self.mesh.topology.hex_mesh, groups.start, groups.items, settings)
        self.done = last
        return next(self)
