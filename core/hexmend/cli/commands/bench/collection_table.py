"""A collection of meshes, smoothed by Hexmend and other programs: `hexmend bench --only collection FOLDER...`."""

from __future__ import annotations

import argparse
import os
import sys
from pathlib import Path

from hexmend import __version__
from hexmend.cli.commands.bench.mesh_pictures import draw_pictures
from hexmend.cli.output.rich_tables import print_table
from hexmend.cli.output.study_progress import TaskProgress
from hexmend.cli.process.interrupts import CleanExit, FinishWriting
from hexmend.errors import ParameterError
from hexmend.report import output_folder
from hexmend.report.batch import failures
from hexmend.report.collection.documents import read_page, replace_tables, write_collection
from hexmend.report.collection.record import CollectionRecord, Program
from hexmend.report.collection.tables import collection_tables
from hexmend.study.batch.case import TaskLimits
from hexmend.study.batch.local import Local
from hexmend.study.batch.peer_case import PeerCase
from hexmend.study.batch.plan import Plan
from hexmend.study.batch.runner import StudyResult, run_study
from hexmend.study.batch.store import Store
from hexmend.study.batch.table_columns import Status
from hexmend.study.bench.collection import find_meshes
from hexmend.study.bench.sections import machine
from hexmend.study.peers import OWN, PEERS, MissingPeer, Peer
from hexmend.study.peers.peer import PYTHON_VARIABLE
from hexmend.terminal_text import printable

_MAX_SECONDS = 60.0


def run(args: argparse.Namespace) -> int:
    """Run the programs and write the report; return 3 if one of Hexmend is missing, 128 and a signal's number."""
    limit, jobs = _limits(args)
    page = Path(args.page) if args.page else None
    if page:
        read_page(page)  # refused before the work
    if args.peer_python:
        os.environ[PYTHON_VARIABLE] = args.peer_python  # inherited by the processes of tasks
    meshes = find_meshes(map(Path, args.folders))
    folder = output_folder(args.output or "collection")
    programs, cases = _programs([*PEERS.values()] if args.peers else [*OWN])
    plan = Plan("Collection", tuple(cases), TaskLimits(max_seconds=limit))
    with FinishWriting():
        with CleanExit() as signals, TaskProgress() as progress:
            store, workers = Store(output_folder(folder / "tasks")), Local(jobs, threads=1)
            options = {"version": __version__, "again": args.again, "watch": progress.show}
            study = run_study(plan, meshes, store, workers, **options)
            pictures, problem = {}, ""
            if not (study.interrupted or args.no_pictures):
                pictures, problem = draw_pictures(study.rows, output_folder(folder / "pictures"), jobs)
        record = CollectionRecord(study.rows, programs, study.progress.tasks, machine(), limit, pictures)
        _write_report(folder, page, record, study)
        if problem:
            print(printable(f"hexmend: without pictures of some meshes: {problem}"), file=sys.stderr)
    if study.interrupted:
        return signals.status
    own = [row for row in study.rows if row["method"] in {peer.name for peer in OWN}]
    return 3 if any(row["status"] != Status.DONE for row in own) else 0


def _limits(args: argparse.Namespace) -> tuple[float, int]:
    limit = _MAX_SECONDS if args.max_seconds is None else args.max_seconds
    if not 1 <= limit <= 1e6:
        raise ParameterError(f"--max-seconds {limit:g}: expected a number from 1 to 1e6")
    jobs = 1 if args.jobs is None else args.jobs
    if jobs < 1:
        raise ParameterError(f"--jobs {jobs} is too small: expected a whole number from 1")
    return limit, jobs


def _programs(peers: list[Peer]) -> tuple[list[Program], list[PeerCase]]:
    """Return the programs for the report, and a case for each that is installed."""
    programs, cases = [], []
    for peer in peers:
        version, missing = "", ""
        try:
            version = peer.version()
            cases.append(PeerCase(peer, version))
        except MissingPeer as error:
            missing = str(error)
        own = peer in OWN
        programs.append(Program(peer.title, peer.note, version, own, peer.slides, peer.shape, missing))
    return programs, cases


def _write_report(folder: Path, page: Path | None, record: CollectionRecord, study: StudyResult) -> None:
    """Write the tables, and print those of the programs, the meshes and the objective, and the failures."""
    paths = write_collection(folder, record)
    if page:
        replace_tables(page, record)
    for table in collection_tables(record):
        print_table(table)
    own = {program.title for program in record.programs if program.own}
    for mesh, cases, status, reason in failures([row for row in study.rows if row["case"] in own]):
        print(printable(f"hexmend: {mesh}, {cases}: {status}: {reason}"), file=sys.stderr)
    print(f"Written to {folder}: {', '.join(path.name for path in paths)}.")
    if study.interrupted:
        print("Interrupted: finished results are kept; run the same command again to continue.", file=sys.stderr)
