"""Laplacian smoothing: Algorithm 3.1.

Laplacian sweeps over nodes with a linear motion: to the mean of the neighbours, as far as it admits.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from hexmend.arrays import index_of
from hexmend.iteration import Step
from hexmend.kernels import laplacian as kernels
from hexmend.mesh.linear_motion.constrained_points import admissible_displacements
from hexmend.mesh.mesh import Mesh
from hexmend.optimise.constrained_sweeps import colours_of_independent
from hexmend.parameters import parameter
from hexmend.quality import measure
from hexmend.smoothers.base import Steps, Sweep, method
from hexmend.smoothers.sliding_smoother import SlidingSmoother, Sweeps, moving
from hexmend.smoothers.visit_order import ORDERS


@method
@dataclass(frozen=True)
class Laplacian(SlidingSmoother):
    """Move each node to the mean of its edge neighbours; sliding nodes have neighbours on their curve or patch only."""

    name = "laplacian"
    title = "Laplacian"
    help = "Moves each node to the mean of its edge neighbours. Fast, but inverts hexes in concave regions."
    source = "Wilson 3.1.1, Algorithm 3.1"
    bytes_per_hex = 400

    update: str = parameter(
        "in-place",
        choices=("in-place", "simultaneous"),
        help="in-place: a node uses the new positions of earlier nodes (Algorithm 3.1); simultaneous: the old ones.",
    )
    order: str = parameter(
        "natural",
        choices=tuple(ORDERS),
        help="Order of updates in place (5.2.6): natural is by number, inward is by level from the fixed nodes.",
    )

    def constrained_sweep(self, mesh: Mesh, linear: np.ndarray) -> Sweep:
        return ConstrainedMeans(mesh, linear)

    def steps(self, mesh: Mesh) -> Steps:
        sliding, ring = self.sliding(mesh), mesh.topology.rings
        surface = None
        if sliding is not None:
            mesh, ring, surface = sliding.mesh, sliding.rings, sliding.sliding_surface
        sequence, sweeps = ORDERS[self.order](mesh), Sweeps(sliding, mesh.n_nodes)
        points, number = mesh.points, 0

        def sweep(moved: np.ndarray, stays: np.ndarray) -> None:
            kernels.in_place(moved, ring.start, ring.items, moving(nodes, stays), surface)

        yield Step(points)
        while True:
            nodes = sequence(points, number)
            if self.update == "in-place" and sliding is not None:
                points = sweeps(points, sweep)[0]
            elif self.update == "in-place":
                points = points.copy()
                kernels.in_place(points, ring.start, ring.items, nodes)
            else:
                moved = points.copy()
                kernels.simultaneous(points, ring.start, ring.items, nodes, moved)
                points = moved if sliding is None else sliding.reject_moves(points, sliding.projected(moved))
            yield Step(points)
            number += 1


class ConstrainedMeans:
    """Sweeps that move nodes and those tied to them by the admissible part of the mean of their Laplacian steps.

    Independent nodes of one colour share no hex and move at once; a later colour uses the new positions.

    Parameters
    ----------
    mesh : Mesh
        With a linear motion.
    chosen : (n,) bool
        Nodes that move.
    guard : str
        Moves that are rejected: "inversion" those that invert an attached hex, "quality" also those that lower the
        least q(H) of the attached hexes; "" none.
    """

    def __init__(self, mesh: Mesh, chosen: np.ndarray, guard: str = ""):
        self._mesh, self._guard, self.rejected = mesh, guard, 0
        self._root = mesh.linear_motion.roots(mesh.n_nodes)
        self._colours = colours_of_independent(mesh, chosen)

    def __call__(self, points: np.ndarray) -> np.ndarray:
        """Return the points (n, 3) after a sweep; `rejected` counts the moves that were rejected in it."""
        self.rejected = 0
        for number in range(len(self._colours)):
            points = self._moved(points, self._colours[number])
        return points

    def _moved(self, points: np.ndarray, masters: np.ndarray) -> np.ndarray:
        mesh, rings, motion = self._mesh, self._mesh.topology.rings, self._mesh.linear_motion
        group = index_of(masters, mesh.n_nodes)[self._root]
        np.maximum.at(group, motion.hanging, group[motion.anchors])
        nodes = np.flatnonzero((group >= 0) & (np.diff(rings.start) > 0))
        count = np.diff(rings.start)[nodes]
        sums = np.add.reduceat(points[rings.of(nodes)], np.cumsum(count) - count, axis=0)
        steps = np.zeros(points.shape)
        steps[nodes] = sums / count[:, None] - points[nodes]
        moved = points.copy()
        moved[nodes] += admissible_displacements(motion, steps)[nodes]
        if self._guard:
            rejected = self._harmed(points, moved, group, masters.size)
            moved[nodes] = np.where(rejected[group[nodes], None], points[nodes], moved[nodes])
            self.rejected += int(rejected.sum())
        return moved

    def _harmed(self, before: np.ndarray, after: np.ndarray, group: np.ndarray, count: int) -> np.ndarray:
        """Mark the groups of nodes whose moves are rejected, (count,) bool; `group` is -1 for nodes that stay."""
        of_hex = group[self._mesh.elements].max(axis=1)
        attached = np.flatnonzero(of_hex >= 0)
        hexes, of_hex = self._mesh.elements[attached], of_hex[attached]
        was, now = measure(before, hexes), measure(after, hexes)
        harmed = np.bincount(of_hex, now.inverted & ~was.inverted, count) > 0
        if self._guard == "quality":
            least = np.ones((2, count))
            np.minimum.at(least[0], of_hex, was.q)
            np.minimum.at(least[1], of_hex, now.q)
            harmed |= least[1] < least[0]
        return harmed
