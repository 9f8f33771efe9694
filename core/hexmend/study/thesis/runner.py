"""`hexmend study thesis`: the experiments of Chapter 4, each run done once however many tables show it; then 5.2."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from typing import Any

from hexmend.errors import ParameterError
from hexmend.mesh.mesh import Mesh
from hexmend.quality import Summary, summarise
from hexmend.smoothers import Smoother
from hexmend.study.claims import CLAIMS
from hexmend.study.outlook.claims import OUTLOOK_CLAIMS
from hexmend.study.outlook.experiments import TrialResult, try_outlook
from hexmend.study.table_row import Row, Watch, run_one
from hexmend.study.thesis.experiment_result import ExperimentResult
from hexmend.study.thesis.experiments import INITIAL, Experiment, Experiments


@dataclass(frozen=True, eq=False)
class Study:
    """What was measured.

    Parameters
    ----------
    measured : tuple of ExperimentResult
        In the order of the tables; the last may lack columns where the study was interrupted.
    tried : tuple of TrialResult
        The outlooks of section 5.2.
    quick : bool
        Whether the meshes were the small ones.
    seconds : float
        Most seconds of a run.
    own_seconds : mapping
        The same of methods for which it is another.
    interrupted : bool
    """

    measured: tuple[ExperimentResult, ...]
    tried: tuple[TrialResult, ...]
    quick: bool
    seconds: float
    own_seconds: Mapping[str, float]
    interrupted: bool

    def record(self) -> dict[str, Any]:
        """The study for other programs: what `hexmend.report` writes its tables from."""
        return {
            "quick": self.quick,
            "max_seconds": self.seconds,
            "max_seconds_of": dict(self.own_seconds),
            "interrupted": self.interrupted,
            "experiments": [one.record() for one in self.measured],
            "outlooks": [one.record() for one in self.tried],
            "claims": [claim(self.measured).record() for claim in CLAIMS]
            + [claim(self.tried).record() for claim in OUTLOOK_CLAIMS],
        }


def chosen_tables(thesis: Experiments, tables: Sequence[str]) -> Experiments:
    """The experiments of some tables only, or of sections that have an outlook.

    Raises
    ------
    ParameterError
        For a table that there is not.
    """
    known = list(dict.fromkeys([one.table for one in thesis.experiments] + [one.section for one in thesis.outlooks]))
    for table in tables:
        if table not in known:
            raise ParameterError(f"there is no table {table!r}: expected one of {', '.join(known)}")
    some = tuple(one for one in thesis.experiments if one.table in tables)
    hopes = tuple(one for one in thesis.outlooks if one.section in tables)
    return replace(thesis, experiments=some, outlooks=hopes)


def run_experiments(
    thesis: Experiments,
    *,
    quick: bool = False,
    watch: Watch | None = None,
    done: Callable[[ExperimentResult | TrialResult], Any] | None = None,
) -> Study:
    """Run experiments one after another.

    KeyboardInterrupt, or `watch` returning False, ends the study with what was measured so far.

    Parameters
    ----------
    thesis : Experiments
    quick : bool
        Small meshes, and seconds in place of hours.
    watch : callable, optional
        As in `compare`.
    done : callable, optional
        Called with the figures of each experiment when its last run has ended.
    """
    laboratory = _Laboratory(thesis, quick, watch)
    measured = []
    tried: list[TrialResult] = []
    try:
        for experiment in thesis.experiments:
            measured.append(laboratory.measure(experiment))
            if done is not None:
                done(measured[-1])
            if laboratory.interrupted:
                break
        for outlook in () if laboratory.interrupted else thesis.outlooks:
            one, go_on = try_outlook(outlook, lambda method: thesis.outlook_stop(method, quick), quick, watch)
            tried.append(one)
            if done is not None:
                done(one)
            if not go_on:
                laboratory.interrupted = True
                break
    except KeyboardInterrupt:  # between two runs
        laboratory.interrupted = True
    seconds, own = (thesis.seconds["quick"], thesis.quick_seconds) if quick else (thesis.seconds["full"], {})
    return Study(tuple(measured), tuple(tried), quick, seconds, own, laboratory.interrupted)


def planned(thesis: Experiments, quick: bool) -> Iterator[tuple[list[Smoother], int]]:
    """For each experiment and outlook its methods, and about how many hexes they will be run on."""
    for experiment in thesis.experiments:
        names = {experiment.start, *experiment.methods} - {INITIAL}
        works = []
        for name in sorted(names):
            with suppress(ParameterError):  # of which its column will tell
                works.append(thesis.smoother(experiment, name))
        yield works, experiment.asked(quick)
    for outlook in thesis.outlooks:
        yield [smoother for smoother, _ in outlook.variants()], outlook.quick if quick else outlook.size


class _Laboratory:
    """Runs what has not run yet, and remembers."""

    def __init__(self, thesis: Experiments, quick: bool, watch: Watch | None):
        self._thesis, self._quick, self._watch = thesis, quick, watch
        self._meshes: dict[tuple[str, int], tuple[Mesh, Summary]] = {}
        self._rows: dict[tuple[object, ...], Row] = {}
        self.interrupted = False

    def measure(self, experiment: Experiment) -> ExperimentResult:
        mesh, initial = self._mesh(experiment)
        rows = {}
        start = mesh
        if experiment.start != INITIAL:
            rows[experiment.start] = self._row(experiment, INITIAL, mesh, experiment.start)
            start = rows[experiment.start].mesh
        for method in experiment.methods:
            if self.interrupted:
                break
            rows[method] = self._row(experiment, experiment.start, start, method)
        return ExperimentResult(experiment, mesh, initial, rows)

    def _mesh(self, experiment: Experiment) -> tuple[Mesh, Summary]:
        key = (experiment.mesh, experiment.asked(self._quick))
        if key not in self._meshes:
            mesh = experiment.build(self._quick)
            self._meshes[key] = mesh, summarise(mesh)
        return self._meshes[key]

    def _row(self, experiment: Experiment, start: str, mesh: Mesh | None, method: str) -> Row:
        if mesh is None:
            return Row(method, {}, "failed", f"Failed: {start} left no mesh to start from.")
        try:
            smoother = self._thesis.smoother(experiment, method)
        except ParameterError as error:  # the other columns are worth having
            return Row(method, {}, "failed", f"Failed: {error}")
        key = (experiment.mesh, experiment.asked(self._quick), start, smoother)
        if key not in self._rows:
            stop = self._thesis.stop(method, self._quick)
            self._rows[key], go_on = run_one(mesh, smoother, stop, self._watch)
            self.interrupted = self.interrupted or not go_on
        return self._rows[key]
