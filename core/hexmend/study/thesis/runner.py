"""Run the experiments of Chapter 4 and section 5.2 of the thesis; equal runs of several tables are run once."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from typing import Any

from hexmend.errors import ParameterError
from hexmend.mesh.mesh import Mesh
from hexmend.quality import Summary, summarise
from hexmend.run import StoppingCriteria
from hexmend.smoothers import Smoother
from hexmend.study.claims import CLAIMS
from hexmend.study.outlook.claims import OUTLOOK_CLAIMS
from hexmend.study.outlook.experiments import TrialResult, run_outlook
from hexmend.study.table_row import Row, Watch, run_one
from hexmend.study.thesis.experiment_result import ExperimentResult
from hexmend.study.thesis.experiments import INITIAL, Experiment, Experiments


@dataclass(frozen=True, eq=False)
class Study:
    """Results of the experiments.

    Parameters
    ----------
    results : tuple of ExperimentResult
        In the order of the tables; the last may lack columns after an interruption.
    trials : tuple of TrialResult
        Results of section 5.2.
    quick : bool
        The meshes were the small ones.
    seconds : float
        Most seconds of a run.
    own_seconds : mapping
        Most seconds by method, where they differ.
    interrupted : bool
    """

    results: tuple[ExperimentResult, ...]
    trials: tuple[TrialResult, ...]
    quick: bool
    seconds: float
    own_seconds: Mapping[str, float]
    interrupted: bool

    def record(self) -> dict[str, Any]:
        """Return the study for JSON and for the tables of `hexmend.report`."""
        return {
            "quick": self.quick,
            "max_seconds": self.seconds,
            "max_seconds_of": dict(self.own_seconds),
            "interrupted": self.interrupted,
            "experiments": [result.record() for result in self.results],
            "outlooks": [trial.record() for trial in self.trials],
            "claims": [claim(self.results).record() for claim in CLAIMS]
            + [claim(self.trials).record() for claim in OUTLOOK_CLAIMS],
        }


def select_tables(thesis: Experiments, tables: Sequence[str]) -> Experiments:
    """Select the experiments of tables, or the outlooks of sections.

    Parameters
    ----------
    thesis : Experiments
    tables : sequence of str
        Such as "4.2", "5.2.6".

    Returns
    -------
    Experiments

    Raises
    ------
    ParameterError
        For an unknown table.
    """
    named = [experiment.table for experiment in thesis.experiments] + [outlook.section for outlook in thesis.outlooks]
    known = list(dict.fromkeys(named))
    for table in tables:
        if table not in known:
            raise ParameterError(f"there is no table {table!r}: expected one of {', '.join(known)}")
    experiments = tuple(experiment for experiment in thesis.experiments if experiment.table in tables)
    outlooks = tuple(outlook for outlook in thesis.outlooks if outlook.section in tables)
    return replace(thesis, experiments=experiments, outlooks=outlooks)


def run_experiments(
    thesis: Experiments,
    *,
    quick: bool = False,
    watch: Watch | None = None,
    done: Callable[[ExperimentResult | TrialResult], Any] | None = None,
) -> Study:
    """Run experiments one after another.

    KeyboardInterrupt, or `watch` returning False, ends the study; results so far are returned.

    Parameters
    ----------
    thesis : Experiments
    quick : bool
        Small meshes, and seconds in place of hours.
    watch : callable, optional
        See `hexmend.study.table_row.Watch`.
    done : callable, optional
        Called with the result of each experiment when its last run has ended.

    Returns
    -------
    Study
    """
    runner = _ExperimentRunner(thesis, quick, watch)
    results = []
    trials: list[TrialResult] = []
    try:
        for experiment in thesis.experiments:
            results.append(runner.measure(experiment))
            if done is not None:
                done(results[-1])
            if runner.interrupted:
                break
        for outlook in () if runner.interrupted else thesis.outlooks:
            trial, completed = run_outlook(outlook, lambda method: thesis.outlook_stop(method, quick), quick, watch)
            trials.append(trial)
            if done is not None:
                done(trial)
            if not completed:
                runner.interrupted = True
                break
    except KeyboardInterrupt:  # between two runs
        runner.interrupted = True
    seconds, own = (thesis.seconds["quick"], thesis.quick_seconds) if quick else (thesis.seconds["full"], {})
    return Study(tuple(results), tuple(trials), quick, seconds, own, runner.interrupted)


def planned_runs(thesis: Experiments, quick: bool) -> Iterator[tuple[list[Smoother], int]]:
    """Yield the methods of each experiment and outlook, with the approximate number of hexes of their mesh."""
    for experiment in thesis.experiments:
        names = {experiment.start, *experiment.methods} - {INITIAL}
        works = []
        for name in sorted(names):
            with suppress(ParameterError):  # its column will have the reason
                works.append(thesis.smoother(experiment, name))
        yield works, experiment.requested_hexes(quick)
    for outlook in thesis.outlooks:
        yield [smoother for smoother, _ in outlook.variants()], outlook.quick if quick else outlook.size


class _ExperimentRunner:
    """Runs experiments; equal runs are run once."""

    def __init__(self, thesis: Experiments, quick: bool, watch: Watch | None):
        self._thesis, self._quick, self._watch = thesis, quick, watch
        self._meshes: dict[tuple[object, ...], tuple[Mesh, Summary]] = {}
        self._rows: dict[tuple[object, ...], Row] = {}
        self.interrupted = False

    def measure(self, experiment: Experiment) -> ExperimentResult:
        """Run all methods of an experiment."""
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
        key = (experiment.mesh, experiment.requested_hexes(self._quick), experiment.scramble)
        if key not in self._meshes:
            mesh = experiment.build(self._quick)
            self._meshes[key] = mesh, summarise(mesh)
        return self._meshes[key]

    def _row(self, experiment: Experiment, start: str, mesh: Mesh | None, method: str) -> Row:
        if mesh is None:
            return Row(method, {}, "failed", f"Failed: {start} left no mesh to start from.")
        try:
            smoother = self._thesis.smoother(experiment, method)
        except ParameterError as error:  # the other columns are still useful
            return Row(method, {}, "failed", f"Failed: {error}")
        key = (experiment.mesh, experiment.requested_hexes(self._quick), experiment.scramble, start, smoother)
        if key not in self._rows:
            self._rows[key] = self._fastest(mesh, smoother, self._thesis.stop(method, self._quick))
        return self._rows[key]

    def _fastest(self, mesh: Mesh, smoother: Smoother, stop: StoppingCriteria) -> Row:
        """Run a method, and again where that takes little time; return the run of the least."""
        times, below = self._thesis.repeats["times"], self._thesis.repeats["below"]
        rows: list[Row] = []
        while not rows or (len(rows) < times and rows[0].seconds < below and not self.interrupted):
            row, completed = run_one(mesh, smoother, stop, self._watch)
            self.interrupted = self.interrupted or not completed
            rows.append(row)
        return min(rows if completed else rows[:1], key=lambda row: row.seconds)
