"""Claims about local steepest descent, the fastest method, from the result of a heuristic method."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from benchmarks.thesis.claims.claim import Finding, claim, tally
from benchmarks.thesis.claims.queries import ending, of_mesh, reached_optimum, with_rows
from benchmarks.thesis.experiment_result import ExperimentResult
from benchmarks.thesis.experiments import INITIAL
from hexmend.study.compare import Row

#: From this delta on the optimum may differ (4.2.1); such runs are not compared.
_LARGE = 0.1

#: Heuristics whose time is made up for in the thesis's own tables.
_PAYS_IN_THESIS = ("laplacian",)

#: Reason why a claim is not judged.
_UNKNOWN = "Local steepest descent did not converge from the mesh as it is, or had too little time elsewhere."


@dataclass(frozen=True, eq=False)
class _StartPair:
    """Local steepest descent from the given mesh, where it reaches the optimum, and from the result of a heuristic."""

    alone: Row
    heuristic: Row
    after: Row
    optimal: bool

    @property
    def details(self) -> str:
        """The figures in a sentence."""
        alone, after = (f"{ending(row)}, {row.seconds:.3g} s" for row in (self.alone, self.after))
        heuristic = f"{self.heuristic.method}, which takes {self.heuristic.seconds:.3g} s"
        return f"From the mesh as it is {alone}; from that of {heuristic}, {after}"


@claim("4.2.1", "On bridge-sharp local steepest descent converges faster from Laplacian smoothing's result or GETMe's.")
def preconditioning_speeds(results: Sequence[ExperimentResult]) -> Finding:
    """4.2.1, Tables 4.1 to 4.3: judged by iterations, which cost the same from any start."""
    cases = [
        (pair.optimal and pair.after.iterations < pair.alone.iterations, pair.details)
        for pair in _pairs(results, "bridge-sharp")
    ]
    return tally(cases, _UNKNOWN)


@claim(
    "4.4.1",
    "On bridge-sharp the time of preconditioning is made up for by a faster optimisation (by Tables 4.1 to 4.3 that of "
    "Laplacian smoothing is: 658 s in place of 800; that of GETMe is not: 852 s).",
)
def preconditioning_compensates(results: Sequence[ExperimentResult]) -> Finding:
    """4.4.1: each heuristic is judged by what its own table says."""
    cases = []
    for pair in _pairs(results, "bridge-sharp"):
        pays = pair.optimal and pair.heuristic.seconds + pair.after.seconds < pair.alone.seconds
        cases.append((pays is (pair.heuristic.method in _PAYS_IN_THESIS), pair.details))
    return tally(cases, _UNKNOWN)


@claim("4.4.1", "On plane local steepest descent is faster from the mesh as it is than from GETMe's result.")
def preconditioning_in_vain(results: Sequence[ExperimentResult]) -> Finding:
    """4.4.1, Table 4.15: by the seconds of local steepest descent alone."""
    cases = [
        (not pair.optimal or pair.alone.seconds < pair.after.seconds, pair.details)
        for pair in _pairs(results, "plane")
        if pair.heuristic.method == "getme"
    ]
    return tally(cases, _UNKNOWN)


def _pairs(results: Sequence[ExperimentResult], mesh: str) -> list[_StartPair]:
    runs: dict[tuple[str, int], tuple[Row | None, Row, bool | None]] = {}
    for result, row in with_rows(of_mesh(results, mesh), "local-sd"):
        start = result.experiment.start
        if (result.experiment.delta or 0) < _LARGE:
            run = result.rows.get(start), row, reached_optimum(result, row)
            runs.setdefault((start, result.initial.hexes), run)
    pairs = []
    for (start, hexes), (heuristic, after, optimal) in runs.items():
        _, alone, known = runs.get((INITIAL, hexes), (None, after, None))
        if start != INITIAL and heuristic is not None and known and optimal is not None:
            pairs.append(_StartPair(alone, heuristic, after, optimal))
    return pairs
