"""Queries of measured experiments that the claims have in common."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from typing import Any

import numpy as np

from benchmarks.thesis.experiment_result import SAME_OBJECTIVE, ExperimentResult
from hexmend.energy.norm import SQUARES
from hexmend.iteration import Outcome
from hexmend.smoothers import METHODS
from hexmend.study.compare import Row

#: "Far less time" and "slow": at least this factor.
MUCH_SLOWER = 5.0

#: Verbs for outcomes whose key is none.
_ENDS = {
    Outcome.MAX_SECONDS.key: "reached the time limit",
    Outcome.MAX_ITERATIONS.key: "reached the iteration limit",
    Outcome.NO_DESCENT.key: "found no descent",
    Outcome.STOPPED.key: "was stopped",
}

#: Outcomes of runs that had no more time.
_CUT_SHORT = Outcome.MAX_SECONDS.key, Outcome.STOPPED.key


def published(results: Iterable[ExperimentResult]) -> Iterator[ExperimentResult]:
    """Select the experiments for which the thesis has figures; others are run for a single claim."""
    return (result for result in results if any(result.experiment.published.values()))


def of_mesh(results: Iterable[ExperimentResult], mesh: str, start: str | None = None) -> Iterator[ExperimentResult]:
    """Select the published experiments on a gallery mesh, from one start or from any."""
    return (
        result
        for result in published(results)
        if result.experiment.mesh == mesh and start in (None, result.experiment.start)
    )


def rows_of(result: ExperimentResult, *names: str) -> list[Row]:
    """Return the rows of methods; none unless all of them ran."""
    rows = [result.rows[name] for name in names if name in result.rows and result.rows[name].after is not None]
    return rows if len(rows) == len(names) else []


def with_rows(results: Iterable[ExperimentResult], *names: str) -> Iterator[tuple[Any, ...]]:
    """Yield each experiment in which all these methods ran, followed by their rows."""
    return ((result, *rows) for result in results if (rows := rows_of(result, *names)))


def with_optimal(results: Iterable[ExperimentResult], *names: str) -> Iterator[tuple[Any, ...]]:
    """Yield each experiment in which all these methods reached the optimum, followed by their rows."""
    return (one for one in with_rows(results, *names) if all(reached_optimum(one[0], row) for row in one[1:]))


def optimiser_runs(result: ExperimentResult, scope: str = "") -> list[Row]:
    """Return the runs of optimisers, of all or of one scope ("local-", "global-")."""
    rows = (row for row in result.rows.values() if row.method.startswith(scope) and row.after is not None)
    return [row for row in rows if row.method in METHODS and METHODS[row.method].optimises]


def converged_valid(row: Row) -> bool:
    """Return True if a run converged with no hex inverted."""
    return row.outcome == Outcome.CONVERGED.key and row.after.inverted == 0


def objective(row: Row) -> float | None:
    """Return the objective (3.3) with p and offset of the run, at delta = 0; None if a hex is inverted."""
    return row.objective_by(row.norm or SQUARES)


def is_near_best(result: ExperimentResult, row: Row, share: float = SAME_OBJECTIVE) -> bool:
    """Return True if no optimiser of the experiment found an objective that is lower by more than a share."""
    known = [found for other in optimiser_runs(result) if (found := objective(other)) is not None]
    value = objective(row)
    return value is not None and value <= min(known) * (1 + share)


def reached_optimum(result: ExperimentResult, row: Row) -> bool | None:
    """Return True if an optimiser converged to the optimum; None if it had less time than another needed for that."""
    if converged_valid(row) and is_near_best(result, row):
        return True
    if row.outcome in _CUT_SHORT:
        fastest = min((other.seconds for other in optimal_runs(result)), default=np.inf)
        return None if row.seconds < fastest else False
    return False


def optimal_runs(result: ExperimentResult, scope: str = "") -> list[Row]:
    """Return the runs of optimisers that converged to the optimum, the fastest first."""
    rows = (row for row in optimiser_runs(result, scope) if converged_valid(row) and is_near_best(result, row))
    return sorted(rows, key=lambda row: row.seconds)


def converged_runs(result: ExperimentResult) -> list[Row]:
    """Return the optimal runs or, if there are none, other runs that converged, fewest inverted hexes first."""
    elsewhere = [row for row in optimiser_runs(result) if row.outcome == Outcome.CONVERGED.key]
    return optimal_runs(result) or sorted(elsewhere, key=lambda row: row.after.inverted)


def lowest(rows: Iterable[Row]) -> Row | None:
    """Return the row of the lowest objective; None of no rows."""
    return min(rows, key=objective, default=None)


def best_known(results: Sequence[ExperimentResult], result: ExperimentResult) -> Row | None:
    """Return the best run that converged on the mesh of an experiment, in any table and from any start."""
    same = (other for other in of_mesh(results, result.experiment.mesh) if other.initial.hexes == result.initial.hexes)
    return lowest(row for other in same for row in optimal_runs(other))


def max_distance(result: ExperimentResult, a: Row, b: Row) -> float:
    """Return the largest distance of a node in two meshes, in mean edge lengths."""
    return float(np.linalg.norm(a.mesh.points - b.mesh.points, axis=1).max()) / result.mesh.mean_edge_length


def title(result: ExperimentResult) -> str:
    """Return table and mesh of an experiment."""
    return f"{result.experiment.table}, {result.experiment.thesis_mesh}"


def ending(row: Row) -> str:
    """Describe the end of a run."""
    return f"{row.method} {_ENDS.get(row.outcome, row.outcome)} after {row.iterations:,} iterations"


def seconds_of(rows: Iterable[Row]) -> str:
    """List methods with the seconds of their runs."""
    return ", ".join(f"{row.method} {row.seconds:.3g} s" for row in rows)
