"""Claims of where global optimisation fails."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from hexmend.study.claims.claim import Finding, judges, tally
from hexmend.study.claims.reading import arrivals, arrived, end, ended, name, of_mesh, optimisers, tables
from hexmend.study.table_row import Row
from hexmend.study.thesis.experiment_result import ExperimentResult

#: "Several": at least so many.
_SEVERAL = 2

#: What 5.1 names as hard: the largest meshes, a wide range of sizes, heavily inverted elements.
_HARD = "4.3", "4.4", "4.8", "4.9", "4.10", "4.15"


@judges("4.3.1", "On several of the meshes of five-side a global method is not able to converge.")
def several_fail(measured: Sequence[ExperimentResult]) -> Finding:
    """4.3.1: of methods that had as much time as another took to the optimum."""
    found = list(of_mesh(measured, "five-side"))
    judged = [one for one in found if arrivals(one) and optimisers(one, "global-")]
    failures = {
        name(one): [end(row) for row in optimisers(one, "global-") if arrived(one, row) is False] for one in judged
    }
    told = ". ".join(f"{mesh}: {', '.join(ends) or 'none'}" for mesh, ends in failures.items())
    if len(judged) < _SEVERAL:
        return None, f"Fewer than {_SEVERAL} sizes were measured."
    return sum(
        map(bool, failures.values())
    ) >= _SEVERAL, f"Of {len(judged)} there are failures in {_count(failures)}. {told}."


@judges("4.4.1", "On plane global optimisation is not suitable.")
def unsuitable_on_plane(measured: Sequence[ExperimentResult]) -> Finding:
    """4.4.1, Table 4.15: steepest descent and Newton-Raphson fail, from either start, where a local method arrives."""
    cases = []
    for one in of_mesh(measured, "plane"):
        rows = [row for method in ("global-sd", "global-nr") for row in ended(one, method)]
        known = [(row, reached) for row in rows if (reached := arrived(one, row)) is not None]
        if arrivals(one, "local-"):
            cases += [
                (not reached, f"{name(one)}: {end(row)}, {row.after.inverted:,} inverted") for row, reached in known
            ]
    return tally(cases, "On plane no local method converged, or no global one had time enough.")


@judges("5.1", "Global methods are less robust than local ones.")
def less_robust(measured: Sequence[ExperimentResult]) -> Finding:
    """5.1: the share of their runs that arrive at the optimum, of those that had time for it."""
    shares = {scope: [there for *_, there in _runs(measured, scope)] for scope in ("global-", "local-")}
    if not all(shares.values()):
        return None, "No experiment has an optimum that local and global methods had time for."
    told = ", ".join(f"{scope[:-1]} {sum(all_)} of {len(all_)}" for scope, all_ in shares.items())
    everywhere, local = (sum(all_) / len(all_) for all_ in shares.values())
    return everywhere < local, f"Runs that arrive: {told}."


@judges(
    "5.1",
    "Global methods of second order have trouble on larger meshes, with a wide range of element sizes and with heavily "
    "inverted elements.",
)
def practical_issues(measured: Sequence[ExperimentResult]) -> Finding:
    """5.1: the share of Newton's runs that arrive in the tables of such meshes, against that in the others."""
    runs = [(one, row, there) for one, row, there in _runs(measured, "global-") if row.method != "global-sd"]
    hard, easy = ([it for it in runs if (it[0].experiment.table in _HARD) is kind] for kind in (True, False))
    if not hard or not easy:
        return None, "Such meshes and others were not both run with time enough."
    shares = [sum(there for *_, there in some) / len(some) for some in (hard, easy)]
    failed = ", ".join(f"{name(one)} {row.method}" for one, row, there in runs if not there)
    told = f"{shares[0]:.0%} of {len(hard)} runs arrive there, {shares[1]:.0%} of {len(easy)} elsewhere"
    return shares[0] < shares[1], f"{told}. They fail in: {failed or 'none'}."


def _runs(measured: Sequence[ExperimentResult], scope: str) -> Iterator[tuple[ExperimentResult, Row, bool]]:
    """The runs of a scope that arrive or had time to, where any optimiser arrives."""
    for one in tables(measured):
        for row in optimisers(one, scope) if arrivals(one) else ():
            if (reached := arrived(one, row)) is not None:
                yield one, row, reached


def _count(failures: dict[str, list[str]]) -> int:
    return sum(map(bool, failures.values()))
