"""Puts small faults into copies of the core, one at a time, and counts those that the core's tests find.

Use: python scripts/mutants.py [--count N] [--seed S] [--only PATH]... [--jobs N] [--seconds S] [--again ID]...
     [--native]

Each fault (a mutant) changes one piece of a source: a comparison, a sign, a constant, a statement that is left out...
They are chosen at random, evenly over the lines of the sources. Those tests run that execute the changed line, the
likeliest first, until one fails or they have taken 30 seconds. Faults that change no result are listed with the reason
in mutants_equivalent.toml. With --native, faults listed in mutants_native.toml are put into the C++ sources and the
kernels are built with each.

Results are kept in build/mutants, so that a run can be interrupted and continued: a fault is not tried again until
the tests that were chosen for it have changed.

The exit status is 1 where less than 90 % are found, or the trial of a fault ended with an error.
"""

from __future__ import annotations

import argparse
import os
import signal
import sys
from collections.abc import Sequence
from pathlib import Path

from mutation.campaign import Results, Row, try_all
from mutation.equivalents import Equivalents
from mutation.native import NativeMutants
from mutation.operators import Mutant, mutants
from mutation.project import Project
from mutation.reach import Reach
from mutation.sampling import sample
from mutation.table import as_text, share_found
from mutation.trial import ERROR

#: Share of the faults that tests must find.
WANTED = 0.9

ROOT = Path(__file__).resolve().parents[1]
EQUIVALENT, NATIVE = (Path(__file__).with_name(f"mutants_{name}.toml") for name in ("equivalent", "native"))

HEXMEND = Project(
    root=ROOT, tests=("core/hexmend", "tests/core"), imports=("core", "app"), build=ROOT / "build" / "mutants"
)
#: Sources in which faults are made, and those of them that write files.
FOLDERS = "optimise", "iteration", "smoothers", "quality", "run", "boundary"
FILES = "mesh/orientation.py", "io/storage/atomic.py"


def hexmend_sources() -> list[str]:
    """Paths of the sources that are given faults, from the project's root."""
    core = ROOT / "core" / "hexmend"
    found = [path for folder in FOLDERS for path in sorted((core / folder).rglob("*.py"))]
    found += [core / name for name in FILES] + sorted((core / "io/formats").rglob("*writer.py"))
    return [path.relative_to(ROOT).as_posix() for path in found]


def chosen(project: Project, sources: Sequence[str], asked: argparse.Namespace) -> list[Mutant]:
    """Mutants that the options ask for."""
    texts = {path: project.read(path) for path in sources}
    if asked.again:
        return [mutant for path, text in texts.items() for mutant in mutants(path, text) if mutant.id in asked.again]
    if asked.only:
        texts = {path: text for path, text in texts.items() if any(path.startswith(one) for one in asked.only)}
    return sample(texts, asked.count, asked.seed)


def main(
    arguments: Sequence[str] | None = None, project: Project = HEXMEND, sources: Sequence[str] | None = None
) -> list[Row]:
    """Try the mutants that the arguments ask for, print what became of them, and return it."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--count", type=int, default=200, help="how many mutants (200)")
    parser.add_argument("--seed", type=int, default=29, help="of the choice (29)")
    parser.add_argument("--only", action="append", metavar="PATH", help="sources whose paths begin so")
    parser.add_argument("--jobs", type=int, default=os.cpu_count() or 1, help="processes at a time (one per core)")
    parser.add_argument(
        "--seconds", type=float, default=30.0, help="of tests for each mutant; the likeliest to find it are taken (30)"
    )
    parser.add_argument("--again", action="append", metavar="ID", help="try this mutant, whatever is known of it")
    parser.add_argument("--native", action="store_true", help="faults of the C++ sources, by mutants_native.toml")
    asked = parser.parse_args(arguments)
    sources = hexmend_sources() if sources is None else sources

    project.build.mkdir(parents=True, exist_ok=True)
    results = Results(project.build / ("native.json" if asked.native else "results.json"))
    for name in asked.again or ():
        results.rows.pop(name, None)
    reach = Reach(project, sources, asked.seconds)
    reach.measure(asked.jobs)
    if left_out := reach.left_out():
        print(f"Left out: {len(left_out)} tests that fail or are skipped without a fault.")
    if asked.native:
        ids = NativeMutants(project, NATIVE).try_all(reach, results, asked.again)
    else:
        sampled = chosen(project, sources, asked)
        ids = [mutant.id for mutant in sampled]
        try_all(project, reach, sampled, Equivalents(EQUIVALENT).reason, results, asked.jobs)
    rows = [results.rows[name] for name in ids]
    print("\n" + as_text(rows))
    return rows


def status(rows: Sequence[Row]) -> int:
    """Return the exit status: 0 where enough was found and every fault could be tried, else 1, and say why."""
    short, errors = share_found(rows) < WANTED, sum(row.outcome == ERROR for row in rows)
    if short:
        print(f"Less than {WANTED:.0%} are found: write tests that find the survivors.")
    if errors:
        print(f"{errors} could not be tried: see the errors above.")
    return int(short or errors > 0)


if __name__ == "__main__":
    for number in (signal.SIGINT, signal.SIGTERM):
        signal.signal(number, signal.default_int_handler)
    try:
        sys.exit(status(main()))
    except KeyboardInterrupt:
        sys.exit("interrupted: the same command goes on where this one ended")
