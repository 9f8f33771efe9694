"""Run the experiments of Chapter 4 and section 5.2 of the thesis; equal runs of several tables are run once."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

from benchmarks.thesis.claims import CLAIMS
from benchmarks.thesis.experiment_result import ExperimentResult
from benchmarks.thesis.experiments import INITIAL, Experiment, Experiments
from benchmarks.thesis.outlook.claims import OUTLOOK_CLAIMS
from benchmarks.thesis.outlook.experiments import TrialResult, run_outlook
from hexmend.errors import ParameterError
from hexmend.mesh.mesh import Mesh
from hexmend.quality import Summary, summarise
from hexmend.run import StoppingCriteria
from hexmend.smoothers import Smoother
from hexmend.study.compare import Row, run_one


@dataclass(frozen=True, eq=False)
class Study:
    """Results of the experiments.

    Parameters
    ----------
    results : tuple of ExperimentResult
        In the order of the tables.
    trials : tuple of TrialResult
        Results of section 5.2.
    quick : bool
        The meshes were the small ones.
    seconds : float
        Most seconds of a run.
    own_seconds : mapping
        Most seconds by method, where they differ.
    """

    results: tuple[ExperimentResult, ...]
    trials: tuple[TrialResult, ...]
    quick: bool
    seconds: float
    own_seconds: Mapping[str, float]

    def record(self) -> dict[str, Any]:
        """Return the study for JSON and for the tables of `hexmend.report`."""
        return {
            "quick": self.quick,
            "max_seconds": self.seconds,
            "max_seconds_of": dict(self.own_seconds),
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
    quick: bool = False,
    done: Callable[[ExperimentResult | TrialResult], Any] = lambda result: None,
) -> Study:
    """Run experiments one after another.

    Parameters
    ----------
    thesis : Experiments
    quick : bool
        Small meshes, and seconds in place of hours.
    done : callable, optional
        Called with the result of each experiment when its last run has ended.

    Returns
    -------
    Study
    """
    runner = _ExperimentRunner(thesis, quick)
    results, trials = [], []
    for experiment in thesis.experiments:
        results.append(runner.measure(experiment))
        done(results[-1])
    for outlook in thesis.outlooks:
        trials.append(run_outlook(outlook, lambda method: thesis.outlook_stop(method, quick), quick))
        done(trials[-1])
    seconds, own = (thesis.seconds["quick"], thesis.quick_seconds) if quick else (thesis.seconds["full"], {})
    return Study(tuple(results), tuple(trials), quick, seconds, own)


class _ExperimentRunner:
    """Runs experiments; equal runs are run once."""

    def __init__(self, thesis: Experiments, quick: bool):
        self._thesis, self._quick = thesis, quick
        self._meshes: dict[tuple[object, ...], tuple[Mesh, Summary]] = {}
        self._rows: dict[tuple[object, ...], Row] = {}

    def measure(self, experiment: Experiment) -> ExperimentResult:
        """Run all methods of an experiment."""
        mesh, initial = self._mesh(experiment)
        rows = {}
        start = mesh
        if experiment.start != INITIAL:
            rows[experiment.start] = self._row(experiment, INITIAL, mesh, experiment.start)
            start = rows[experiment.start].mesh
        for method in experiment.methods:
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
        while not rows or (len(rows) < times and rows[0].seconds < below):
            rows.append(run_one(mesh, smoother, stop)[0])
        return min(rows, key=lambda row: row.seconds)
