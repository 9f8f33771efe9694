"""Claims about delta (3.2)."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from benchmarks.thesis.claims.claim import Finding, claim, tally
from benchmarks.thesis.claims.queries import (
    converged_valid,
    ending,
    of_mesh,
    optimiser_runs,
    reached_optimum,
    with_rows,
)
from benchmarks.thesis.experiment_result import ExperimentResult
from benchmarks.thesis.experiments import INITIAL
from hexmend.iteration import Outcome
from hexmend.study.compare import Row

_LOCAL = "local-sd", "local-nr"


@claim(
    "4.2.1", "A small delta keeps global methods with a Hessian from converging where a larger one lets them converge."
)
def small_delta_harms(results: Sequence[ExperimentResult]) -> Finding:
    """4.2.1, Tables 4.3 and 4.4: of each method that ran with both, and had time enough with the larger one.

    A run that stands still with hexes inverted has not converged to what it is asked for.
    """
    details, harmed = [], []
    for method in ("global-nr", "global-mnr"):
        rows, text = _by_delta(results, method)
        details.append(text)
        if rows and rows[-1].outcome != Outcome.MAX_SECONDS.key:
            ends = [converged_valid(row) for row in rows]
            harmed.append(ends[-1] and not ends[0])
    return all(harmed) if harmed else None, " ".join(details)


@claim("4.2.1", "A small delta is no problem for the direct solver of local Newton-Raphson.")
def direct_solver(results: Sequence[ExperimentResult]) -> Finding:
    """4.2.1, Table 4.3: judged from bridge-sharp's start with inverted hexes, at the least delta."""
    found = [result for result in of_mesh(results, "bridge-sharp", "laplacian") if result.experiment.delta is not None]
    for result, row in with_rows(sorted(found, key=lambda result: result.experiment.delta), "local-nr"):
        if (reached := reached_optimum(result, row)) is not None:
            left = f"{row.after.inverted:,} of {result.start.inverted:,} inverted hexes left"
            return reached, f"With delta {result.experiment.delta:g} {ending(row)}, {left}."
    return None, "It was not run, or had too little time."


@claim("4.2.1", "A large delta moves the optimum so far that an optimiser may converge and leave hexes inverted.")
def large_delta_moves(results: Sequence[ExperimentResult]) -> Finding:
    """4.2.1: of all methods of Table 4.4, those that converge."""
    return _left_inverted(results, (*_LOCAL, "global-nr"))


@claim("4.2.1", "With the delta of 0.2 in Table 4.4 it is the local methods that converge and leave hexes inverted.")
def large_delta_local(results: Sequence[ExperimentResult]) -> Finding:
    """4.2.1: of the local methods of Table 4.4, those that converge."""
    return _left_inverted(results, _LOCAL)


@claim("4.2.1", "On a mesh without inverted hexes delta has no effect.")
def delta_idle(results: Sequence[ExperimentResult]) -> Finding:
    """4.2.1 of Tables 4.1 and 4.2: judged by the runs of two deltas from one valid start, which must be equal."""
    cases, known = [], dict[Any, Any]()
    for result in results:
        valid = result.experiment.start == INITIAL and result.start.inverted == 0
        for row in optimiser_runs(result) if valid else ():
            key = row.method, result.experiment.mesh, result.initial.hexes
            delta, first = known.setdefault(key, (result.experiment.delta, row))
            if delta != result.experiment.delta:
                same = (first.iterations, first.after) == (row.iterations, row.after)
                ends = "the same" if same else f"{ending(first)}, {ending(row)}"
                cases.append((same, f"{row.method} with delta {delta:g} and {result.experiment.delta:g}: {ends}"))
    return tally(cases, "No method ran with two values of delta from one valid start.")


def _left_inverted(results: Sequence[ExperimentResult], methods: Sequence[str]) -> Finding:
    details, inverted = [], []
    for method in methods:
        rows, text = _by_delta(results, method)
        details.append(text)
        if rows and rows[-1].outcome == Outcome.CONVERGED.key:
            inverted.append(rows[-1].after.inverted > 0)
    return any(inverted) if inverted else None, " ".join(details)


def _by_delta(results: Sequence[ExperimentResult], method: str) -> tuple[list[Row], str]:
    """Return the rows of a method on bridge-sharp after Laplacian smoothing by rising delta, and describe them."""
    start = of_mesh(results, "bridge-sharp", "laplacian")
    found = {result.experiment.delta: row for result, row in with_rows(start, method)}
    if len(found) < 2:
        return [], f"Of {method} there is no pair of runs with two values of delta."
    ends = (f"delta {delta:g}: {ending(row)}, {row.after.inverted:,} inverted" for delta, row in sorted(found.items()))
    return [found[delta] for delta in sorted(found)], f"With {'; '.join(ends)}."
