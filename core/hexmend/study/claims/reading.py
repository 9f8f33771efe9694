"""What claims ask of the runs that were measured."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence

import numpy as np

from hexmend.energy.norm import SQUARES
from hexmend.iteration import Outcome
from hexmend.smoothers import METHODS
from hexmend.study.table_row import Row
from hexmend.study.thesis.experiment_result import ExperimentResult

#: Objectives that differ by less than this share are one optimum's: what the tolerance of A.1 leaves open.
SAME = 1e-3

#: "Far less time" and "slow": by this factor at least.
FAR = 5.0

#: How a run ended, where the outcome's key is no verb.
_ENDS = {
    Outcome.MAX_SECONDS.key: "reached the time limit",
    Outcome.MAX_ITERATIONS.key: "reached the iteration limit",
    Outcome.NO_DESCENT.key: "found no descent",
    Outcome.STOPPED.key: "was stopped",
}

#: How a run ends that was given no more time.
_CUT_SHORT = Outcome.MAX_SECONDS.key, Outcome.STOPPED.key


def tables(measured: Iterable[ExperimentResult]) -> Iterator[ExperimentResult]:
    """The experiments that the thesis has figures of: others are runs made for one claim alone."""
    return (one for one in measured if any(one.experiment.published.values()))


def of_mesh(measured: Iterable[ExperimentResult], mesh: str, start: str | None = None) -> Iterator[ExperimentResult]:
    """Those on a mesh of the gallery, from one start or from any."""
    return (one for one in tables(measured) if one.experiment.mesh == mesh and start in (None, one.experiment.start))


def ended(one: ExperimentResult, *names: str) -> list[Row]:
    """The rows of these methods, or none unless all of them ran."""
    rows = [one.rows[name] for name in names if name in one.rows and one.rows[name].after is not None]
    return rows if len(rows) == len(names) else []


def optimisers(one: ExperimentResult, scope: str = "") -> list[Row]:
    """The runs of optimisers, of those in one scope ("local-", "global-")."""
    rows = (row for row in one.rows.values() if row.method.startswith(scope) and row.after is not None)
    return [row for row in rows if row.method in METHODS and METHODS[row.method].optimises]


def optimised(row: Row) -> bool:
    """Whether a run of an optimiser converged, with no hex inverted."""
    return row.outcome == Outcome.CONVERGED.key and row.after.inverted == 0


def objective(row: Row) -> float | None:
    """What an optimiser minimises, with p and offset of its run, at delta = 0; None while a hex is inverted."""
    return row.objective_by(row.power or SQUARES)


def near_best(one: ExperimentResult, row: Row, share: float = SAME) -> bool:
    """Whether no optimiser of the experiment found an objective that is better by more than a share."""
    known = [found for other in optimisers(one) if (found := objective(other)) is not None]
    mine = objective(row)
    return mine is not None and mine <= min(known) * (1 + share)


def arrived(one: ExperimentResult, row: Row) -> bool | None:
    """Whether an optimiser converged on the optimum; None where it had less time than another took to get there."""
    if optimised(row) and near_best(one, row):
        return True
    if row.outcome in _CUT_SHORT:
        quickest = min((other.seconds for other in arrivals(one)), default=np.inf)
        return None if row.seconds < quickest else False
    return False


def arrivals(one: ExperimentResult, scope: str = "") -> list[Row]:
    """The runs of optimisers that converged on the optimum, the quickest first."""
    rows = (row for row in optimisers(one, scope) if optimised(row) and near_best(one, row))
    return sorted(rows, key=lambda row: row.seconds)


def settled(one: ExperimentResult) -> list[Row]:
    """The arrivals; where there are none, runs that converged elsewhere, that with the fewest inverted hexes first."""
    elsewhere = [row for row in optimisers(one) if row.outcome == Outcome.CONVERGED.key]
    return arrivals(one) or sorted(elsewhere, key=lambda row: row.after.inverted)


def best(rows: Iterable[Row]) -> Row | None:
    """The row of the lowest objective."""
    return min(rows, key=objective, default=None)


def optimum(measured: Sequence[ExperimentResult], one: ExperimentResult) -> Row | None:
    """The best run that converged on the mesh of an experiment, whichever table it is in and whatever its start."""
    same = (other for other in of_mesh(measured, one.experiment.mesh) if other.initial.hexes == one.initial.hexes)
    return best(row for other in same for row in arrivals(other))


def apart(one: ExperimentResult, a: Row, b: Row) -> float:
    """Most by which two meshes differ in a node's place, in mean edge lengths."""
    return float(np.linalg.norm(a.mesh.points - b.mesh.points, axis=1).max()) / one.mesh.mean_edge_length


def name(one: ExperimentResult) -> str:
    """The experiment, in words."""
    return f"{one.experiment.table}, {one.experiment.thesis_mesh}"


def end(row: Row) -> str:
    """How a run ended, in words."""
    return f"{row.method} {_ENDS.get(row.outcome, row.outcome)} after {row.iterations:,} iterations"


def times(rows: Iterable[Row]) -> str:
    """Seconds of runs, in words."""
    return ", ".join(f"{row.method} {row.seconds:.3g} s" for row in rows)
