"""Claims about local optimisation."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from benchmarks.thesis.claims.claim import Finding, claim, tally
from benchmarks.thesis.claims.queries import of_mesh, optimal_runs, published, seconds_of, title, with_optimal
from benchmarks.thesis.experiment_result import ExperimentResult

#: "Reduce the number of iterations": by this share at least. The tolerance of A.1 may be met a sweep earlier or later.
_FEWER = 0.05


@claim("4.3.1", "On five-side local steepest descent is the fastest optimiser to converge, in all cases.")
def local_sd_fastest(results: Sequence[ExperimentResult]) -> Finding:
    """4.3.1, Tables 4.5 to 4.10: judged where it and another arrive."""
    cases = _descent_first(of_mesh(results, "five-side"))
    return tally(cases, "On five-side local steepest descent and another optimiser did not both converge.")


@claim(
    "5.1", "Single nodes are best smoothed along the steepest descent: a more accurate direction is not worth its time."
)
def local_sd_best_of_local(results: Sequence[ExperimentResult]) -> Finding:
    """5.1, 4.1.3: by the seconds of the local methods, in all experiments in which two of them arrive."""
    cases = _descent_first(published(results), "local-")
    return tally(cases, "In no experiment did local steepest descent and another local optimiser converge.")


def _descent_first(results: Iterable[ExperimentResult], scope: str = "") -> list[tuple[bool, str]]:
    """Compare the seconds of local steepest descent with those of the other optimisers of a scope that arrive."""
    return [
        (found[0].method == "local-sd", f"{title(result)}: {seconds_of(found)}")
        for result in results
        if len(found := optimal_runs(result, scope)) > 1 and "local-sd" in {row.method for row in found}
    ]


@claim("4.3.1", "In no local case does a Hessian made positive definite reduce the number of iterations.")
def modified_local(results: Sequence[ExperimentResult]) -> Finding:
    """4.3.1, of which the thesis has no figures: local-mnr against local-nr, where both converged."""
    cases = []
    for result, newton, modified in with_optimal(published(results), "local-nr", "local-mnr"):
        details = f"{title(result)}: {modified.iterations:,} iterations, without {newton.iterations:,}"
        cases.append((modified.iterations > (1 - _FEWER) * newton.iterations, details))
    return tally(cases, "In no experiment did local-nr and local-mnr both converge.")
