"""The experiments of Chapter 4 and section 5.2, with the pages and figures of their report."""

from __future__ import annotations

from collections.abc import Sequence

from benchmarks.thesis.experiment_result import ExperimentResult
from benchmarks.thesis.experiments import load
from benchmarks.thesis.mesh_figures import draw_figures
from benchmarks.thesis.outlook.experiments import TrialResult
from benchmarks.thesis.outlook.report import write_outlook
from benchmarks.thesis.report import REPRODUCTION, write_experiment, write_study
from benchmarks.thesis.runner import run_experiments, select_tables
from hexmend.report.documents import output_folder
from hexmend.study.machine import machine


def run(output: str, quick: bool = False, max_seconds: float | None = None, only: Sequence[str] = ()) -> None:
    """Run the experiments, and write their report into a folder.

    Parameters
    ----------
    output : str
        The folder.
    quick : bool
        Small meshes, and seconds in place of hours.
    max_seconds : float, optional
        Time limit of a run.
    only : sequence of str
        Tables, such as "4.1", and sections, such as "5.2.5"; all by default.
    """
    thesis = select_tables(load(), only) if only else load()
    if max_seconds is not None:
        thesis = thesis.with_max_seconds(max_seconds)
    folder = output_folder(output)

    def write(result: ExperimentResult | TrialResult) -> None:
        written = write_outlook if isinstance(result, TrialResult) else write_experiment
        print(written(folder, result.record())[1].name, flush=True)

    study = run_experiments(thesis, quick, write)
    record = {"machine": machine()} | study.record() | {"figures": draw_figures(folder, study.results)}
    write_study(folder, record)
    for claim in record["claims"]:
        print(f"\n{claim['claim']} ({claim['section']}) {REPRODUCTION[claim['reproduced']]} {claim['figures']}")
    print(f"\nWritten to {folder / 'study.md'}.")
