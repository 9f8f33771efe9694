"""Claims about local optimisation."""

from __future__ import annotations

from collections.abc import Sequence

from hexmend.study.claims.claim import Finding, claim, tally
from hexmend.study.claims.queries import (
    ending,
    of_mesh,
    optimal_runs,
    published,
    reached_optimum,
    rows_of,
    seconds_of,
    title,
)
from hexmend.study.thesis.experiment_result import ExperimentResult

#: "Reduce the number of iterations": by this share at least. The tolerance of A.1 may be met a sweep earlier or later.
_FEWER = 0.05


@claim("4.3.1", "On five-side local steepest descent is the fastest optimiser to converge, in all cases.")
def local_sd_fastest(results: Sequence[ExperimentResult]) -> Finding:
    """4.3.1, Tables 4.5 to 4.10: judged where it and another arrive."""
    cases = [
        (found[0].method == "local-sd", f"{title(result)}: {seconds_of(found)}")
        for result in of_mesh(results, "five-side")
        if len(found := optimal_runs(result)) > 1 and "local-sd" in {row.method for row in found}
    ]
    return tally(cases, "On five-side local steepest descent and another optimiser did not both converge.")


@claim(
    "5.1", "Single nodes are best smoothed along the steepest descent: a more accurate direction is not worth its time."
)
def local_sd_best_of_local(results: Sequence[ExperimentResult]) -> Finding:
    """5.1, 4.1.3: by the seconds of the local methods, in all experiments in which two of them arrive."""
    cases = [
        (found[0].method == "local-sd", f"{title(result)}: {seconds_of(found)}")
        for result in published(results)
        if len(found := optimal_runs(result, "local-")) > 1 and "local-sd" in {row.method for row in found}
    ]
    return tally(cases, "In no experiment did local steepest descent and another local optimiser converge.")


@claim("4.3.1", "In no local case does a Hessian made positive definite reduce the number of iterations.")
def modified_local(results: Sequence[ExperimentResult]) -> Finding:
    """4.3.1, of which the thesis has no figures: local-mnr against local-nr, where both converged."""
    cases = []
    for result in published(results):
        if rows := rows_of(result, "local-nr", "local-mnr"):
            newton, modified = rows
            if reached_optimum(result, newton) and reached_optimum(result, modified):
                details = f"{title(result)}: {modified.iterations:,} iterations, without {newton.iterations:,}"
                cases.append((modified.iterations > (1 - _FEWER) * newton.iterations, details))
    return tally(cases, "In no experiment did local-nr and local-mnr both converge.")


@claim("4.2.1", "A small delta is no problem for the direct solver of local Newton-Raphson.")
def direct_solver(results: Sequence[ExperimentResult]) -> Finding:
    """4.2.1, Table 4.3: judged from bridge-sharp's start with inverted hexes, at the least delta."""
    found = [result for result in of_mesh(results, "bridge-sharp", "laplacian") if result.experiment.delta is not None]
    for result in sorted(found, key=lambda result: result.experiment.delta):
        if (rows := rows_of(result, "local-nr")) and (reached := reached_optimum(result, rows[0])) is not None:
            left = f"{rows[0].after.inverted:,} of {result.start.inverted:,} inverted hexes left"
            return reached, f"With delta {result.experiment.delta:g} {ending(rows[0])}, {left}."
    return None, "It was not run, or had too little time."
