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

from hexmend.hexahedron import CORNER_TETRAHEDRA
from hexmend.mesh import Mesh
from hexmend.optimise.apart import Apart
from hexmend.optimise.corners import gradients, scaled_jacobians, shortest_edges
from hexmend.optimise.iteration import Step
from hexmend.optimise.program import Models, Ways, solve
from hexmend.surface import Off, Sliding

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
#: Ways around a place of a patch, in its basis.
_AROUND = np.array([(np.cos(angle), np.sin(angle), 0.0) for angle in np.arange(8) * np.pi / 4]).round(15)


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

    def step(self, detour: bool = False) -> Step:
        """As a smoother yields it; see `Step.detour`."""
        notes = {"least": self.least, "corners": self.corners, "radius": self.radius}
        return Step(self.points, notes, more=True, detour=detour)


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
        Of each corner.
    settled : (m, 8) bool
        Corners that could be moved, but none of whose nodes moves any more.
    lifted : (n,) bool
        Nodes of the boundary that need not stay on the surface, as long as they stay in the room around it.
    turns : bool
        Whether quads at these may be turned over; else no step does that.
    """

    def __init__(self, mesh: Mesh, points: np.ndarray, sliding: Sliding | None = None):
        self.mesh, self.sliding, self.points = mesh, sliding, points
        self._held = ~mesh.free[mesh.hexes[:, CORNER_TETRAHEDRA]].any(axis=2)
        self.values = scaled_jacobians(points, mesh.hexes)
        self.settled = np.zeros(self.values.shape, dtype=bool)
        self.lifted = np.zeros(mesh.n_nodes, dtype=bool)
        self.turns = False
        self._stays = np.zeros(mesh.n_nodes, dtype=bool)
        self.room = np.inf if sliding is None else sliding.room
        self._seen: Apart | None = None
        self._begin()

    @property
    def least(self) -> float:
        """The least scaled Jacobian of the corners that are raised; +inf where there is none."""
        return float(self._raised().min(initial=np.inf))

    @property
    def lowest(self) -> float:
        """The least scaled Jacobian of all corners that can be moved, settled or not; +inf where there is none."""
        return float(np.where(self._held, np.inf, self.values).min(initial=np.inf))

    def locked_below(self, value: float) -> np.ndarray:
        """Corners, 8 * hex + corner, lower than a value, all of whose nodes are fixed, the lowest first, (k,) int64."""
        values = np.where(self._held, self.values, np.inf).ravel()
        low = np.flatnonzero(values < value)
        return low[np.argsort(values[low], kind="stable")]

    def steps(self, aim: float = np.inf) -> Iterator[Raised | Limit]:
        """Steps that raise the least, until none does any more, or it has reached `aim`; at last what limits it."""
        self._begin()
        gains = [np.inf] * LATELY
        while self._radius > SMALLEST and self.least < aim:
            values, least, radius = self._raised().ravel(), self.least, self._radius
            band = float(np.clip(BAND * radius, NARROWEST, WIDEST))
            low = np.flatnonzero(values < least + band)
            whole = low.size <= self._most
            if not whole:
                low = low[np.argpartition(values[low], self._most)[: self._most]]
            promised, points, moved = self._step(low, band)
            gain = self._take(points, moved, least, promised) if promised > NOTHING else 0.0
            if gain > 0:
                yield Raised(self.points, self.least, low.size, radius)
            gains.append(gain)
            if promised <= NOTHING or sum(gains[-LATELY:]) < (LITTLE if least < SOUND else LITTLE_BEYOND):
                if whole or self._most >= MANY:
                    break
                self._most, self._radius = 2 * self._most, max(self._radius, NARROWEST)
                gains.append(np.inf)
        yield self._limit()

    def into(self, room: float) -> Iterator[Raised]:
        """Steps that bring the boundary nearer to the surface until it is in its room; the least falls as it must.

        What is settled is no more: everything may be moved.
        """
        self._begin()
        self.settled[:] = self._stays[:] = False
        while self._radius > SMALLEST and (far := self.furthest()) > room * (1 + EXACT):
            radius = self._radius
            self.room, least = max(room, far - NEARER * radius * self.mesh.mean_edge_length), self.least
            low = np.flatnonzero(self._raised().ravel() < least + NARROWEST)[: self._most]
            _, points, moved = self._step(low, NARROWEST, self._strayed())
            old, apart, self.points = self.points, self._apart, points
            if self.furthest() > far - BRINGS * (far - self.room):
                self.points = old
                self._radius *= SHRINK
                continue
            hexes = np.unique(self.mesh.topology.node_corners.of(moved) // 8)
            self.values[hexes] = scaled_jacobians(points, self.mesh.hexes[hexes])
            self._seen, self._radius = apart.moved(points, moved), min(GROW * self._radius, LARGEST)
            yield Raised(points, self.least, low.size, radius)
        self.room = room

    def furthest(self) -> float:
        """The largest distance of the boundary and the surface, both ways."""
        if self.sliding is None:
            return 0.0
        return max(float(off.far.max(initial=0.0)) for off in self._off(self.points, 0.0))

    def _strayed(self) -> np.ndarray:
        """Free nodes where the boundary is out of its room."""
        found = np.unique(np.concatenate([off.nodes for off in self._off(self.points, self.room)]))
        return found[self.mesh.free[found]]

    def _off(self, points: np.ndarray, room: float) -> tuple[Off, Off]:
        """Where the boundary is further than that from the surface, and the surface from the boundary."""
        sliding = self.sliding
        return sliding.off(points, np.arange(len(sliding.middles)), room), sliding.behind(points, room=room)

    def settle(self, limit: Limit) -> None:
        """Let the corners that hold each other be, and their nodes stay: those that are left can be raised further."""
        self._stays[_nodes(self.mesh.hexes, 8 * limit.hexes + limit.corners)] = True
        moves = self.mesh.free & ~self._stays
        self.settled = ~moves[self.mesh.hexes[:, CORNER_TETRAHEDRA]].any(axis=2) & ~self._held

    def lift(self, limit: Limit) -> bool:
        """Let sliding nodes of the corners that hold each other leave the surface; whether there is one more."""
        if self.sliding is None or not self.room > 0:
            return False
        nodes = np.unique(self.mesh.hexes[limit.hexes[:, None], CORNER_TETRAHEDRA[limit.corners]])
        nodes = nodes[self.sliding.slides(nodes) & ~self.lifted[nodes]]
        self.lifted[nodes] = True
        if not nodes.size and limit.least < 0:
            nodes = np.unique(self.mesh.hexes[limit.hexes[:, None], CORNER_TETRAHEDRA[limit.corners]])
            nodes = nodes[self.sliding.yields[nodes] & ~self.mesh.free[nodes]]
            fixed = self.mesh.fixed.copy()
            fixed[nodes] = False
            self.lifted[nodes] = True
            self.mesh = self.mesh.with_fixed(fixed)
            self._held = ~self.mesh.free[self.mesh.hexes[:, CORNER_TETRAHEDRA]].any(axis=2)
        return nodes.size > 0

    def _begin(self) -> None:
        self._radius, self._most = FIRST, FEW
        self._multipliers: tuple[np.ndarray, np.ndarray] = np.empty(0, np.int64), np.empty(0)

    def _raised(self) -> np.ndarray:
        """The values, +inf of corners that cannot be moved or are settled, (m, 8)."""
        return np.where(self._held | self.settled, np.inf, self.values)

    def _step(
        self, low: np.ndarray, band: float, strayed: np.ndarray | None = None
    ) -> tuple[float, np.ndarray, np.ndarray]:
        """Solve the linear program of the nodes at corners `low`; of those too that have strayed, the least may fall.

        Returns the gain that it promises, all points with these nodes moved and put back, and which these are.
        """
        hexes, radius, least = self.mesh.hexes, self._radius, self.least
        nodes = np.unique(_nodes(hexes, low))
        nodes = nodes[self.mesh.free[nodes] & ~self._stays[nodes]]
        if strayed is not None:
            nodes = np.union1d(nodes, strayed)
        around = np.unique(self.mesh.topology.node_corners.of(nodes) // 8)
        near = (8 * around[:, None] + np.arange(8)).ravel()
        above = self._raised().ravel()[near] - least
        near = near[above < band + FALL * radius]
        ends = _nodes(hexes, near)
        values, derivatives = gradients(self.points, ends)
        size = shortest_edges(self.points, hexes[around])
        models = Models(ends, np.maximum(values - least, 0.0), derivatives, np.ones(near.size))
        if self.sliding is not None and np.isfinite(self.room):
            room = self._room(nodes, size)
            if strayed is None:
                np.maximum(room.above, 0.0, out=room.above)
            models = models.and_those(room)
        ways = self._ways(nodes, size)
        solved = solve(nodes, ways, models, radius, falls=strayed is not None)
        if solved is None:
            return 0.0, self.points, nodes
        self._multipliers = near, solved.multipliers[: near.size]
        points = self.points.copy()
        np.add.at(points, nodes[ways.of], solved.far[:, None] * ways.aims)
        slide = nodes[self._slides(nodes)]
        if slide.size:
            points[slide] = self.sliding.put_back(points[slide], slide)
        if self.sliding is not None:  # off the surface its normals say little
            points = self.sliding.unturned(self.points, points, self.lifted if self.turns else None)
        return solved.gain, points, nodes

    def _slides(self, nodes: np.ndarray) -> np.ndarray:
        """Which of some nodes are put back on the surface wherever they are moved to, bool."""
        if self.sliding is None:
            return np.zeros(nodes.size, dtype=bool)
        return self.sliding.slides(nodes) & ~self.lifted[nodes]

    def _room(self, nodes: np.ndarray, size: np.ndarray) -> Models:
        """What keeps the boundary at nodes in its room."""
        moves = np.zeros(self.mesh.n_nodes)
        moves[nodes] = self._radius * size[nodes]
        return self._apart.bounds(moves, self.room)

    @property
    def _apart(self) -> Apart:
        if self._seen is None or self._seen.points is not self.points:
            self._seen = Apart(self.sliding, self.points)
        return self._seen

    def _leaves(self, points: np.ndarray, nodes: np.ndarray) -> bool:
        """Whether the boundary at nodes has left its room, further than it was."""
        if self.sliding is None or not np.isfinite(self.room):
            return False
        after = self._apart.moved(points, nodes)
        if after.leaves(self._apart, nodes, self.room):
            return True
        self._seen = after
        return False

    def _ways(self, nodes: np.ndarray, size: np.ndarray) -> Ways:
        """Ways of nodes: both senses of each axis; of those that slide on a patch eight around, on a curve two."""
        axes = np.concatenate([np.eye(3), -np.eye(3)])
        slides = self._slides(nodes)
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
            far = np.maximum(self._radius * size[nodes[of_around], None], np.finfo(float).tiny)  # nodes may coincide
            start = self.points[nodes[of_around]]
            led = (self.sliding.put_back(start + far * around, nodes[of_around]) - start) / far
            of, aims, leads = (np.concatenate(both) for both in ((of, of_around), (aims, around), (leads, led)))
        order = np.argsort(of, kind="stable")
        scale = size[nodes[of[order]], None]
        return Ways(of[order], scale * aims[order], scale * leads[order])

    def _limit(self) -> Limit:
        corners, weights = self._multipliers
        order = np.argsort(-weights, kind="stable")
        order = order[weights[order] > HOLDS]
        return Limit(self.least, corners[order] // 8, corners[order] % 8)

    def _take(self, points: np.ndarray, moved: np.ndarray, least: float, promised: float) -> float:
        """Move to `points` if that brings enough, and fit the trust region; returns what was gained."""
        hexes = np.unique(self.mesh.topology.node_corners.of(moved) // 8)
        before, self.values[hexes] = self.values[hexes], scaled_jacobians(points, self.mesh.hexes[hexes])
        gain = self.least - least
        if gain > BRINGS * promised and self._leaves(points, moved):
            gain = -np.inf
        share = gain / promised
        if share > GOOD:
            self._radius = min(GROW * self._radius, LARGEST)
        elif share < POOR:
            self._radius *= SHRINK
        if share > BRINGS:
            self.points = points
            return gain
        self.values[hexes] = before
        return 0.0


def _nodes(hexes: np.ndarray, corners: np.ndarray) -> np.ndarray:
    """Apex and ends of corners, 8 * hex + corner, (k, 4)."""
    return np.take_along_axis(hexes[corners // 8], CORNER_TETRAHEDRA[corners % 8], axis=1)
