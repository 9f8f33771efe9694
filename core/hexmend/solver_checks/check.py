"""Declaration of a check, and its result on a mesh."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from enum import Enum

import numpy as np

from hexmend.solver_checks.measures import Measures


class Level(Enum):
    """Consequence of a value beyond a limit: the key of the verdict."""

    ERROR = "failed"
    WARNING = "warning"
    INFORMATION = "value"


@dataclass(frozen=True)
class Check:
    """Check of one quantity against one limit of a solver.

    Parameters
    ----------
    name : str
        Name in the solver's words.
    of : callable
        Computes the values (k,) float64 from the `Measures` of a mesh: one for each face, each hex...
    unit_of_count : str
        What has one value: "faces", "internal faces", "hexes"...
    better : int
        1 if values below the limit are beyond it, -1 if values above are.
    limit : float or None
        None for a value that the solver prints, but does not judge.
    level : Level
        Consequence of a value beyond the limit.
    definition : str
        Formula.
    source : str
        Document or source file of the solver that states the limit.
    inclusive : bool
        A value equal to the limit is beyond it.
    unit : str
        "" for a dimensionless quantity.
    """

    name: str
    of: Callable[[Measures], np.ndarray]
    unit_of_count: str
    better: int
    limit: float | None
    level: Level
    definition: str
    source: str
    inclusive: bool = False
    unit: str = ""

    def on(self, measures: Measures) -> CheckResult:
        """Apply the check to a mesh."""
        values = self.of(measures)
        worst = float(values.min(initial=np.inf) if self.better > 0 else values.max(initial=-np.inf))
        return CheckResult(self, worst, int(np.count_nonzero(self._beyond(values))), values.size)

    @property
    def limit_text(self) -> str:
        """The admitted values, such as "≤ 70"; "–" without a limit."""
        if self.limit is None:
            return "–"
        sign = ("<", "≤") if self.better < 0 else (">", "≥")
        return f"{sign[not self.inclusive]} {self.limit:g}"

    def _beyond(self, values: np.ndarray) -> np.ndarray:
        if self.limit is None:
            return np.zeros(values.shape, dtype=bool)
        good = values > self.limit if self.better > 0 else values < self.limit
        return ~(good if self.inclusive else good | (values == self.limit))


@dataclass(frozen=True)
class CheckResult:
    """Result of a check on a mesh.

    Parameters
    ----------
    check : Check
    value : float
        Worst value; infinite where the mesh has none.
    count : int
        Number of values beyond the limit.
    total : int
        Number of values.
    """

    check: Check
    value: float
    count: int
    total: int

    @property
    def verdict(self) -> str:
        """ "passed", "warning", "failed", or "value" where the solver has no limit."""
        if self.check.limit is None:
            return Level.INFORMATION.value
        return self.check.level.value if self.count else "passed"

    def to_dict(self) -> dict[str, object]:
        """Return the result by names, for JSON; an infinite value is None."""
        check = self.check
        return {
            "name": check.name,
            "value": self.value if math.isfinite(self.value) else None,
            "limit": check.limit,
            "better": {1: "higher", -1: "lower"}[check.better],
            "level": check.level.name.lower(),
            "count": self.count,
            "total": self.total,
            "of": check.unit_of_count,
            "unit": check.unit,
            "verdict": self.verdict,
            "definition": check.definition,
            "source": check.source,
        }
