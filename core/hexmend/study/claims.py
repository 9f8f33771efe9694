"""What the thesis concludes from Chapter 4, each claim judged by our own figures."""

from __future__ import annotations

import itertools
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import asdict, dataclass
from typing import Any

import numpy as np

from hexmend.optimise import Outcome
from hexmend.quality import measure
from hexmend.smoothers import METHODS
from hexmend.study.measured import Measured
from hexmend.study.row import Row

#: Objectives that differ by less than this share are one optimum's: what the tolerance of A.1 leaves open.
_SAME = 1e-3

#: "Far less time" and "slow": by this factor at least.
_FAR = 5.0

#: "Constant in the mesh size": within this factor. The thesis's own figures of global-sd vary by 3.4.
_CONSTANT = 3.5

#: How a run ended, where the outcome's key is no verb.
_ENDS = {
    Outcome.MAX_SECONDS.key: "reached the time limit",
    Outcome.MAX_ITERATIONS.key: "reached the iteration limit",
    Outcome.NO_DESCENT.key: "found no descent",
    Outcome.STOPPED.key: "was stopped",
}


@dataclass(frozen=True)
class Claim:
    """A claim and what was found.

    Parameters
    ----------
    claim : str
        The thesis's, in a sentence.
    reproduced : bool or None
        None where what it needs was not measured.
    figures : str
        What was measured, in a sentence.
    """

    claim: str
    reproduced: bool | None
    figures: str

    def record(self) -> dict[str, Any]:
        return asdict(self)


def same_optimum(measured: Sequence[Measured]) -> Claim:
    """5.1, Appendix C: "several examples", judged where both kinds converged from a valid start."""
    claim = "Local and global optimisation reach the same optimum."
    told, same = [], []
    for one in measured:
        rows = [row for row in one.rows.values() if _optimised(row)]
        best = [_best(row for row in rows if row.method.startswith(scope)) for scope in ("local-", "global-")]
        if one.start.inverted == 0 and all(best):
            local, everywhere = best
            a, b = local.after.objective, everywhere.after.objective
            same.append(abs(a - b) < _SAME * min(a, b))
            told.append(
                f"{_name(one)}: objective {a:.7g} by {local.method}, {b:.7g} by {everywhere.method}, nodes at most "
                f"{_apart(one, local, everywhere):.1g} mean edge lengths apart"
            )
    if not same:
        return Claim(claim, None, "From no valid start did runs of both kinds converge.")
    return Claim(claim, sum(same) > len(same) / 2, f"So in {sum(same)} of {len(same)} experiments. {'. '.join(told)}.")


def getme_between(measured: Sequence[Measured]) -> Claim:
    """4.4.1."""
    claim = (
        "On plane GETMe ends below the optimum and above Laplacian smoothing in mean quality, in far less time than "
        "the optimisers take."
    )
    for one in _of_mesh(measured, "plane"):
        if rows := _ended(one, "laplacian", "getme", "local-sd"):
            laplacian, getme, best = rows
            told = (
                f"q mean is {laplacian.after.q_mean:.4f} by laplacian, {getme.after.q_mean:.4f} by getme, "
                f"{best.after.q_mean:.4f} by local-sd; getme takes {getme.seconds:.3g} s, local-sd {best.seconds:.3g}. "
                f"Far less is taken as a {_FAR:g}th at most."
            )
            between = laplacian.after.q_mean < getme.after.q_mean < best.after.q_mean
            return Claim(claim, between and getme.seconds * _FAR < best.seconds, told)
    return Claim(claim, None, "The runs failed or were not made.")


def laplacian_inverts(measured: Sequence[Measured]) -> Claim:
    """4.2, 4.4.1: judged by the hexes that were sound before."""
    claim = "Laplacian smoothing inverts hexes on bridge-sharp and on plane."
    found: dict[str, tuple[int, int]] = {}
    for one in itertools.chain(_of_mesh(measured, "bridge-sharp"), _of_mesh(measured, "plane")):
        if one.initial.hexes > found.get(one.experiment.mesh, (0, 0))[0] and (rows := _ended(one, "laplacian")):
            before, after = (measure(mesh.points, mesh.hexes).inverted for mesh in (one.mesh, rows[0].mesh))
            found[one.experiment.mesh] = one.initial.hexes, int(np.count_nonzero(after & ~before))
    told = "; ".join(f"{mesh}, {hexes:,} hexes: {count:,} of the sound" for mesh, (hexes, count) in found.items())
    if len(found) < 2:
        return Claim(claim, None, f"Only one of them was measured. {told}".strip() if told else "Neither was measured.")
    return Claim(claim, all(count > 0 for _, count in found.values()), f"It inverts on {told}.")


def global_sd_slow(measured: Sequence[Measured]) -> Claim:
    """4.1: judged where another optimiser shows, within the same limits, that the optimum can be reached."""
    claim = "Global steepest descent is slow or stuck."
    told, slow = [], []
    for one in measured:
        rows = _ended(one, "global-sd")
        others = [row for row in one.rows.values() if _optimised(row) and _near_best(one, row) and row not in rows]
        if not rows or not others:
            continue
        (descent,), fastest = rows, min(others, key=lambda row: row.iterations)
        arrived = _optimised(descent) and _near_best(one, descent)
        slow.append(not arrived or descent.iterations >= _FAR * fastest.iterations)
        away = "" if _near_best(one, descent) else " away from the optimum"
        told.append(f"{_name(one)}: {_end(descent)}{away}; {_end(fastest)}")
    if not slow:
        return Claim(claim, None, "In no experiment did another optimiser converge within the limits.")
    return Claim(claim, sum(slow) > len(slow) / 2, f"So in {sum(slow)} of {len(slow)} experiments. {'. '.join(told)}.")


