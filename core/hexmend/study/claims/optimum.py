"""Claims of where the methods end: one optimum, and how good it is."""

from __future__ import annotations

import itertools
from collections.abc import Sequence

from hexmend.study.claims.claim import Finding, judges, tally
from hexmend.study.claims.reading import (
    SAME,
    apart,
    arrivals,
    best,
    ended,
    name,
    objective,
    of_mesh,
    optimised,
    optimisers,
    optimum,
    settled,
    tables,
)
from hexmend.study.thesis.experiment_result import ExperimentResult

#: Qualities of one optimum as runs end: q min and q mean of the thesis's own in Table 4.15 differ by 0.0035 at most.
_SAME_QUALITY = 0.005


@judges("5.1, C", "Local and global optimisation reach the same optimum.")
def same_optimum(measured: Sequence[ExperimentResult]) -> Finding:
    """5.1, Appendix C: "several examples", judged where both kinds converged from a valid start."""
    return _both_kinds(measured, tangled=False)


@judges("5.1", "Local and global optimisation reach the same optimum where they have to untangle the mesh first, too.")
def same_optimum_untangled(measured: Sequence[ExperimentResult]) -> Finding:
    """5.1, "untangling and smoothing": judged where both kinds converged from a start with inverted hexes."""
    return _both_kinds(measured, tangled=True)


def _both_kinds(measured: Sequence[ExperimentResult], tangled: bool) -> Finding:
    cases = []
    for one in tables(measured):
        local, everywhere = (
            best(row for row in optimisers(one, scope) if optimised(row)) for scope in ("local-", "global-")
        )
        if (one.start.inverted > 0) is tangled and local and everywhere:
            a, b = objective(local), objective(everywhere)
            told = (
                f"{name(one)}: objective {a:.7g} by {local.method}, {b:.7g} by {everywhere.method}, nodes at most "
                f"{apart(one, local, everywhere):.1g} mean edge lengths apart"
            )
            cases.append((abs(a - b) < SAME * min(a, b), told))
    start = "start with inverted hexes" if tangled else "valid start"
    return tally(cases, f"From no {start} did runs of both kinds converge.", most=True)


@judges("4.1.1", "Where no hex is inverted, q norm is equivalent to the global objective.")
def norm_is_objective(measured: Sequence[ExperimentResult]) -> Finding:
    """4.1.1: judged by the order of runs, as q norm is made of the hexes' q and (3.3) of their tetrahedra's."""
    cases = []
    for one in tables(measured):
        rows = [row for row in optimisers(one) if objective(row) is not None]
        pairs = [
            (a, b)
            for a, b in itertools.permutations(rows, 2)
            if objective(a) < objective(b) * (1 - SAME) and a.after.q_norm != b.after.q_norm
        ]
        wrong = [f"{a.method} before {b.method}" for a, b in pairs if a.after.q_norm < b.after.q_norm]
        if pairs:
            told = f"by the objective, not by q norm, {', '.join(wrong)}" if wrong else "the same order"
            cases.append((not wrong, f"{name(one)}: {told}"))
    return tally(cases, "In no experiment did two optimisers end at objectives that differ.")


@judges("4.4", "On plane all optimisers that converge generate the same final quality.")
def one_quality(measured: Sequence[ExperimentResult]) -> Finding:
    """4.4."""
    cases = []
    for one in of_mesh(measured, "plane"):
        rows = settled(one)
        if len(rows) > 1:
            spans = [
                max(values) - min(values)
                for values in ([row.after.q_min for row in rows], [row.after.q_mean for row in rows])
            ]
            told = (
                f"{name(one)}: q min of {len(rows)} methods within {spans[0]:.4f} and q mean within {spans[1]:.4f} "
                f"(the same is taken as {_SAME_QUALITY:g})"
            )
            cases.append((max(spans) <= _SAME_QUALITY, told))
    return tally(cases, "On plane fewer than two optimisers converged.")


@judges("4.4.1", "On plane optimisation ends at a higher quality, least and mean, than any other method.")
def optimum_is_best(measured: Sequence[ExperimentResult]) -> Finding:
    """4.4.1, Table 4.14."""
    for one in of_mesh(measured, "plane", "initial"):
        rows, found = ended(one, "laplacian", "getme"), settled(one)
        if rows and found:
            top = found[0]
            others = {"initial": one.initial} | {row.method: row.after for row in rows}
            told = "; ".join(f"{who} {it.q_min:.4f}, {it.q_mean:.4f}" for who, it in others.items())
            higher = all(it.q_min < top.after.q_min and it.q_mean < top.after.q_mean for it in others.values())
            left = f"{top.after.inverted:,} inverted"
            mine = f"{top.method} {top.after.q_min:.4f}, {top.after.q_mean:.4f} ({left})"
            return higher, f"q min and q mean: {mine}; {told}."
    return None, "The heuristics and an optimiser that converges were not all run on plane."


@judges(
    "Table 4.8",
    "Global steepest descent ends FiveSide60k at a higher least quality than any other method, and at a worse "
    "objective: its q norm is below theirs.",
)
def better_minimum(measured: Sequence[ExperimentResult]) -> Finding:
    """The remark below Table 4.8."""
    for one in tables(measured):
        if one.experiment.table == "4.8" and (descent := ended(one, "global-sd")) and (others := arrivals(one)):
            (stuck,) = descent
            told = "; ".join(f"{row.method} {row.after.q_min:.4f}, {row.after.q_norm:.4f}" for row in [stuck, *others])
            higher = all(row.after.q_min < stuck.after.q_min for row in others if row is not stuck)
            worse = all(row.after.q_norm > stuck.after.q_norm for row in others if row is not stuck)
            return stuck not in others and higher and worse, f"q min and q norm: {told}."
    return None, "Table 4.8 was not run, or nothing in it converged."


@judges("5.1", "Heuristic methods do not end at optimal places of the nodes.")
def heuristics_not_optimal(measured: Sequence[ExperimentResult]) -> Finding:
    """5.1: judged by q norm, against the optimum of the same mesh in whichever table."""
    cases = {}
    for one in tables(measured):
        top = optimum(measured, one)
        for row in (row for method in ("laplacian", "getme") for row in ended(one, method)):
            if top is not None:
                told = (
                    f"{one.experiment.mesh}, {one.initial.hexes:,} hexes: {row.method} {row.after.q_norm:.4f} "
                    f"against {top.after.q_norm:.4f}"
                )
                cases[one.experiment.mesh, one.initial.hexes, row.method] = row.after.q_norm < top.after.q_norm, told
    return tally(list(cases.values()), "On no mesh did a heuristic method and an optimiser end.")
