"""The study of the thesis: `hexmend study thesis`."""

from __future__ import annotations

import argparse
import sys
from functools import partial
from pathlib import Path

from hexmend.cli.arguments.checks import check_memory
from hexmend.cli.output.progress import Progress
from hexmend.cli.process.interrupts import FinishWriting
from hexmend.parameters import from_strings
from hexmend.report import output_folder, write_experiment, write_outlook, write_study
from hexmend.report.thesis import REPRODUCTION
from hexmend.run import StoppingCriteria
from hexmend.study.bench.sections import machine
from hexmend.study.outlook.experiments import TrialResult
from hexmend.study.thesis.experiment_result import ExperimentResult
from hexmend.study.thesis.experiments import load
from hexmend.study.thesis.mesh_figures import draw_figures
from hexmend.study.thesis.runner import planned_runs, run_experiments, select_tables


def run(args: argparse.Namespace) -> int:
    """Run the experiments and write their report; return 128 and the signal's number if interrupted."""
    thesis = select_tables(load(), args.only) if args.only else load()
    if args.max_seconds is not None:
        limit = from_strings(StoppingCriteria, {"max_seconds": args.max_seconds}, owner="the run")
        thesis = thesis.with_max_seconds(limit.max_seconds)
    for methods, hexes in planned_runs(thesis, args.quick):
        check_memory(args, methods, hexes, "run fewer tables (--only)", "run the small meshes (--quick)")
    folder = output_folder(args.output)
    with FinishWriting():
        with Progress() as progress:
            study = run_experiments(
                thesis, quick=args.quick, watch=progress.show, done=partial(_write_experiment, folder)
            )
        figures, missing = draw_figures(folder, study.results)
        record = {"machine": machine()} | study.record() | {"figures": figures, "missing": missing}
        write_study(folder, record)
        for claim in record["claims"]:
            print(f"\n{claim['claim']} ({claim['section']}) {REPRODUCTION[claim['reproduced']]} {claim['figures']}")
        if study.interrupted:
            print("Interrupted: the report holds what was done so far.", file=sys.stderr)
        if missing:
            print(missing, file=sys.stderr)
        print(f"\nWritten to {folder / 'study.md'}.")
    return progress.signals.status if study.interrupted else 0


def _write_experiment(folder: Path, result: ExperimentResult | TrialResult) -> None:
    """Write the documents of one table or outlook, and print the name of the one to read."""
    if isinstance(result, TrialResult):
        name, write = f"Section {result.outlook.section}, {result.outlook.mesh}", write_outlook
    else:
        name, write = f"Table {result.experiment.table}, {result.experiment.thesis_mesh}", write_experiment
    paths = write(folder, result.record())
    print(f"{name}: {paths[1].name}", flush=True)
