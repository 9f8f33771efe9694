"""State of a run that ended, which the rules for suggestions examine."""

from __future__ import annotations

from functools import cached_property

import numpy as np

from hexmend.boundary import freed_by_sliding
from hexmend.energy.norm import SQUARES
from hexmend.iteration import Outcome, Result, StoppingCriteria
from hexmend.mesh.mesh import Mesh
from hexmend.quality import ElementQuality, measure, objective
from hexmend.quality.measure import locked_hexes
from hexmend.smoothers import METHODS, Smoother

#: Outcomes of runs that a limit or the user ended.
_CUT_SHORT = frozenset({Outcome.MAX_ITERATIONS, Outcome.MAX_SECONDS, Outcome.STOPPED})

#: Over the last quarter of its iterations a run still gains if the objective's excess over that of cubes falls by more
#: than this share ...
_MIN_RELATIVE_FALL = 1e-3

#: ... or, if the objective is infinite, if the mean quality rises by more than this.
_MIN_RISE = 1e-4


class Situation:
    """A run that ended, with the quality of its mesh.

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
    """

    def __init__(self, result: Result):
        last = result.stages[-1]
        self.result = result
        self.mesh: Mesh = result.mesh
        self.smoother: Smoother = METHODS[last.method](**last.parameters)
        self.stop: StoppingCriteria = last.stop
        self.quality: ElementQuality = measure(self.mesh.points, self.mesh.hexes)
        is_locked = locked_hexes(self.mesh.points, self.mesh.hexes, self.mesh.fixed, self.quality.inverted)
        self.locked = np.flatnonzero(is_locked)
        self.unlocked = np.flatnonzero(self.quality.inverted & ~is_locked)

    @property
    def cut_short(self) -> bool:
        """True if a limit or the user ended the run."""
        return self.result.outcome in _CUT_SHORT

    @property
    def p(self) -> float:
        """The exponent of the objective."""
        return getattr(self.smoother, "p", 2.0)

    @property
    def objective(self) -> dict[str, float]:
        """The method's parameters p and offset of the objective, if it has them."""
        return {name: value for name, value in self.smoother.values().items() if name in ("p", "offset")}

    @property
    def max_p(self) -> float:
        """The highest exponent of the objective during the run."""
        return max(self.p, getattr(self.smoother, "max_p", 1.0))

    @property
    def aim(self) -> str:
        """Name of the figure that an optimiser improves; q_norm if the objective is infinite."""
        if objective(self.quality, *self.smoother.norm) is None:
            return "q_norm"
        return "objective" if self.smoother.norm == SQUARES else "energy"

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
            least = self.smoother.norm.cube_value * self.mesh.n_hexes
            return then["objective"] - now["objective"] > _MIN_RELATIVE_FALL * (then["objective"] - least)
        return now["q_mean"] > then["q_mean"] + _MIN_RISE

    @cached_property
    def worst_can_move(self) -> bool:
        """True if the worst hex that is not inverted has a free node."""
        q = np.where(self.quality.inverted, np.inf, self.quality.q)
        return bool(self.mesh.free[self.mesh.hexes[int(q.argmin())]].any())

    @cached_property
    def freed(self) -> int:
        """Number of the locked hexes that a sliding boundary can free."""
        which = np.zeros(self.mesh.n_hexes, dtype=bool)
        which[self.locked] = True
        return int(np.count_nonzero(freed_by_sliding(self.mesh, which, self.smoother.feature_angle)))

    def pinned_nodes(self, hexes: np.ndarray) -> np.ndarray:
        """Return the nodes of hexes (k,) that only a pin fixes: their numbers in ascending order, (j,) int."""
        if self.mesh.pinned is None:
            return np.zeros(0, dtype=np.int64)
        nodes = np.unique(self.mesh.hexes[hexes])
        return nodes[self.mesh.pinned[nodes] & ~self.mesh.topology.boundary[nodes]]
