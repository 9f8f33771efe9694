"""Implementation of `hexmend figures`."""

from __future__ import annotations

import argparse
import sys

from hexmend.cli.arguments.run_arguments import check_memory
from hexmend.cli.output.progress import Progress
from hexmend.cli.process.interrupts import FinishWriting
from hexmend.report.documents import output_folder
from hexmend_app.cli import run_options, scene_options
from hexmend_app.cli.numbers import invalid_value, numbers
from hexmend_app.report import figure_set
from hexmend_app.report.case import command_line, run_methods, source_of
from hexmend_app.report.charts import WIDTHS, check_matplotlib
from hexmend_app.report.figure_captions import write_captions
from hexmend_app.report.figure_set import PARTS, Style, check_pages

#: Suffixes of figures.
_FORMATS = ("png", "pdf", "svg")


def run(args: argparse.Namespace) -> int:
    """Run the methods, draw the figures and write them; invalid options are reported before the runs."""
    check_matplotlib()
    options = run_options.words(args, ("mesh", "output", "only", "force"))
    smoothers, stop = run_options.methods(args)
    names = run_options.names(args, len(smoothers))
    style = _style(args)
    for part in args.only:
        if part not in PARTS:
            raise invalid_value("--only", part, f"one of {', '.join(PARTS)}")
    check_pages(style, 1 + len(smoothers), args.only)
    mesh, source = source_of(args.mesh)
    check_memory(args, smoothers, mesh, "draw fewer methods (--methods)")
    folder = output_folder(args.output)
    with FinishWriting():
        with Progress() as progress:
            case = run_methods(mesh, source, smoothers, stop, names, progress.show)
        figures = []
        for figure in figure_set.write_figures(case, folder, style, args.only):
            figures.append(figure)
            print(f"{', '.join(path.name for path in figure.paths)}: {figure.caption}", flush=True)
        command = ["figures", args.mesh, *options, "-o", args.output, "--only"]
        if not args.only:
            write_captions(folder, case.name, [(figure, command_line([*command, figure.part])) for figure in figures])
        for row in case.failed:
            print(f"hexmend: {row.method}: {row.message}", file=sys.stderr)
        print(f"Written to {args.output}{'' if args.only else ', with captions.md and commands.sh'}.")
        if case.interrupted:
            print("Interrupted: the figures show what was done so far.", file=sys.stderr)
    return progress.signals.status if case.interrupted else 0


def _formats(args: argparse.Namespace) -> tuple[str, ...]:
    formats = tuple(args.format.lower().split(",")) if args.format else _FORMATS[:1]
    for name in formats:
        if name not in _FORMATS:
            raise invalid_value("--format", args.format, f"names among {', '.join(_FORMATS)}, separated by commas")
    return formats


def _style(args: argparse.Namespace) -> Style:
    (width,) = numbers(args.width_mm, 1, "--width-mm") if args.width_mm else (170.0,)
    if not WIDTHS[0] <= width <= WIDTHS[1]:
        raise invalid_value("--width-mm", args.width_mm, f"a width from {WIDTHS[0]:g} to {WIDTHS[1]:g} mm")
    return Style(scene_options.scene(args), width, _formats(args))
