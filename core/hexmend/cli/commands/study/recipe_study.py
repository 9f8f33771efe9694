"""The study of many meshes: `hexmend study RECIPE.toml MESH...`."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence
from contextlib import closing
from functools import partial
from pathlib import Path

from hexmend import __version__
from hexmend.cli.output.text_tables import print_table
from hexmend.cli.process.interrupts import CleanExit, FinishWriting
from hexmend.errors import HexmendError, ParameterError
from hexmend.report.documents import cases_table, failures, output_folder, write_batch_study, write_parquet
from hexmend.run.progress import line_display
from hexmend.study.batch.cluster import check_installed, cluster_answers
from hexmend.study.batch.plan import find_meshes, read_plan
from hexmend.study.batch.process import local_answers
from hexmend.study.batch.runner import StudyProgress, StudyResult, Workers, run_study
from hexmend.study.batch.task import COLUMNS, Store
from hexmend.study.machine import machine
from hexmend.terminal_text import printable

#: Failures that are printed one by one.
_MAX_FAILURES = 10


def run(args: argparse.Namespace) -> int:
    """Run the study and write its report; return 3 if a task has no result, 128 and the signal's number on a signal."""
    if not args.study.endswith(".toml"):
        raise ParameterError(f"{args.study!r} is not a study: expected a recipe, as in RECIPE.toml MESH...")
    plan = read_plan(args.study)
    if not args.meshes:
        raise ParameterError(f"{args.study}: no mesh is named for this study: add MESH...")
    workers, meshes = _workers(args), _meshes(args.meshes)
    folder = output_folder(args.output or Path(args.study).stem)
    store = Store(output_folder(folder / "tasks"))
    meshes_to = output_folder(folder / "meshes") if args.write_meshes else None
    with FinishWriting():
        shown = line_display(
            _describe, lambda count: (count.reused + count.done) / max(count.tasks, 1), delay=0.0, always=True
        )
        with CleanExit() as signals, closing(shown):
            options = {"again": args.again, "meshes_to": meshes_to, "watch": shown.show}
            study = run_study(plan, meshes, store, workers, version=__version__, **options)
        _write_report(folder, study)
    if study.interrupted:
        return signals.status
    return 3 if study.progress.failed else 0


def _describe(count: StudyProgress) -> str:
    """Return the numbers of tasks that are done and that failed, and the latest task, as text."""
    text = f"{count.reused + count.done:,} of {count.tasks:,} tasks"
    if count.failed:
        text += f", {count.failed:,} without a result"
    return f"{text}: {count.last}" if count.last else text


def _meshes(names: Sequence[str]) -> list[Path]:
    """Return the meshes, and those in folders; a file that cannot be read is a row of the table, and no error here."""
    listed = [find_meshes([Path(name)]) if Path(name).is_dir() else [Path(name)] for name in names]
    return [mesh for meshes in listed for mesh in meshes]


def _workers(args: argparse.Namespace) -> Workers:
    if args.jobs is not None and args.jobs < 1:
        raise ParameterError(f"--jobs {args.jobs} is too small: expected a whole number from 1")
    if not args.scheduler:
        return partial(local_answers, jobs=args.jobs or 0)
    if args.jobs:
        raise ParameterError(
            "--jobs is for tasks on this machine, --scheduler for tasks on others: leave out one of them"
        )
    check_installed()
    return partial(cluster_answers, address=args.scheduler)


def _write_report(folder: Path, study: StudyResult) -> None:
    """Write the tables, and print the one of the cases and the failures."""
    record = study.record()
    paths = write_batch_study(folder, record, machine())
    try:
        write_parquet(folder / "study.parquet", record["rows"], COLUMNS)
        paths.append(folder / "study.parquet")
    except HexmendError as error:
        print(f"hexmend: {error}", file=sys.stderr)
    print_table(cases_table(record))
    _print_counts(study)
    print(f"Written to {folder}: {', '.join(path.name for path in paths)}.")
    if study.interrupted:
        print("Interrupted: finished tasks are kept; run the same command again to continue.", file=sys.stderr)


def _print_counts(study: StudyResult) -> None:
    """Print the numbers of tasks and, on standard error, the failures with their reasons."""
    count = study.progress
    done = f"{count.done:,} done now, {count.reused:,} done before, {count.failed:,} without a result"
    print(f"{count.tasks:,} tasks: {done}.")
    failed = failures(study.rows)
    for mesh, cases, status, reason in failed[:_MAX_FAILURES]:
        print(printable(f"hexmend: {mesh}, {cases}: {status}: {reason}"), file=sys.stderr)
    if len(failed) > _MAX_FAILURES:
        print(f"hexmend: and {len(failed) - _MAX_FAILURES:,} more, in study.md", file=sys.stderr)
