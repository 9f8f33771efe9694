"""The command `hexmend bench`: speed and memory on this machine, or other programs on a collection of meshes."""

from __future__ import annotations

import argparse

from hexmend.cli.arguments.options import add_repeated
from hexmend.cli.command import action
from hexmend.errors import ParameterError

_PARTS = (
    "kernels, processes, iterations, preconditioners, optima, tangled, goals, boundaries, freedom, surfaces, "
    "surface-quality, offsets, remarks, sizes, scaling, scale, files, memory, start, viewer, filters, views, "
    "view-share or watching"
)
_COLLECTION = "collection"
_COLLECTION_OPTIONS = (
    "--peers", "--peer-python", "--max-seconds", "--jobs", "--again", "--no-pictures", "--page", "--output"
)  # fmt: skip


class BenchCommand:
    """Measure parts of Hexmend; or smooth the meshes of folders with it and with other programs."""

    name = "bench"
    help = "Measure speed and memory on this machine; or smooth a collection of meshes, also with other programs."

    def arguments(self, parser: argparse.ArgumentParser) -> None:
        parser.add_argument("folders", metavar="FOLDER", nargs="*", help="collection: folders of meshes, or meshes")
        text = f"{_PARTS}; may be repeated; or {_COLLECTION}, which needs FOLDER"
        add_repeated(parser, "--only", "PART", text)
        parser.add_argument("--json", metavar="FILE", help="write the figures")
        text = "collection: folder of the report and of finished results (default: collection)"
        parser.add_argument("-o", "--output", metavar="DIR", help=text)
        text = "collection: also run the other programs that are installed"
        parser.add_argument("--peers", action="store_true", help=text)
        text = "collection: Python with the packages of other programs (default: this one)"
        parser.add_argument("--peer-python", metavar="PYTHON", help=text)
        text = "collection: time limit of a program for a mesh in seconds (default 60)"
        parser.add_argument("--max-seconds", metavar="S", type=float, help=text)
        text = "collection: programs at a time, each on one thread (default 1)"
        parser.add_argument("--jobs", metavar="N", type=int, help=text)
        parser.add_argument("--again", action="store_true", help="collection: repeat results that are done")
        parser.add_argument("--no-pictures", action="store_true", help="collection: draw no pictures of the meshes")
        text = "collection: write the tables into this page of Markdown, between its marks for them (docs/peers.md)"
        parser.add_argument("--page", metavar="FILE.md", help=text)

    def run(self, args: argparse.Namespace) -> int:
        _check_options(args)
        kind = "collection_table" if _COLLECTION in args.only else "benchmarks"
        return action(f"hexmend.cli.commands.bench.{kind}")(args)


def _check_options(args: argparse.Namespace) -> None:
    """Raise `ParameterError` for options of the other kind of benchmark, and for a collection without meshes."""
    if _COLLECTION not in args.only:
        given = [option for option in _COLLECTION_OPTIONS if getattr(args, option.strip("-").replace("-", "_"))]
        for word in (*given, *args.folders):
            raise ParameterError(f"{word} is for a collection: leave it out, or add  --only {_COLLECTION}")
        return
    if set(args.only) != {_COLLECTION}:
        raise ParameterError(f"--only {_COLLECTION} is run alone: leave out the other parts")
    if args.json:
        raise ParameterError("--json: a collection is written as Markdown, CSV and HTML into a folder: use  -o DIR")
    if not args.folders:
        raise ParameterError(f"--only {_COLLECTION} needs a folder of meshes: add FOLDER...")


command = BenchCommand()
