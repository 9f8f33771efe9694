"""The command line of the benchmarks: `python -m benchmarks --help` lists what there is."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

from benchmarks.peers import compare
from benchmarks.sections import SECTIONS
from benchmarks.thesis import pages, study
from benchmarks.window import soak
from hexmend.errors import HexmendError
from hexmend.report.records import write_json
from hexmend.study.machine import machine


def bench(names: list[str], json: str | None) -> None:
    """Measure sections, all by default, and print each when it is done; optionally write the figures as JSON."""
    report = {"machine": machine()}
    print(", ".join(f"{key} {value}" for key, value in report["machine"].items()))
    for name in names or SECTIONS:
        section = SECTIONS[name]
        print(f"\n{section.title}", flush=True)
        report[name] = section.measure()
        for line in section.lines(report[name]):
            print(f"  {line}", flush=True)
    if json:
        write_json(json, report)


def parser() -> argparse.ArgumentParser:
    """Return the parser of the command line."""
    words = argparse.ArgumentParser(
        prog="python -m benchmarks",
        description="Measure Hexmend.",
        epilog="sections of bench:\n" + "\n".join(f"  {name:<17} {one.title}" for name, one in SECTIONS.items()),
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    commands = words.add_subparsers(required=True, metavar="COMMAND")
    command = commands.add_parser("bench", help="measure sections of the list below: speed, memory, quality")
    command.add_argument("names", metavar="SECTION", nargs="*", choices=[[], *SECTIONS], help="all by default")
    command.add_argument("--json", metavar="FILE", help="write the figures")
    command.set_defaults(run=lambda args: bench(args.names, args.json))

    command = commands.add_parser("thesis", help="repeat the experiments of Chapter 4 and section 5.2 of the thesis")
    command.add_argument("-o", "--output", metavar="DIR", required=True, help="folder of the report")
    command.add_argument("--quick", action="store_true", help="small meshes and a few seconds per run")
    command.add_argument("--max-seconds", metavar="S", type=float, help="time limit of a run (default 4 hours)")
    text = "a table, such as 4.1, or a section, such as 5.2.5; may be repeated"
    command.add_argument("--only", metavar="TABLE", action="append", default=[], help=text)
    command.set_defaults(run=lambda args: study.run(args.output, args.quick, args.max_seconds, args.only))

    command = commands.add_parser("pages", help="write the pages of results from the report of thesis and two sections")
    for name in ("study", "offsets", "remarks"):
        command.add_argument(name, metavar=name.upper(), type=Path)
    command.set_defaults(run=lambda args: pages.write(args.study, args.offsets, args.remarks))

    command = commands.add_parser("peers", help="smooth meshes with Hexmend and the other programs that are installed")
    command.add_argument("places", metavar="FOLDER", nargs="+", help="folders of meshes, or meshes")
    text = "time limit of a program for a mesh (default %(default)g)"
    command.add_argument("--max-seconds", metavar="S", type=float, default=60.0, help=text)
    command.add_argument("--page", metavar="FILE.md", help="write the tables into a page, between its marks for them")
    command.set_defaults(run=lambda args: compare.run(args.places, args.max_seconds, args.page))

    command = commands.add_parser("soak", help="work for hours in one window, and check that its memory does not grow")
    command.add_argument("meshes", metavar="MESH", nargs="*", help="used in turn (default: the demo mesh)")
    command.add_argument("--minutes", metavar="N", type=float, default=60.0, help="default %(default)g")
    command.set_defaults(run=lambda args: soak.run(args.meshes, args.minutes))
    return words


def main() -> int:
    """Run the command line and return the exit status."""
    args = parser().parse_args()
    try:
        return args.run(args) or 0
    except HexmendError as error:
        print(f"benchmarks: {error}", file=sys.stderr)
        return 2


if __name__ == "__main__":
    sys.exit(main())
