"""Claims about the optimum: whether methods reach the same one, and its quality."""

from __future__ import annotations

import itertools
from collections.abc import Sequence

import numpy as np

from benchmarks.thesis.claims.claim import Finding, claim, tally
from benchmarks.thesis.claims.queries import (
    SAME_OBJECTIVE,
    best_known,
    converged_runs,
    converged_valid,
    lowest,
    max_distance,
    objective,
    of_mesh,
    optimal_runs,
    optimiser_runs,
    published,
    rows_of,
    title,
    with_rows,
)
from benchmarks.thesis.experiment_result import ExperimentResult

#: Tolerance of q min and q mean of one optimum; those of the thesis in Table 4.15 differ by 0.0035 at most.
_SAME_QUALITY = 0.005


@claim("5.1, C", "Local and global optimisation reach the same optimum.")
def same_optimum(results: Sequence[ExperimentResult]) -> Finding:
    """5.1, Appendix C: "several examples", judged where local and global methods converged from a valid start."""
    return _same_optimum(results, inverted=False)


@claim("5.1", "Local and global optimisation reach the same optimum where they have to untangle the mesh first, too.")
def same_optimum_untangled(results: Sequence[ExperimentResult]) -> Finding:
    """5.1, "untangling and smoothing": judged where both converged from a start with inverted hexes."""
    return _same_optimum(results, inverted=True)


def _same_optimum(results: Sequence[ExperimentResult], inverted: bool) -> Finding:
    cases = []
    for result in published(results):
        local, global_ = (
            lowest(row for row in optimiser_runs(result, scope) if converged_valid(row))
            for scope in ("local-", "global-")
        )
        if (result.start.inverted > 0) is inverted and local and global_:
            a, b = objective(local), objective(global_)
            details = (
                f"{title(result)}: objective {a:.7g} by {local.method}, {b:.7g} by {global_.method}, nodes at most "
                f"{max_distance(result, local, global_):.1g} mean edge lengths from each other"
            )
            cases.append((abs(a - b) < SAME_OBJECTIVE * min(a, b), details))
    start = "start with inverted hexes" if inverted else "valid start"
    return tally(cases, f"From no {start} did local and global methods converge.", most=True)


@claim("4.1.1", "Where no hex is inverted, q norm is equivalent to the global objective.")
def norm_is_objective(results: Sequence[ExperimentResult]) -> Finding:
    """4.1.1: judged by the order of runs, because q norm is made of q of hexes and (3.3) of q of tetrahedra."""
    cases = []
    for result in published(results):
        rows = [row for row in optimiser_runs(result) if objective(row) is not None]
        pairs = [
            (a, b)
            for a, b in itertools.permutations(rows, 2)
            if objective(a) < objective(b) * (1 - SAME_OBJECTIVE) and a.after.q_norm != b.after.q_norm
        ]
        wrong = [f"{a.method} before {b.method}" for a, b in pairs if a.after.q_norm < b.after.q_norm]
        if pairs:
            details = f"by the objective, not by q norm, {', '.join(wrong)}" if wrong else "the same order"
            cases.append((not wrong, f"{title(result)}: {details}"))
    return tally(cases, "In no experiment did two optimisers end at objectives that differ.")


@claim("4.4", "On plane all optimisers that converge generate the same final quality.")
def one_quality(results: Sequence[ExperimentResult]) -> Finding:
    """4.4."""
    cases = []
    for result in of_mesh(results, "plane"):
        rows = converged_runs(result)
        if len(rows) > 1:
            least, mean = (np.ptp([getattr(row.after, key) for row in rows]) for key in ("q_min", "q_mean"))
            spans = f"q min of {len(rows)} methods within {least:.4f} and q mean within {mean:.4f}"
            details = f"{title(result)}: {spans} (the same is taken as {_SAME_QUALITY:g})"
            cases.append((bool(max(least, mean) <= _SAME_QUALITY), details))
    return tally(cases, "On plane fewer than two optimisers converged.")


@claim("4.4.1", "On plane optimisation ends at a higher quality, least and mean, than any other method.")
def optimum_is_best(results: Sequence[ExperimentResult]) -> Finding:
    """4.4.1, Table 4.14."""
    for result, *rows in with_rows(of_mesh(results, "plane", "initial"), "laplacian", "getme"):
        if found := converged_runs(result):
            top = found[0]
            others = {"initial": result.initial} | {row.method: row.after for row in rows}
            details = "; ".join(f"{name} {row.q_min:.4f}, {row.q_mean:.4f}" for name, row in others.items())
            higher = all(row.q_min < top.after.q_min and row.q_mean < top.after.q_mean for row in others.values())
            mine = f"{top.method} {top.after.q_min:.4f}, {top.after.q_mean:.4f} ({top.after.inverted:,} inverted)"
            return higher, f"q min and q mean: {mine}; {details}."
    return None, "The heuristics and an optimiser that converges were not all run on plane."


@claim(
    "Table 4.8",
    "Global steepest descent ends FiveSide60k at a higher least quality than any other method, and at a worse "
    "objective: its q norm is below theirs.",
)
def better_minimum(results: Sequence[ExperimentResult]) -> Finding:
    """The remark below Table 4.8."""
    for result, stuck in with_rows(published(results), "global-sd"):
        if result.experiment.table == "4.8" and (others := optimal_runs(result)):
            runs = (f"{row.method} {row.after.q_min:.4f}, {row.after.q_norm:.4f}" for row in [stuck, *others])
            holds = all(  # not of itself, if it is among them
                row.after.q_min < stuck.after.q_min and row.after.q_norm > stuck.after.q_norm for row in others
            )
            return holds, f"q min and q norm: {'; '.join(runs)}."
    return None, "Table 4.8 was not run, or nothing in it converged."


@claim("5.1", "Heuristic methods do not end at optimal places of the nodes.")
def heuristics_not_optimal(results: Sequence[ExperimentResult]) -> Finding:
    """5.1: judged by q norm, against the optimum of the same mesh in any table."""
    cases = {}
    for result in published(results):
        top = best_known(results, result)
        for row in (row for method in ("laplacian", "getme") for row in rows_of(result, method)):
            if top is not None:
                name, hexes = result.experiment.mesh, result.initial.hexes
                own, best = row.after.q_norm, top.after.q_norm
                details = f"{name}, {hexes:,} hexes: {row.method} {own:.4f} against {best:.4f}"
                cases[name, hexes, row.method] = own < best, details
    return tally(list(cases.values()), "On no mesh did a heuristic method and an optimiser end.")
