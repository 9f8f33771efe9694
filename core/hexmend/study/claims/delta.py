"""Claims of delta, (3.2)."""

from __future__ import annotations

from collections.abc import Sequence

from hexmend.iteration import Outcome
from hexmend.study.claims.claim import Finding, judges, tally
from hexmend.study.claims.reading import end, ended, of_mesh, optimisers
from hexmend.study.table_row import Row
from hexmend.study.thesis.experiment_result import ExperimentResult
from hexmend.study.thesis.experiments import INITIAL

_LOCAL = "local-sd", "local-nr"


@judges(
    "4.2.1", "A small delta keeps global methods with a Hessian from converging where a larger one lets them converge."
)
def small_delta_harms(measured: Sequence[ExperimentResult]) -> Finding:
    """4.2.1, Tables 4.3 and 4.4: judged on equal limits, of each method that ran with both."""
    told, harmed = [], []
    for method in ("global-nr", "global-mnr"):
        rows, words = _by_delta(measured, method)
        told.append(words)
        if rows:
            ends = [row.outcome == Outcome.CONVERGED.key for row in rows]
            harmed.append(ends[-1] and not ends[0])
    return all(harmed) if harmed else None, " ".join(told)


@judges("4.2.1", "A large delta moves the optimum so far that an optimiser may converge and leave hexes inverted.")
def large_delta_moves(measured: Sequence[ExperimentResult]) -> Finding:
    """4.2.1: of all methods of Table 4.4, those that converge."""
    return _left_inverted(measured, (*_LOCAL, "global-nr"))


@judges("4.2.1", "With the delta of 0.2 in Table 4.4 it is the local methods that converge and leave hexes inverted.")
def large_delta_local(measured: Sequence[ExperimentResult]) -> Finding:
    """4.2.1: of the local methods of Table 4.4, those that converge."""
    return _left_inverted(measured, _LOCAL)


@judges("4.2.1", "On a mesh without inverted hexes delta has no effect.")
def delta_idle(measured: Sequence[ExperimentResult]) -> Finding:
    """4.2.1 of Tables 4.1 and 4.2: judged by the runs of two deltas from one valid start, which must be equal."""
    cases, known = [], {}
    for one in measured:
        valid = one.experiment.start == INITIAL and one.start.inverted == 0
        for row in optimisers(one) if valid else ():
            key = row.method, one.experiment.mesh, one.initial.hexes
            delta, first = known.setdefault(key, (one.experiment.delta, row))
            if delta != one.experiment.delta:
                same = (first.iterations, first.after) == (row.iterations, row.after)
                told = f"{row.method} with delta {delta:g} and {one.experiment.delta:g}: "
                told += "the same" if same else f"{end(first)}, {end(row)}"
                cases.append((same, told))
    return tally(cases, "No method ran with two values of delta from one valid start.")


def _left_inverted(measured: Sequence[ExperimentResult], methods: Sequence[str]) -> Finding:
    told, left = [], []
    for method in methods:
        rows, words = _by_delta(measured, method)
        told.append(words)
        if rows and rows[-1].outcome == Outcome.CONVERGED.key:
            left.append(rows[-1].after.inverted > 0)
    return any(left) if left else None, " ".join(told)


def _by_delta(measured: Sequence[ExperimentResult], method: str) -> tuple[list[Row], str]:
    """What a method made of bridge-sharp after Laplacian smoothing, by rising delta, and that in words."""
    found = {
        one.experiment.delta: one.rows[method]
        for one in of_mesh(measured, "bridge-sharp", "laplacian")
        if ended(one, method)
    }
    told = "; ".join(
        f"delta {delta:g}: {end(row)}, {row.after.inverted:,} inverted" for delta, row in sorted(found.items())
    )
    if len(found) < 2:
        return [], f"Of {method} there is no pair of runs with two values of delta."
    return [found[delta] for delta in sorted(found)], f"With {told}."
