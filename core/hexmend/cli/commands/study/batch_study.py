"""A study of many meshes: `hexmend study RECIPE.toml MESH...`."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from hexmend.study.batch.runner import StudyResult, Workers


def study_meshes(args: argparse.Namespace) -> int:
    """Do the study; return the exit status: 3 where a task has no result."""
    from hexmend import __version__
    from hexmend.cli.output.study_progress import Counting
    from hexmend.cli.process.interrupts import EndsCleanly, FinishesWriting
    from hexmend.errors import ParameterError
    from hexmend.report import made_folder
    from hexmend.study.batch.plan import read_plan
    from hexmend.study.batch.runner import study_many
    from hexmend.study.batch.store import Store

    plan = read_plan(args.study)
    if not args.meshes:
        raise ParameterError(f"{args.study} says what to do, and no mesh is named to do it with: add MESH...")
    workers = _workers(args)
    folder = made_folder(args.output or Path(args.study).stem)
    store = Store(made_folder(folder / "tasks"))
    meshes_to = made_folder(folder / "meshes") if args.write_meshes else None
    with FinishesWriting():
        with EndsCleanly() as signals, Counting() as counting:
            studied = study_many(
                plan,
                [Path(mesh) for mesh in args.meshes],
                store,
                workers,
                version=__version__,
                again=args.again,
                meshes_to=meshes_to,
                watch=counting.show,
            )
        _write(folder, studied)
    if studied.interrupted:
        return signals.status
    return 3 if studied.count.failed else 0


def _write(folder: Path, studied: StudyResult) -> None:
    """Write the report, and print what was done."""
    from hexmend.cli.output.rich_tables import print_table
    from hexmend.errors import HexmendError
    from hexmend.report.batch import cases_table, write_many, write_parquet
    from hexmend.study.batch.table_columns import COLUMNS
    from hexmend.study.bench.sections import machine

    record = studied.record()
    paths = write_many(folder, record, machine())
    try:
        write_parquet(folder / "study.parquet", record["rows"], {column.name: column.type for column in COLUMNS})
        paths.append(folder / "study.parquet")
    except HexmendError as error:
        print(f"hexmend: {error}", file=sys.stderr)
    print_table(cases_table(record))
    _say(studied)
    print(f"Written to {folder}: {', '.join(path.name for path in paths)}.")
    if studied.interrupted:
        print("Interrupted: what is done is kept, and the same command goes on with it.", file=sys.stderr)


def _workers(args: argparse.Namespace) -> Workers:
    from hexmend.errors import ParameterError
    from hexmend.study.batch.local import Local

    if args.jobs is not None and args.jobs < 1:
        raise ParameterError(f"--jobs {args.jobs} leaves nobody to do anything: expected a whole number from 1")
    if not args.scheduler:
        return Local(args.jobs or 0)
    if args.jobs:
        raise ParameterError(
            "--jobs is for this machine, and --scheduler's workers have their own: leave out one of them"
        )
    from hexmend.study.batch.cluster import Cluster

    return Cluster(args.scheduler)


def _say(studied: StudyResult) -> None:
    """What was done, what was there, and what has failed."""
    from hexmend.report.batch import failures
    from hexmend.terminal_text import printable

    count = studied.count
    said = f"{count.done:,} done now, {count.kept:,} done before, {count.failed:,} without a result"
    print(f"{count.tasks:,} tasks: {said}.")
    failed = failures(studied.rows)
    for mesh, cases, status, reason in failed[:_SAID]:
        print(printable(f"hexmend: {mesh}, {cases}: {status}: {reason}"), file=sys.stderr)
    if len(failed) > _SAID:
        print(f"hexmend: and {len(failed) - _SAID:,} more, in study.md", file=sys.stderr)


#: Failures that are said one by one.
_SAID = 10
