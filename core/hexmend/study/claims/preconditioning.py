"""Claims of local steepest descent, the quickest method, begun from what a heuristic method leaves."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from hexmend.study.claims.claim import Finding, judges, tally
from hexmend.study.claims.reading import arrived, end, ended, of_mesh
from hexmend.study.table_row import Row
from hexmend.study.thesis.experiment_result import ExperimentResult
from hexmend.study.thesis.experiments import INITIAL

#: From this delta on the optimum may be another (4.2.1): such a run is not compared.
_LARGE = 0.1

#: Why it is not judged.
_UNKNOWN = "Local steepest descent did not converge from the mesh as it is, or had too little time elsewhere."


@dataclass(frozen=True, eq=False)
class _Pair:
    """Local steepest descent from the mesh as it is, where it arrives, and from a heuristic's result."""

    alone: Row
    heuristic: Row
    after: Row
    arrives: bool

    @property
    def told(self) -> str:
        return (
            f"From the mesh as it is {end(self.alone)}, {self.alone.seconds:.3g} s; from that of "
            f"{self.heuristic.method}, which takes {self.heuristic.seconds:.3g} s, {end(self.after)}, "
            f"{self.after.seconds:.3g} s"
        )


@judges(
    "4.2.1", "On bridge-sharp local steepest descent converges faster from Laplacian smoothing's result or GETMe's."
)
def preconditioning_speeds(measured: Sequence[ExperimentResult]) -> Finding:
    """4.2.1, Tables 4.1 to 4.3: judged by iterations, which cost the same from any start."""
    pairs = _pairs(measured, "bridge-sharp")
    return tally([(one.arrives and one.after.iterations < one.alone.iterations, one.told) for one in pairs], _UNKNOWN)


@judges("4.4.1", "On bridge-sharp the time of preconditioning is made up for by a faster optimisation.")
def preconditioning_compensates(measured: Sequence[ExperimentResult]) -> Finding:
    """4.4.1 of Tables 4.1 to 4.3, whose figures say so of Laplacian smoothing alone: of GETMe, 852 s against 800."""
    cases = [
        (one.arrives and one.heuristic.seconds + one.after.seconds < one.alone.seconds, one.told)
        for one in _pairs(measured, "bridge-sharp")
    ]
    return tally(cases, _UNKNOWN)


@judges("4.4.1", "On plane local steepest descent is faster from the mesh as it is than from GETMe's result.")
def preconditioning_in_vain(measured: Sequence[ExperimentResult]) -> Finding:
    """4.4.1, Table 4.15: by the seconds of local steepest descent alone."""
    cases = [
        (not one.arrives or one.alone.seconds < one.after.seconds, one.told)
        for one in _pairs(measured, "plane")
        if one.heuristic.method == "getme"
    ]
    return tally(cases, _UNKNOWN)


def _pairs(measured: Sequence[ExperimentResult], mesh: str) -> list[_Pair]:
    runs: dict[tuple[str, int], tuple[Row | None, Row, bool | None]] = {}
    for one in of_mesh(measured, mesh):
        start, delta = one.experiment.start, one.experiment.delta or 0
        if delta < _LARGE and (rows := ended(one, "local-sd")):
            runs.setdefault((start, one.initial.hexes), (one.rows.get(start), rows[0], arrived(one, rows[0])))
    pairs = []
    for (start, hexes), (heuristic, after, arrives) in runs.items():
        _, alone, known = runs.get((INITIAL, hexes), (None, after, None))
        if start != INITIAL and heuristic is not None and known and arrives is not None:
            pairs.append(_Pair(alone, heuristic, after, arrives))
    return pairs
