"""Raise the least scaled Jacobian of a mesh as far as it goes, by a sequence of linear programs.

The least of many functions has no derivative where two of them are equal, which is where its maximum lies. So each step
takes all that could become the least by their linear models, and asks for the displacement within a trust region that
raises their least most: a linear program (Madsen 1975; Fletcher and Sainz de la Maza 1989). At the end its multipliers
say which corners hold each other: no direction raises one without lowering another.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from hexmend.boundary import SlidingBoundary
from hexmend.iteration.result import Step
from hexmend.mesh.mesh import Mesh
from hexmend.optimise.maxmin.corner_set import MovableCorners
from hexmend.optimise.maxmin.corner_values import gradients, shortest_edges
from hexmend.optimise.maxmin.directions import step_directions
from hexmend.optimise.maxmin.envelope import Envelope
from hexmend.optimise.maxmin.linear_program import LinearConstraints, solve

#: Radius of the trust region at first and at most, in lengths of the shortest edge at each node, and where it ends.
FIRST, LARGEST, SMALLEST = 0.1, 0.3, 1e-6
#: What share of the gain that the models promise a step must bring, below which share the region shrinks, above which
#: it grows; and by what factors.
BRINGS, POOR, GOOD, SHRINK, GROW = 0.1, 0.3, 0.7, 0.4, 2.0
#: Nodes at corners whose values are within a band above the least are moved: so many radii of the region, in bounds.
BAND, NARROWEST, WIDEST = 4.0, 0.01, 0.1
#: How much a corner can fall while its nodes go no further than a radius.
FALL = 8.0
#: Of how many corners the nodes are moved at first, and how many there are at most; more as the fewer bring nothing.
FEW, MANY = 300, 1_200
#: A gain that is none of a step's model; that is none of `LATELY` steps together, and where the least is sound anyway.
NOTHING, LATELY, LITTLE, SOUND, LITTLE_BEYOND = 1e-6, 10, 2e-5, 0.2, 1e-3
#: What a multiplier counts from on, the sum of all being 1.
HOLDS = 1e-3
#: By how many radii, in mean edge lengths, a boundary that has strayed is brought nearer at a time; what is enough.
NEARER, EXACT = 0.2, 1e-6


@dataclass(frozen=True, eq=False)
class MaxMinStep:
    """A step that has raised the least.

    Parameters
    ----------
    points : (n, 3) float64
    least : float
        The least scaled Jacobian of the corners that can be moved.
    corners : int
        Whose models were looked at.
    radius : float
        Of the trust region, in lengths of the shortest edge at each node.
    """

    points: np.ndarray
    least: float
    corners: int
    radius: float

    def step(self, infeasible: bool) -> Step:
        """As a smoother yields it; see `Step.infeasible`."""
        diagnostics = {"least": self.least, "corners": self.corners, "radius": self.radius}
        return Step(self.points, diagnostics, intermediate=True, infeasible=infeasible)


@dataclass(frozen=True, eq=False)
class ActiveCorners:
    """Where it ended.

    Parameters
    ----------
    least : float
        The least scaled Jacobian of the corners that can be moved.
    hexes, corners : (k,) int64
        Those that let it rise no further, and which corner of each it is; by their weight, the heaviest first. Those
        of one place hold each other.
    """

    least: float
    hexes: np.ndarray
    corners: np.ndarray


class MaxMinOptimiser:
    """Raises the least scaled Jacobian of the corners that can be moved.

    Parameters
    ----------
    mesh : Mesh
        Whose free nodes are moved.
    points : (n, 3) float64
        Where they begin.
    sliding : SlidingBoundary, optional
        Where some of them slide: `mesh` is its mesh.

    Attributes
    ----------
    points : (n, 3) float64
    corners : MovableCorners
    envelope : Envelope
    """

    def __init__(self, mesh: Mesh, points: np.ndarray, sliding: SlidingBoundary | None = None):
        self.points, self.corners = points, MovableCorners(mesh, points)
        self.envelope = Envelope(mesh.n_nodes, sliding)
        self._begin()

    @property
    def mesh(self) -> Mesh:
        """Whose free nodes are moved: of the nodes that are fixed, some may have been lifted."""
        return self.corners.mesh

    def steps(self, aim: float = np.inf) -> Iterator[MaxMinStep | ActiveCorners]:
        """Steps that raise the least, until none does any more, or it has reached `aim`; at last what limits it."""
        self._begin()
        gains = [np.inf] * LATELY
        while self._radius > SMALLEST and self.corners.least < aim:
            values, least, radius = self.corners.active_values().ravel(), self.corners.least, self._radius
            band = float(np.clip(BAND * radius, NARROWEST, WIDEST))
            low = np.flatnonzero(values < least + band)
            whole = low.size <= self._most
            if not whole:
                low = low[np.argpartition(values[low], self._most)[: self._most]]
            promised, points, moved = self._step(low, band)
            gain = self._take(points, moved, least, promised) if promised > NOTHING else 0.0
            if gain > 0:
                yield MaxMinStep(self.points, self.corners.least, low.size, radius)
            gains.append(gain)
            if promised <= NOTHING or sum(gains[-LATELY:]) < (LITTLE if least < SOUND else LITTLE_BEYOND):
                if whole or self._most >= MANY:
                    break
                self._most, self._radius = 2 * self._most, max(self._radius, NARROWEST)
                gains.append(np.inf)
        yield self._limit()

    def return_to_band(self, room: float) -> Iterator[MaxMinStep]:
        """Steps that bring the boundary nearer to the surface until it is in its room; the least falls as it must.

        What is settled is no more: everything may be moved.
        """
        self._begin()
        self.corners.unfreeze()
        corners, envelope, edge = self.corners, self.envelope, self.mesh.mean_edge_length
        while self._radius > SMALLEST and (far := envelope.largest_deviation(self.points)) > room * (1 + EXACT):
            radius = self._radius
            envelope.room = max(room, far - NEARER * radius * edge)
            low = np.flatnonzero(corners.active_values().ravel() < corners.least + NARROWEST)[: self._most]
            strayed = envelope.infeasible_nodes(self.points)
            _, points, moved = self._step(low, NARROWEST, strayed[self.mesh.free[strayed]])
            if envelope.largest_deviation(points) > far - BRINGS * (far - envelope.room):
                self._radius *= SHRINK
                continue
            corners.update(points, corners.hexes_at(moved))
            envelope.track(self.points, points, moved)
            self.points, self._radius = points, min(GROW * self._radius, LARGEST)
            yield MaxMinStep(points, corners.least, low.size, radius)
        envelope.room = room

    def freeze(self, limit: ActiveCorners) -> None:
        """Let the corners that hold each other be, and their nodes stay: those that are left can be raised further."""
        self.corners.freeze(8 * limit.hexes + limit.corners)

    def release(self, limit: ActiveCorners) -> bool:
        """Let sliding nodes of the corners that hold each other leave the surface; whether there is one more."""
        envelope, sliding, mesh = self.envelope, self.envelope.sliding, self.mesh
        if sliding is None or not envelope.room > 0:
            return False
        holding = np.unique(self.corners.nodes_of(8 * limit.hexes + limit.corners))
        nodes = holding[envelope.slides(holding)]
        if not nodes.size and limit.least <= 0:
            nodes = holding[sliding.yields[holding] & ~mesh.free[holding]]
            fixed = mesh.fixed.copy()
            fixed[nodes] = False
            self.corners.set_mesh(mesh.with_fixed(fixed))
        envelope.released[nodes] = True
        return nodes.size > 0

    def _begin(self) -> None:
        self._radius, self._most = FIRST, FEW
        self._multipliers: tuple[np.ndarray, np.ndarray] = np.empty(0, np.int64), np.empty(0)

    def _step(
        self, low: np.ndarray, band: float, strayed: np.ndarray | None = None
    ) -> tuple[float, np.ndarray, np.ndarray]:
        """Solve the linear program of the nodes at corners `low`; of those too that have strayed, the least may fall.

        Returns the gain that it promises, all points with these nodes moved and put back, and which these are.
        """
        corners, envelope, radius, least = self.corners, self.envelope, self._radius, self.corners.least
        nodes = corners.movable(np.unique(corners.nodes_of(low)))
        if strayed is not None:
            nodes = np.union1d(nodes, strayed)
        around = corners.hexes_at(nodes)
        near = (8 * around[:, None] + np.arange(8)).ravel()
        near = near[corners.active_values().ravel()[near] - least < band + FALL * radius]
        ends = corners.nodes_of(near)
        values, derivatives = gradients(self.points, ends)
        size = shortest_edges(self.points, self.mesh.hexes[around])
        models = LinearConstraints(ends, np.maximum(values - least, 0.0), derivatives, np.ones(near.size))
        moves = np.zeros(len(self.points))
        moves[nodes] = radius * size[nodes]
        bounds = envelope.bounds(self.points, moves)
        if strayed is None:
            np.maximum(bounds.above, 0.0, out=bounds.above)
        x, slides = self.points[nodes], envelope.slides(nodes)
        directions = step_directions(x, size[nodes], radius, nodes, slides, envelope.sliding)
        solved = solve(nodes, directions, models.joined(bounds), radius, falls=strayed is not None)
        if solved is None:
            return 0.0, self.points, nodes
        self._multipliers = near, solved.multipliers[: near.size]
        points = self.points.copy()
        np.add.at(points, nodes[directions.owner], solved.lengths[:, None] * directions.displacements)
        return solved.gain, envelope.project(self.points, points, nodes), nodes

    def _take(self, points: np.ndarray, moved: np.ndarray, least: float, promised: float) -> float:
        """Move to `points` if that brings enough, and fit the trust region; returns what was gained."""
        corners = self.corners
        hexes = corners.hexes_at(moved)
        before = corners.values[hexes]
        corners.update(points, hexes)
        gain = corners.least - least
        if gain > BRINGS * promised and self.envelope.leaves_band(self.points, points, moved):
            gain = -np.inf
        share = gain / promised
        if share > GOOD:
            self._radius = min(GROW * self._radius, LARGEST)
        elif share < POOR:
            self._radius *= SHRINK
        if share > BRINGS:
            self.points = points
            return gain
        corners.values[hexes] = before
        return 0.0

    def _limit(self) -> ActiveCorners:
        corners, weights = self._multipliers
        order = np.argsort(-weights, kind="stable")
        order = order[weights[order] > HOLDS]
        return ActiveCorners(self.corners.least, corners[order] // 8, corners[order] % 8)
