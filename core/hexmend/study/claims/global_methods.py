"""Claims of global optimisation: how fast it is, and of what its search direction makes of it."""

from __future__ import annotations

from collections.abc import Sequence

from hexmend.study.claims.claim import Finding, judges, tally
from hexmend.study.claims.reading import FAR, arrivals, arrived, end, ended, name, near_best, of_mesh, tables, times
from hexmend.study.thesis.experiment_result import ExperimentResult

#: "Negligible advantage": less than this share of the seconds is saved.
_NEGLIGIBLE = 0.1

#: "Arrives", though short of converging: the objective is within this share. By q norm the thesis's global-sd is 0.0016
#: above the optimum in Table 4.6, where it is said to arrive, and 0.0065 in Table 4.2, where it is not.
_THERE = 3e-3

#: "Competitive": within this factor of the fastest local method. The thesis's global-nr, where it converged in Tables
#: 4.1 to 4.10, took 0.9 to 2.8 times as long as local-sd.
_COMPETITIVE = 3.0


@judges("4.1.3", "Global steepest descent is slow or stuck.")
def global_sd_slow(measured: Sequence[ExperimentResult]) -> Finding:
    """4.1.3: judged where another optimiser shows, within the same limits, that the optimum can be reached."""
    cases = []
    for one in tables(measured):
        rows = ended(one, "global-sd")
        others = [row for row in arrivals(one) if row not in rows]
        if rows and others:
            (descent,), fastest = rows, min(others, key=lambda row: row.iterations)
            slow = not arrived(one, descent) or descent.iterations >= FAR * fastest.iterations
            away = "" if near_best(one, descent) else " away from the optimum"
            cases.append((slow, f"{name(one)}: {end(descent)}{away}; {end(fastest)}"))
    return tally(cases, "In no experiment did another optimiser converge within the limits.", most=True)


@judges(
    "4.1.3",
    "Global steepest descent arrives at the optimum on the two smallest meshes, FiveSide4 and FiveSide5, alone.",
)
def global_sd_smallest(measured: Sequence[ExperimentResult]) -> Finding:
    """4.1.3; in Table 4.6 it stops at its iteration limit, so that whether it converged is not asked."""
    cases, kinds = [], set()
    for one in tables(measured):
        if (rows := ended(one, "global-sd")) and any(row not in rows for row in arrivals(one)):
            there, small = near_best(one, rows[0], _THERE), one.experiment.table in ("4.5", "4.6")
            kinds.add(small)
            cases.append((there is small, f"{name(one)}: {'arrives' if there else 'does not'}"))
    return tally(
        cases if len(kinds) > 1 else [], "Another optimiser did not converge on these two and on another mesh."
    )


@judges("4.2.1", "Global steepest descent is unable to smooth bridge-sharp in any of the cases.")
def global_sd_bridge(measured: Sequence[ExperimentResult]) -> Finding:
    """4.2.1, Tables 4.1 to 4.4."""
    cases = []
    for one in of_mesh(measured, "bridge-sharp"):
        if (rows := ended(one, "global-sd")) and (reached := arrived(one, rows[0])) is not None:
            cases.append((not reached, f"{name(one)}: {end(rows[0])}, q norm {rows[0].after.q_norm:.4f}"))
    return tally(cases, "It was not run, or had too little time.")


@judges("4.3.1", "Of the global methods Newton-Raphson is the superior one.")
def newton_best_of_global(measured: Sequence[ExperimentResult]) -> Finding:
    """4.3.1, on five-side: by the seconds of those that arrive, in most cases, as in the thesis's own tables."""
    cases = [
        (found[0].method == "global-nr", f"{name(one)}: {times(found)}")
        for one in of_mesh(measured, "five-side")
        if (found := arrivals(one, "global-")) and ended(one, "global-nr")
    ]
    return tally(cases, "On five-side no global method converged.", most=True)


@judges("4.3.1", "Making the global Hessian positive definite is of negligible advantage.")
def modified_global(measured: Sequence[ExperimentResult]) -> Finding:
    """4.3.1: an advantage is to arrive where plain Newton-Raphson does not, or clearly sooner."""
    cases = []
    for one in tables(measured):
        if rows := ended(one, "global-nr", "global-mnr"):
            plain, modified = rows
            there = arrived(one, plain), arrived(one, modified)
            if None not in there and any(there):
                sooner = modified.seconds < (1 - _NEGLIGIBLE) * plain.seconds
                advantage = there[1] and (not there[0] or sooner)
                told = f"{name(one)}: {end(modified)}, {modified.seconds:.3g} s; {end(plain)}, {plain.seconds:.3g} s"
                cases.append((not advantage, told))
    return tally(
        cases, "In no experiment did global-nr or global-mnr converge while the other had time enough.", most=True
    )


@judges("4.1.3", "Moving all nodes at once, Newton-Raphson converges in fewer iterations than node by node.")
def fewer_iterations(measured: Sequence[ExperimentResult]) -> Finding:
    """4.1.3, "No Artificial Barriers": judged where both arrive."""
    cases = []
    for one in tables(measured):
        if rows := ended(one, "global-nr", "local-nr"):
            everywhere, local = rows
            if arrived(one, everywhere) and arrived(one, local):
                told = f"{name(one)}: {everywhere.iterations:,} iterations, node by node {local.iterations:,}"
                cases.append((everywhere.iterations < local.iterations, told))
    return tally(cases, "In no experiment did global-nr and local-nr both converge.")


@judges("5.1", "Global methods are competitive with second order search directions only.")
def competitive(measured: Sequence[ExperimentResult]) -> Finding:
    """5.1: competitive is to arrive within a few times the seconds of the fastest local method."""
    first, second, told = 0, 0, []
    for one in tables(measured):
        rows, local = ended(one, "global-sd"), arrivals(one, "local-")
        if rows and local:
            near = [row for row in arrivals(one, "global-") if row.seconds <= _COMPETITIVE * local[0].seconds]
            first += any(row.method == "global-sd" for row in near)
            second += any(row.method != "global-sd" for row in near)
            everywhere = arrivals(one, "global-")
            told.append(f"{name(one)}: {times([local[0], *everywhere[:1]])}")
    if not told:
        return None, "In no experiment did a local method converge beside global ones."
    counts = (
        f"Within {_COMPETITIVE:g} times a local method's seconds: second order in {second}, steepest descent in {first}"
    )
    return second > 0 and first == 0, f"{counts} of {len(told)} experiments. {'. '.join(told)}."


@judges("4.3.1", "MINRES solves well conditioned global Hessians effectively, without a preconditioner.")
def minres_suffices(measured: Sequence[ExperimentResult]) -> Finding:
    """4.3.1: judged on five-side from valid starts, in most of which the thesis's Newton-Raphson arrives."""
    cases = []
    for one in of_mesh(measured, "five-side"):
        rows = ended(one, "global-nr") if one.start.inverted == 0 else []
        if rows and (reached := arrived(one, rows[0])) is not None:
            cases.append((reached, f"{name(one)}: {end(rows[0])}, {rows[0].seconds:.3g} s"))
    return tally(cases, "On five-side global-nr was not run from a valid start, or had too little time.", most=True)
