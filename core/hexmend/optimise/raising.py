"""Raise the least scaled Jacobian of a mesh as far as it goes, by a sequence of linear programs.

The least of many functions has no derivative where two of them are equal, which is where its maximum lies. So each step
takes all that could become the least by their linear models, and asks for the displacement within a trust region that
raises their least most: a linear program (Madsen 1975; Fletcher and Sainz de la Maza 1989). At the end its multipliers
say which corners hold each other: no direction raises one without lowering another.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Generator
from dataclasses import dataclass
from typing import Any

import numpy as np

from hexmend.hexahedron import CORNER_TETRAHEDRA
from hexmend.mesh import Mesh
from hexmend.optimise.corners import gradients, scaled_jacobians
from hexmend.surface import Sliding

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
#: A gain that is none: of a step's model, and of `LATELY` steps together.
NOTHING, LITTLE, LATELY = 1e-6, 2e-5, 10
#: What a multiplier counts from on, the sum of all being 1.
HOLDS = 1e-3
#: Ways around a place of a patch, in its basis.
_AROUND = np.array([(np.cos(angle), np.sin(angle), 0.0) for angle in np.arange(8) * np.pi / 4]).round(15)
#: Share of the gain that may be given away so that nodes stay which need not move.
IDLE = 0.05


@dataclass(frozen=True, eq=False)
class Raised:
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


@dataclass(frozen=True, eq=False)
class Limit:
    """Where it ended.

    Parameters
    ----------
    least : float
        The least scaled Jacobian of the corners that can be moved.
    hexes, corners : (k,) int64
        Those that hold each other there, and which corner of each it is; by their weight, the heaviest first.
    """

    least: float
    hexes: np.ndarray
    corners: np.ndarray


class Raising:
    """The corners of a mesh that can be moved, with their scaled Jacobians.

    Parameters
    ----------
    mesh : Mesh
        Whose free nodes are moved.
    points : (n, 3) float64
        Where they begin.
    sliding : Sliding, optional
        Where some of them slide: `mesh` is its mesh.

    Attributes
    ----------
    points : (n, 3) float64
    values : (m, 8)
        Of each corner; +inf of those that no free node is at.
    """

    def __init__(self, mesh: Mesh, points: np.ndarray, sliding: Sliding | None = None, lifts: bool = False):
        self.mesh, self.sliding, self.points, self.lifts = mesh, sliding, points, lifts
        self._held = ~mesh.free[mesh.hexes[:, CORNER_TETRAHEDRA]].any(axis=2)
        self.values = scaled_jacobians(points, mesh.hexes)
        self.values[self._held] = np.inf
        self._radius, self._most = FIRST, FEW
        self._multipliers: tuple[np.ndarray, np.ndarray] = np.empty(0, np.int64), np.empty(0)

    @property
    def least(self) -> float:
        """The least scaled Jacobian of a corner that can be moved; +inf where there is none."""
        return float(self.values.min(initial=np.inf))

    def steps(self) -> Generator[Raised, None, Limit]:
        """Steps that raise the least, until none does any more."""
        gains = [np.inf] * LATELY
        while self._radius > SMALLEST and np.isfinite(self.least):
            least, radius = self.least, self._radius
            band = float(np.clip(BAND * radius, NARROWEST, WIDEST))
            low = np.flatnonzero(self.values < least + band)
            whole = low.size <= self._most
            if not whole:
                low = low[np.argpartition(self.values.ravel()[low], self._most)[: self._most]]
            promised, points, near = self._step(low, band)
            gain = 0.0
            if promised > NOTHING:
                gain = self._take(points, near, least, promised)
            if gain > 0:
                yield Raised(self.points, self.least, near.size, radius)
            gains.append(gain)
            if promised <= NOTHING or sum(gains[-LATELY:]) < LITTLE:
                if whole or self._most >= MANY:
                    break
                self._most, self._radius = 2 * self._most, max(self._radius, NARROWEST)
                gains.append(np.inf)
        return self._limit()

    def _step(self, low: np.ndarray, band: float) -> tuple[float, np.ndarray, np.ndarray]:
        """Solve the linear program of the nodes at corners `low`.

        Returns the gain that it promises, all points with these nodes moved and put back, and which these are.
        """
        from scipy.optimize import linprog

        hexes, radius, least = self.mesh.hexes, self._radius, self.least
        nodes = np.unique(_nodes(hexes, low))
        nodes = nodes[self.mesh.free[nodes]]
        around = np.unique(self.mesh.topology.node_corners.of(nodes) // 8)
        near = (8 * around[:, None] + np.arange(8)).ravel()
        near = near[self.values.ravel()[near] < least + band + FALL * radius]
        ends = _nodes(hexes, near)
        values, derivatives, lengths = gradients(self.points, ends)
        size = np.full(self.mesh.n_nodes, np.inf)
        for end, length in ((0, lengths.min(axis=1)), (1, lengths[:, 0]), (2, lengths[:, 1]), (3, lengths[:, 2])):
            np.minimum.at(size, ends[:, end], length)
        models = _Models(ends, values - least, derivatives, np.ones(near.size))
        if self.sliding is not None and np.isfinite(self.sliding.room):
            models = models.and_those(self._room(nodes, size))
        ways = self._ways(nodes, size)
        solved = linprog(*_program(nodes, ways, models, radius), method="highs")
        if solved.status != 0:
            return 0.0, self.points, nodes
        self._multipliers = near, -solved.ineqlin.marginals[: near.size]
        points = self.points.copy()
        np.add.at(points, nodes[ways.of], solved.x[:-1, None] * ways.aims)
        if self.sliding is not None and not self.lifts:
            slide = nodes[self.sliding.slides(nodes)]
            points[slide] = self.sliding.put_back(points[slide], slide)
        return float(solved.x[-1]), points, nodes

    def _room(self, nodes: np.ndarray, size: np.ndarray) -> _Models:
        """What keeps the boundary at nodes in its room."""
        sliding = self.sliding
        which = sliding.middles_at(nodes)
        far, away = sliding.off(self.points, which)
        ends = sliding.middles[which]
        reach = self._radius * np.where(np.isfinite(size[ends]), size[ends], 0.0).max(axis=1, initial=0.0)
        near = far + reach > sliding.room
        ends, far, away = ends[near], far[near], away[near]
        slopes = np.repeat(-away[:, None] / 4, 4, axis=1)
        return _Models(ends, np.maximum(sliding.room - far, 0.0), slopes, np.zeros(len(far)))

    def _leaves(self, points: np.ndarray, nodes: np.ndarray) -> bool:
        """Whether the boundary at nodes has left its room, further than it was."""
        if self.sliding is None or not np.isfinite(self.sliding.room):
            return False
        which = self.sliding.middles_at(nodes)
        before, after = (self.sliding.off(x, which)[0] for x in (self.points, points))
        return bool((after > np.maximum(before, self.sliding.room)).any())

    def _ways(self, nodes: np.ndarray, size: np.ndarray) -> _Ways:
        """Ways of nodes: both senses of each axis; of those that slide on a patch eight around, on a curve two."""
        axes = np.concatenate([np.eye(3), -np.eye(3)])
        slides = np.zeros(nodes.size, dtype=bool)
        if self.sliding is not None and not self.lifts:
            slides = self.sliding.slides(nodes)
        inside = np.flatnonzero(~slides)
        of, aims = np.repeat(inside, 6), np.tile(axes, (inside.size, 1))
        leads = aims
        if slides.any():
            on = np.flatnonzero(slides)
            bases = self.sliding.bases(self.points[nodes[on]], nodes[on])
            around = np.einsum("kij,wj->kwi", bases, _AROUND).reshape(-1, 3)
            of_around = np.repeat(on, len(_AROUND))
            there = np.linalg.norm(around, axis=1) > 0.5  # of a curve all that goes along it, once
            there &= np.tile(_AROUND[:, 1] == 0, on.size) | np.repeat(bases[:, :, 1].any(axis=1), len(_AROUND))
            around, of_around = around[there], of_around[there]
            far = self._radius * size[nodes[of_around], None]
            start = self.points[nodes[of_around]]
            led = (self.sliding.put_back(start + far * around, nodes[of_around]) - start) / far
            of, aims, leads = (np.concatenate(both) for both in ((of, of_around), (aims, around), (leads, led)))
        order = np.argsort(of, kind="stable")
        scale = size[nodes[of[order]], None]
        return _Ways(of[order], scale * aims[order], scale * leads[order])

    def _limit(self) -> Limit:
        corners, weights = self._multipliers
        order = np.argsort(-weights, kind="stable")
        order = order[weights[order] > HOLDS]
        return Limit(self.least, corners[order] // 8, corners[order] % 8)

    def _take(self, points: np.ndarray, moved: np.ndarray, least: float, promised: float) -> float:
        """Move to `points` if that brings enough, and fit the trust region; returns what was gained."""
        hexes = np.unique(self.mesh.topology.node_corners.of(moved) // 8)
        values = scaled_jacobians(points, self.mesh.hexes[hexes])
        values[self._held[hexes]] = np.inf
        before = self.values[hexes]
        self.values[hexes] = values
        gain = self.least - least
        share = gain / promised
        if share > BRINGS and self._leaves(points, moved):
            share = -np.inf
        if share > BRINGS:
            self.points = points
        else:
            self.values[hexes], gain = before, 0.0
        if share > GOOD:
            self._radius = min(GROW * self._radius, LARGEST)
        elif share < POOR:
            self._radius *= SHRINK
        return gain


@dataclass(frozen=True, eq=False)
class _Ways:
    """Ways that nodes may go, in the length of the shortest edge at each.

    Parameters
    ----------
    of : (w,)
        Whose, ascending.
    aims : (w, 3)
        The displacement that is asked for: along a tangent where the node slides.
    leads : (w, 3)
        What it comes to once the node is put back: of a faceted surface that is another plane at every side.
    """

    of: np.ndarray
    aims: np.ndarray
    leads: np.ndarray


@dataclass(frozen=True, eq=False)
class _Models:
    """Linear models of what depends on the places of four nodes each.

    Parameters
    ----------
    ends : (r, 4)
        The nodes.
    above : (r,)
        How far the value is above its bound.
    slopes : (r, 4, 3)
        Its derivatives by their places.
    rises : (r,)
        1 where the bound is to rise, as the least of the corners is; 0 where it stands.
    """

    ends: np.ndarray
    above: np.ndarray
    slopes: np.ndarray
    rises: np.ndarray

    def and_those(self, other: _Models) -> _Models:
        """These, and others behind them."""
        pairs = ((getattr(one, field.name) for one in (self, other)) for field in dataclasses.fields(self))
        return _Models(*(np.concatenate(list(pair)) for pair in pairs))


def _program(nodes: np.ndarray, ways: _Ways, models: _Models, radius: float) -> tuple[Any, ...]:
    """The linear program of a step, as `scipy.optimize.linprog` takes it: costs, matrix, limits, bounds.

    Unknowns are how far nodes (k,) go each of their ways, up to a radius, and what the least rises by. Those nodes stay
    that need not move: a small price is on each way.
    """
    from scipy.sparse import coo_array

    ends = models.ends
    slot = np.full(int(ends.max(initial=0)) + 1, -1)
    slot[nodes] = np.arange(nodes.size)
    slots = slot[ends]
    row, end = np.nonzero(slots >= 0)
    own = slots[row, end]
    start = np.searchsorted(ways.of, np.arange(nodes.size + 1))
    count = start[own + 1] - start[own]
    pair = np.repeat(np.arange(own.size), count)
    column = np.arange(pair.size) + np.repeat(start[own] - np.cumsum(count) + count, count)
    slopes = np.einsum("ki,ki->k", models.slopes[row[pair], end[pair]], ways.leads[column])
    unknowns, rows = ways.of.size + 1, len(ends)
    entries = np.concatenate([-slopes, models.rises])
    at = np.concatenate([row[pair], np.arange(rows)]), np.concatenate([column, np.full(rows, unknowns - 1)])
    cost = np.full(unknowns, IDLE / max(nodes.size, 1))
    cost[-1] = -1.0
    bounds = np.zeros((unknowns, 2))
    bounds[:, 1] = radius
    bounds[-1, 1] = 2.0
    return cost, coo_array((entries, at), shape=(rows, unknowns)).tocsr(), models.above, None, None, bounds


def _nodes(hexes: np.ndarray, corners: np.ndarray) -> np.ndarray:
    """Apex and ends of corners, 8 * hex + corner, (k, 4)."""
    return np.take_along_axis(hexes[corners // 8], CORNER_TETRAHEDRA[corners % 8], axis=1)