def small_delta_harms(measured: Sequence[Measured]) -> Claim:
    """4.2.1, Tables 4.3 and 4.4: judged on equal limits."""
    claim = "A small delta keeps global Newton-Raphson from converging where a larger one lets it converge."
    rows, told = _by_delta(measured, "global-nr")
    if not rows:
        return Claim(claim, None, told)
    arrived = [row.outcome == Outcome.CONVERGED.key for row in rows]
    return Claim(claim, arrived[-1] and not arrived[0], told)


def large_delta_moves(measured: Sequence[Measured]) -> Claim:
    """4.2.1, Table 4.4: of the methods there, those that converge."""
    claim = "A large delta moves the optimum so far that an optimiser may converge and leave hexes inverted."
    told, left = [], []
    for method in ("local-sd", "local-nr", "global-nr"):
        rows, words = _by_delta(measured, method)
        told.append(words)
        if rows and rows[-1].outcome == Outcome.CONVERGED.key:
            left.append(rows[-1].after.inverted > 0)
    if not left:
        return Claim(claim, None, " ".join(told))
    return Claim(claim, any(left), " ".join(told))


def _by_delta(measured: Sequence[Measured], method: str) -> tuple[list[Row], str]:
    """What a method made of bridge-sharp after Laplacian smoothing, by rising delta, and that in words."""
    found = {
        one.experiment.delta: one.rows[method]
        for one in _of_mesh(measured, "bridge-sharp")
        if one.experiment.start == "laplacian" and _ended(one, method)
    }
    told = "; ".join(
        f"delta {delta:g}: {_end(row)}, {row.after.inverted:,} inverted" for delta, row in sorted(found.items())
    )
    if len(found) < 2:
        return [], f"Of {method} there is no pair of runs with two values of delta."
    return [found[delta] for delta in sorted(found)], f"With {told}."


def cost_constant(measured: Sequence[Measured]) -> Claim:
    """4.3.1, Figure 4.4."""
    claim = "Time per iteration and free node does not depend on the mesh's size."
    ours: dict[str, dict[int, float]] = {}
    thesis: dict[str, dict[int, float]] = {}
    for one in _of_mesh(measured, "five-side"):
        for name, row in one.rows.items():
            if row.seconds_per_iteration_and_node is not None:
                ours.setdefault(name, {})[one.initial.free_nodes] = row.seconds_per_iteration_and_node
        for name, figures in one.experiment.published.items():
            if "seconds_per_iteration_and_node" in figures:
                cost = figures["seconds_per_iteration_and_node"]
                thesis.setdefault(name, {})[one.experiment.free_nodes] = cost
    ratios = {name: max(by.values()) / min(by.values()) for name, by in ours.items() if len(by) > 1}
    if not ratios:
        return Claim(claim, None, "Fewer than two sizes were measured.")
    sizes = sorted({size for by in ours.values() for size in by})
    told = ", ".join(
        f"{name} {ratio:.2g} ({max(thesis[name].values()) / min(thesis[name].values()):.2g})"
        for name, ratio in ratios.items()
    )
    told = (
        f"From {sizes[0]:,} to {sizes[-1]:,} free nodes the largest is so many times the smallest, in brackets by the "
        f"thesis's figures: {told}. Constant is taken as less than {_CONSTANT:g}."
    )
    return Claim(claim, max(ratios.values()) < _CONSTANT, told)


#: Every claim, in the order of the report.
CLAIMS: tuple[Callable[[Sequence[Measured]], Claim], ...] = (
    same_optimum,
    getme_between,
    laplacian_inverts,
    global_sd_slow,
    small_delta_harms,
    large_delta_moves,
    cost_constant,
)


def _of_mesh(measured: Sequence[Measured], mesh: str) -> Iterator[Measured]:
    return (one for one in measured if one.experiment.mesh == mesh)


def _ended(one: Measured, *names: str) -> list[Row]:
    """The rows of these methods, or none unless all of them ran."""
    rows = [one.rows[name] for name in names if name in one.rows and one.rows[name].after is not None]
    return rows if len(rows) == len(names) else []


def _optimised(row: Row) -> bool:
    """Whether an optimiser converged, with no hex inverted."""
    optimises = row.method in METHODS and METHODS[row.method].optimises
    return optimises and row.outcome == Outcome.CONVERGED.key and row.after.inverted == 0


def _end(row: Row) -> str:
    """How a run ended, in words."""
    return f"{row.method} {_ENDS.get(row.outcome, row.outcome)} after {row.iterations:,} iterations"


def _near_best(one: Measured, row: Row) -> bool:
    """Whether no method of the experiment found a clearly better objective."""
    known = [other.after.objective for other in one.rows.values() if other.after and other.after.objective is not None]
    mine = row.after.objective
    return mine is not None and mine <= min(known) * (1 + _SAME)


def _best(rows: Iterable[Row]) -> Row | None:
    """The row of the lowest objective."""
    return min(rows, key=lambda row: row.after.objective, default=None)


def _apart(one: Measured, a: Row, b: Row) -> float:
    """Most by which two meshes differ in a node's place, in mean edge lengths."""
    return float(np.linalg.norm(a.mesh.points - b.mesh.points, axis=1).max()) / one.mesh.mean_edge_length


def _name(one: Measured) -> str:
    return f"{one.experiment.table}, {one.experiment.thesis_mesh}"
