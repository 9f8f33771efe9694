"""Claims of local optimisation."""

from __future__ import annotations

from collections.abc import Sequence

from hexmend.study.claims.claim import Finding, judges, tally
from hexmend.study.claims.reading import arrivals, arrived, end, ended, name, of_mesh, tables, times
from hexmend.study.thesis.experiment_result import ExperimentResult

#: "Reduce the number of iterations": by this share at least. A sweep more or less is where A.1's tolerance is met.
_FEWER = 0.05


@judges("4.3.1", "On five-side local steepest descent is the fastest optimiser to converge, in all cases.")
def local_sd_fastest(measured: Sequence[ExperimentResult]) -> Finding:
    """4.3.1, Tables 4.5 to 4.10: judged where it and another arrive."""
    cases = [
        (found[0].method == "local-sd", f"{name(one)}: {times(found)}")
        for one in of_mesh(measured, "five-side")
        if len(found := arrivals(one)) > 1 and "local-sd" in {row.method for row in found}
    ]
    return tally(cases, "On five-side local steepest descent and another optimiser did not both converge.")


@judges(
    "5.1", "Single nodes are best smoothed along the steepest descent: a more accurate direction is not worth its time."
)
def local_sd_best_of_local(measured: Sequence[ExperimentResult]) -> Finding:
    """5.1, 4.1.3: by the seconds of the local methods, in all experiments in which two of them arrive."""
    cases = [
        (found[0].method == "local-sd", f"{name(one)}: {times(found)}")
        for one in tables(measured)
        if len(found := arrivals(one, "local-")) > 1 and "local-sd" in {row.method for row in found}
    ]
    return tally(cases, "In no experiment did local steepest descent and another local optimiser converge.")


@judges("4.3.1", "In no local case does a Hessian made positive definite reduce the number of iterations.")
def modified_local(measured: Sequence[ExperimentResult]) -> Finding:
    """4.3.1, of which the thesis has no figures: local-mnr against local-nr, where both converged."""
    cases = []
    for one in tables(measured):
        if rows := ended(one, "local-nr", "local-mnr"):
            plain, modified = rows
            if arrived(one, plain) and arrived(one, modified):
                told = f"{name(one)}: {modified.iterations:,} iterations, without {plain.iterations:,}"
                cases.append((modified.iterations > (1 - _FEWER) * plain.iterations, told))
    return tally(cases, "In no experiment did local-nr and local-mnr both converge.")


@judges("4.2.1", "A small delta is no problem for the direct solver of local Newton-Raphson.")
def direct_solver(measured: Sequence[ExperimentResult]) -> Finding:
    """4.2.1, Table 4.3: judged from bridge-sharp's start with inverted hexes, at the least delta."""
    found = [one for one in of_mesh(measured, "bridge-sharp", "laplacian") if one.experiment.delta is not None]
    for one in sorted(found, key=lambda one: one.experiment.delta):
        if (rows := ended(one, "local-nr")) and (reached := arrived(one, rows[0])) is not None:
            left = f"{rows[0].after.inverted:,} of {one.start.inverted:,} inverted hexes left"
            return reached, f"With delta {one.experiment.delta:g} {end(rows[0])}, {left}."
    return None, "It was not run, or had too little time."
