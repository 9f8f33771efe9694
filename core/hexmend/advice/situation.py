"""State of a run that ended, which the rules for suggestions examine."""

from __future__ import annotations

from dataclasses import replace
from functools import cached_property

import numpy as np

from hexmend.arrays import mask
from hexmend.boundary import freed_by_sliding
from hexmend.energy.norm import SQUARES
from hexmend.iteration import Result, StoppingCriteria
from hexmend.mesh.mesh import Mesh
from hexmend.mesh.rules.named_sets import nodes_in_set
from hexmend.mesh.rules.resolution import with_rules
from hexmend.mesh.second_order import MID_NODE_WEIGHTS
from hexmend.quality import ElementQuality, measure, objective
from hexmend.quality.measure import locked_hexes
from hexmend.smoothers import METHODS, Smoother

#: Over the last quarter of its iterations a run still gains if the objective's excess over that of cubes falls by more
#: than this share ...
_MIN_RELATIVE_FALL = 1e-3

#: ... or, if the objective is infinite, if the mean quality rises by more than this.
_MIN_RISE = 1e-4


class Situation:
    """A run that ended, with the quality of its mesh.

    Parameters
    ----------
    result : Result
    outside : (n,) bool, optional
        Nodes pinned for this run alone, outside of the part of the mesh to which it was limited.

    Attributes
    ----------
    result : Result
    mesh : Mesh
        The mesh after the run.
    smoother : Smoother
        The method of the last stage.
    stop : StoppingCriteria
        Its limits.
    figures : ElementQuality
    locked, unlocked : (k,) int64
        Numbers, from 0, of the inverted hexes that no move of free nodes can repair, and of the other inverted ones.
    inside : (k,) int64
        Numbers of the hexes that are invalid between corners that are not inverted.
    """

    def __init__(self, result: Result, outside: np.ndarray | None = None):
        last = result.stages[-1]
        self.result = result
        self.mesh: Mesh = result.mesh
        self._outside = np.zeros(self.mesh.n_nodes, dtype=bool) if outside is None else outside
        self.smoother: Smoother = METHODS[last.method](**last.parameters)
        self.stop: StoppingCriteria = last.stop
        self.quality: ElementQuality = measure(self.mesh.points, self.mesh.elements)  # of corners: mid-nodes follow
        is_locked = locked_hexes(self.mesh.points, self.mesh.elements, self.mesh.fixed, self.quality.inverted)
        self.locked = np.flatnonzero(is_locked)
        self.unlocked = np.flatnonzero(self.quality.inverted & ~is_locked)
        self.inside = np.flatnonzero(self.quality.invalid & ~self.quality.inverted)

    @property
    def cut_short(self) -> bool:
        """True if a limit or the user ended the run."""
        return self.result.outcome.is_cut_short

    @property
    def objective(self) -> dict[str, float | str]:
        """The method's parameters goal, and p and offset of the objective, if it has them."""
        return {name: value for name, value in self.smoother.values().items() if name in ("goal", "p", "offset")}

    @property
    def sliding(self) -> dict[str, str]:
        """The parameter that lets the boundary slide, if it slides."""
        return {"boundary": "slide"} if self.smoother.slides else {}

    @property
    def aim(self) -> str:
        """Name of the figure that an optimiser improves; q_norm if the objective is infinite."""
        if objective(self.quality, *self.smoother.norm) is None:
            return "q_norm"
        return "objective" if self.smoother.norm == SQUARES else "energy"

    @property
    def balances(self) -> bool:
        """True if the goal is the best shape in which no figure is lower than at the start."""
        return isinstance(self.smoother, METHODS["mend"]) and self.smoother.balances

    @property
    def at_least_objective(self) -> bool:
        """True if the last iteration had the least objective of all: mend is on its way to the optimum of shape."""
        values = [row["objective"] for row in self.result.history if row["objective"] is not None]
        return bool(values) and self.result.history[-1]["objective"] == min(values)

    @cached_property
    def improving(self) -> bool:
        """True if the last quarter of the last method's iterations still improved the mesh."""
        rows, iterations = self.result.history, self.result.stages[-1].iterations
        then, now = rows[-1 - min(iterations, max(1, iterations // 4))], rows[-1]
        if self.result.kept <= then["iteration"]:
            return False
        if now["inverted"] != then["inverted"]:
            return now["inverted"] < then["inverted"]
        same = now["objective_formula"] == then["objective_formula"]  # else they are of two objectives
        if same and now["objective"] is not None and then["objective"] is not None:
            least = self.smoother.norm.cube_value * self.mesh.n_elements
            return then["objective"] - now["objective"] > _MIN_RELATIVE_FALL * (then["objective"] - least)
        return now["q_mean"] > then["q_mean"] + _MIN_RISE

    @cached_property
    def worst_can_move(self) -> bool:
        """True if the worst hex that is not inverted has a free node."""
        q = np.where(self.quality.inverted, np.inf, self.quality.q)
        return bool(self.mesh.free[self.mesh.elements[int(q.argmin())]].any())

    @cached_property
    def freed(self) -> int:
        """Number of the locked hexes that a sliding boundary can free."""
        which = mask(self.locked, self.mesh.n_elements)
        return int(np.count_nonzero(freed_by_sliding(self.mesh, which, self.smoother.feature_angle)))

    @property
    def slidable_nodes(self) -> int:
        """Number of the fixed nodes of invalid hexes that are not locked, and that move if the boundary slides."""
        fixed = np.unique(self.mesh.elements[np.concatenate([self.unlocked, self.inside])])
        fixed = fixed[(self.mesh.fixed & ~self.mesh.immovable)[fixed]]
        return fixed.size

    @property
    def resisting(self) -> np.ndarray:
        """Inverted hexes that released nodes may free, (k,): the locked ones, and those that Mend left at its end."""
        left = self.unlocked if isinstance(self.smoother, METHODS["mend"]) and not self.cut_short else self.unlocked[:0]
        return np.concatenate([self.locked, left])

    @cached_property
    def pinned_nodes(self) -> np.ndarray:
        """Pins without which nodes of resisting hexes can move: their numbers in ascending order, (j,) int.

        They are pins of these nodes, and of nodes of higher order that would move with them.
        """
        mesh = self.mesh
        if mesh.pinned is None:
            return np.zeros(0, dtype=np.int64)
        pinned, nodes = mesh.pinned & ~self._outside, np.unique(mesh.elements[self.resisting])
        released = mesh.replace(pinned=mesh.pinned & self._outside).free & ~mesh.free
        nodes = nodes[released[nodes]]
        pins = nodes[pinned[nodes]]
        moves = mask(nodes, mesh.n_nodes)
        mid_nodes = mesh.middles[moves[mesh.middles[:, 1:]].any(axis=1), 0]
        if mesh.mid_nodes is not None:
            moving = moves[mesh.hexes] @ (MID_NODE_WEIGHTS > 0).T
            mid_nodes = np.append(mid_nodes, mesh.mid_nodes[moving & (mesh.mid_nodes >= 0)])
        return np.union1d(pins, mid_nodes[pinned[mid_nodes]])

    @cached_property
    def outside_nodes(self) -> np.ndarray:
        """Nodes of resisting hexes that are free but for the part to which the run was limited, (j,) int."""
        nodes = np.unique(self.mesh.elements[self.resisting])
        nodes = nodes[self._outside[nodes]]
        pinned = None if self.mesh.pinned is None else self.mesh.pinned & ~self._outside
        return nodes[self._movable(self.mesh.replace(pinned=pinned))[nodes]]

    @cached_property
    def fixing_sets(self) -> tuple[str, ...]:
        """Names of the sets that a rule fixes, and without which nodes of resisting hexes can move."""
        rules, found = self.mesh.node_rules.rules, []
        if not rules.fix or not self.resisting.size:
            return ()
        nodes = np.unique(self.mesh.elements[self.resisting])
        without = self._movable(with_rules(self.mesh, replace(rules, fix=())))
        released = nodes[(without & ~self._movable(self.mesh) & ~self._outside)[nodes]]
        for name in rules.fix:
            if np.isin(nodes_in_set(self.mesh, name), released).any():
                found.append(name)
        return tuple(found)

    @property
    def can_release(self) -> bool:
        """True if resisting hexes have nodes that a pin, a rule or the part of the run fixes."""
        return bool(self.pinned_nodes.size or self.fixing_sets or self.outside_nodes.size)

    def _movable(self, mesh: Mesh) -> np.ndarray:
        """Mark the nodes of a mesh that are free, and those of its boundary that slide, (n,) bool."""
        sliding = mesh.topology.boundary & ~mesh.immovable
        return mesh.free | sliding if self.smoother.slides else mesh.free
