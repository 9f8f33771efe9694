"""Claims about failures of global optimisation."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from benchmarks.thesis.claims.claim import Finding, claim, tally
from benchmarks.thesis.claims.queries import (
    ending,
    of_mesh,
    optimal_runs,
    optimiser_runs,
    published,
    reached_optimum,
    rows_of,
    title,
)
from benchmarks.thesis.experiment_result import ExperimentResult
from hexmend.study.compare import Row

#: "Several": at least this many.
_SEVERAL = 2

#: Tables of the meshes that 5.1 calls hard: the largest meshes, a wide range of sizes, heavily inverted elements.
_HARD = "4.3", "4.4", "4.8", "4.9", "4.10", "4.15"


@claim("4.3.1", "On several of the meshes of five-side a global method is not able to converge.")
def several_fail(results: Sequence[ExperimentResult]) -> Finding:
    """4.3.1: of methods that had as much time as another took to the optimum."""
    found = list(of_mesh(results, "five-side"))
    judged = [result for result in found if optimal_runs(result) and optimiser_runs(result, "global-")]
    failures: dict[str, list[str]] = {}
    for result in judged:
        failed = (row for row in optimiser_runs(result, "global-") if reached_optimum(result, row) is False)
        failures[title(result)] = list(map(ending, failed))
    details = ". ".join(f"{mesh}: {', '.join(ends) or 'none'}" for mesh, ends in failures.items())
    if len(judged) < _SEVERAL:
        return None, f"Fewer than {_SEVERAL} sizes were measured."
    count = sum(map(bool, failures.values()))
    return count >= _SEVERAL, f"Of {len(judged)} there are failures in {count}. {details}."


@claim("4.4.1", "On plane global optimisation is not suitable.")
def unsuitable_on_plane(results: Sequence[ExperimentResult]) -> Finding:
    """4.4.1, Table 4.15: steepest descent and Newton-Raphson fail, from either start, where a local method arrives."""
    cases = []
    for result in of_mesh(results, "plane"):
        rows = [row for method in ("global-sd", "global-nr") for row in rows_of(result, method)]
        for row in rows if optimal_runs(result, "local-") else ():
            if (reached := reached_optimum(result, row)) is not None:
                details = f"{title(result)}: {ending(row)}, {row.after.inverted:,} inverted"
                cases.append((not reached, details))
    return tally(cases, "On plane no local method converged, or no global one had time enough.")


@claim("5.1", "Global methods are less robust than local ones.")
def less_robust(results: Sequence[ExperimentResult]) -> Finding:
    """5.1: by the share of their runs that reach the optimum, of the runs that had time for it."""
    shares = {scope: [reached for *_, reached in _runs(results, scope)] for scope in ("global-", "local-")}
    if not all(shares.values()):
        return None, "No experiment has an optimum that local and global methods had time for."
    details = ", ".join(f"{scope[:-1]} {sum(runs)} of {len(runs)}" for scope, runs in shares.items())
    global_, local = (sum(runs) / len(runs) for runs in shares.values())
    return global_ < local, f"Runs that arrive: {details}."


@claim(
    "5.1",
    "Global methods of second order have trouble on larger meshes, with a wide range of element sizes and with heavily "
    "inverted elements.",
)
def practical_issues(results: Sequence[ExperimentResult]) -> Finding:
    """5.1: by the share of Newton runs that reach the optimum, in the tables of such meshes and in others."""
    runs = [(result, row, reached) for result, row, reached in _runs(results, "global-") if row.method != "global-sd"]
    hard, easy = ([run for run in runs if (run[0].experiment.table in _HARD) is value] for value in (True, False))
    if not hard or not easy:
        return None, "Such meshes and others were not both run with time enough."
    shares = [sum(reached for *_, reached in group) / len(group) for group in (hard, easy)]
    failed = ", ".join(f"{title(result)} {row.method}" for result, row, reached in runs if not reached)
    details = f"{shares[0]:.0%} of {len(hard)} runs arrive there, {shares[1]:.0%} of {len(easy)} elsewhere"
    return shares[0] < shares[1], f"{details}. They fail in: {failed or 'none'}."


def _runs(results: Sequence[ExperimentResult], scope: str) -> Iterator[tuple[ExperimentResult, Row, bool]]:
    """List the runs of a scope that had time for the optimum, True if they reach it, where any optimiser does."""
    for result in published(results):
        for row in optimiser_runs(result, scope) if optimal_runs(result) else ():
            if (reached := reached_optimum(result, row)) is not None:
                yield result, row, reached
