"""What is known of a run that ended: what every rule looks at."""

from __future__ import annotations

from functools import cached_property

import numpy as np

from hexmend.boundary import freed_by_sliding
from hexmend.boundary.features import FEATURE_ANGLE
from hexmend.energy.norm import SQUARES
from hexmend.iteration import Outcome, Result, StoppingCriteria
from hexmend.mesh.mesh import Mesh
from hexmend.quality import ElementQuality, measure, objective
from hexmend.quality.measure import locked
from hexmend.smoothers import METHODS, Smoother

#: Outcomes of a run that did not end by itself.
CUT_SHORT = frozenset({Outcome.MAX_ITERATIONS, Outcome.MAX_SECONDS, Outcome.STOPPED})

#: What a figure must gain over the last quarter of the iterations to be still on its way: a share of what the objective
#: is above that of cubes, or of the mean quality.
_FALLING, _RISING = 1e-3, 1e-4


class Situation:
    """A run that ended, with the figures of its mesh.

    Attributes
    ----------
    result : Result
    mesh : Mesh
        As the run left it.
    smoother : Smoother
        The method that was at work at the end.
    stop : StoppingCriteria
        Its limits.
    figures : ElementQuality
    locked, loose : (k,) int64
        Numbers of the inverted hexes that fixed nodes hold in inversion, and of the other inverted ones.
    """

    def __init__(self, result: Result):
        last = result.stages[-1]
        self.result = result
        self.mesh: Mesh = result.mesh
        self.smoother: Smoother = METHODS[last.method](**last.parameters)
        self.stop: StoppingCriteria = last.stop
        self.figures: ElementQuality = measure(self.mesh.points, self.mesh.hexes)
        held = locked(self.mesh.points, self.mesh.hexes, self.mesh.fixed, self.figures.inverted)
        self.locked = np.flatnonzero(held)
        self.loose = np.flatnonzero(self.figures.inverted & ~held)

    @property
    def cut_short(self) -> bool:
        """Whether it ended by a limit or by the user."""
        return self.result.outcome in CUT_SHORT

    @property
    def p(self) -> float:
        """The exponent of the objective."""
        return getattr(self.smoother, "p", 2.0)

    @property
    def objective(self) -> dict[str, float]:
        """p and offset of the objective, as far as the method has them."""
        return {name: value for name, value in self.smoother.values().items() if name in ("p", "offset")}

    @property
    def max_p(self) -> float:
        """The exponent that it was raised to."""
        return max(self.p, getattr(self.smoother, "max_p", 1.0))

    @property
    def aim(self) -> str:
        """What an optimiser betters: the objective with its p and offset, or, where that is infinite, q_norm."""
        if objective(self.figures, *self.smoother.power) is None:
            return "q_norm"
        return "objective" if self.smoother.power == SQUARES else "energy"

    @cached_property
    def improving(self) -> bool:
        """Whether the last quarter of the last method's iterations still gained."""
        rows, iterations = self.result.history, self.result.stages[-1].iterations
        then, now = rows[-1 - min(iterations, max(1, iterations // 4))], rows[-1]
        if self.result.kept <= then["iteration"]:
            return False
        if now["inverted"] != then["inverted"]:
            return now["inverted"] < then["inverted"]
        same = now["objective_formula"] == then["objective_formula"]  # a stage's first step is from another's objective
        if same and now["objective"] is not None and then["objective"] is not None:
            least = self.smoother.power.least * self.mesh.n_hexes
            return then["objective"] - now["objective"] > _FALLING * (then["objective"] - least)
        return now["q_mean"] > then["q_mean"] + _RISING

    @cached_property
    def worst_can_move(self) -> bool:
        """Whether the worst hex that is not locked has a free node."""
        q = np.where(self.figures.inverted, np.inf, self.figures.q)
        return bool(self.mesh.free[self.mesh.hexes[int(q.argmin())]].any())

    @cached_property
    def freed(self) -> int:
        """How many of the locked hexes can be freed where the boundary slides."""
        which = np.zeros(self.mesh.n_hexes, dtype=bool)
        which[self.locked] = True
        degrees = self.smoother.values().get("feature_angle", FEATURE_ANGLE)
        return int(np.count_nonzero(freed_by_sliding(self.mesh, which, degrees)))

    def pins_of(self, hexes: np.ndarray) -> np.ndarray:
        """Numbers of the nodes of hexes (k,) that are fixed by nothing but a pin, ascending, (j,) int."""
        if self.mesh.pinned is None:
            return np.zeros(0, dtype=np.int64)
        nodes = np.unique(self.mesh.hexes[hexes])
        return nodes[self.mesh.pinned[nodes] & ~self.mesh.topology.boundary[nodes]]
