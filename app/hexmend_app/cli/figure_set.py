"""`hexmend figures`: the pictures, plots and tables of a paper, with captions and the commands that repeat them."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path
from typing import TYPE_CHECKING

from hexmend_app.cli import runs
from hexmend_app.cli.numbers import numbers, wrong

if TYPE_CHECKING:
    from hexmend_app.report.figure_set import Style

#: Kinds of file that figures are written as.
_FORMATS = ("png", "pdf", "svg")

#: The mesh of the gallery whose figures the thesis has, and its table.
_THESIS = {"plane": "4.14"}


class Figures:
    """A figure set."""

    name = "figures"
    help = (
        "Write the figure set of a mesh: before and after, distributions, convergence, the table, captions, commands."
    )

    def arguments(self, parser: argparse.ArgumentParser) -> None:
        parser.add_argument("mesh", metavar="MESH", help="the mesh file; with --thesis, plane")
        parser.add_argument("-o", "--output", metavar="DIR", required=True, help="folder of the figures")
        parser.add_argument("--format", metavar="A,B,...", help="png, pdf, svg (default png)")
        parser.add_argument("--width-mm", metavar="X", help="of each figure, in mm (default 170)")
        parser.add_argument(
            "--only",
            metavar="PART",
            action="append",
            default=[],
            help="surface, cut, distributions, convergence, table",
        )
        runs.add_arguments(parser)
        parser.add_argument("--thesis", action="store_true", help="figures 4.5 to 4.9 of the thesis, of the mesh plane")
        parser.add_argument("--quick", action="store_true", help="with --thesis: a few seconds a run")

    def run(self, args: argparse.Namespace) -> int:
        from hexmend.report.charts import check_matplotlib
        from hexmend_app.scene.graphics import prepare_off_screen

        check_matplotlib()
        if args.thesis:
            return _thesis(args)
        if args.quick:
            raise wrong("--quick", "", "--thesis beside it")
        given = runs.words(args, ("mesh", "output", "only", "force"))
        smoothers, stop = runs.methods(args)
        names = runs.names(args, len(smoothers))
        style = _style(args)
        prepare_off_screen()
        from hexmend.cli.arguments.checks import check_memory
        from hexmend.cli.output.progress import Progress
        from hexmend.cli.process.interrupts import FinishWriting
        from hexmend.report import output_folder
        from hexmend_app.report.captions import write_captions
        from hexmend_app.report.case import command_line, run_methods, source_of
        from hexmend_app.report.figure_set import PARTS, check_pages, write_figures

        for part in args.only:
            if part not in PARTS:
                raise wrong("--only", part, f"one of {', '.join(PARTS)}")
        check_pages(style, 1 + len(smoothers), args.only)
        mesh, source = source_of(args.mesh)
        check_memory(args, smoothers, mesh, "draw fewer methods (--methods)")
        folder = output_folder(args.output)
        with FinishWriting():
            with Progress() as progress:
                case = run_methods(mesh, source, smoothers, stop, names, progress.show)
            figures = []
            for figure in write_figures(case, folder, style, args.only):
                figures.append(figure)
                print(f"{', '.join(path.name for path in figure.paths)}: {figure.caption}", flush=True)
            again = ["figures", args.mesh, *given, "-o", args.output, "--only"]
            if not args.only:
                write_captions(folder, case.name, [(one, command_line([*again, one.part])) for one in figures])
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
            raise wrong("--format", args.format, f"names among {', '.join(_FORMATS)}, separated by commas")
    return formats


def _style(args: argparse.Namespace) -> Style:
    from hexmend.report.charts import WIDTHS
    from hexmend_app.report.figure_set import Style

    (width,) = numbers(args.width_mm, 1, "--width-mm") if args.width_mm else (170.0,)
    if not WIDTHS[0] <= width <= WIDTHS[1]:
        raise wrong("--width-mm", args.width_mm, f"a width from {WIDTHS[0]:g} to {WIDTHS[1]:g} mm")
    return Style(runs.scene(args), width, _formats(args))


def _thesis(args: argparse.Namespace) -> int:
    """The thesis's figures of a mesh of the gallery, measured and drawn again."""
    from hexmend.cli.arguments.run_arguments import given_limits
    from hexmend.cli.output.progress import Progress
    from hexmend.cli.process.interrupts import FinishWriting
    from hexmend.errors import HexmendError
    from hexmend.report import output_folder
    from hexmend.report.thesis import write_plots
    from hexmend.study.thesis.experiments import load
    from hexmend.study.thesis.mesh_figures import draw_figures
    from hexmend.study.thesis.runner import run_experiments, select_tables
    from hexmend_app.report.captions import write_captions
    from hexmend_app.report.case import command_line
    from hexmend_app.report.figure_set import Figure

    if args.mesh not in _THESIS:
        raise wrong("--thesis", args.mesh, f"a mesh of the gallery: {', '.join(_THESIS)}")
    formats = _formats(args)
    for option, value in (("--width-mm", args.width_mm), ("--only", ",".join(args.only)), ("--scene", args.scene)):
        if value:
            raise wrong(option, value, "no --thesis beside it, whose figures are as the thesis has them")
    thesis = select_tables(load(), [_THESIS[args.mesh]])
    if "max_seconds" in given_limits(args):
        thesis = thesis.with_max_seconds(given_limits(args)["max_seconds"])
    folder = output_folder(args.output)
    with FinishWriting():
        with Progress() as progress:
            study = run_experiments(thesis, quick=args.quick, watch=progress.show)
        drawn, missing = draw_figures(folder, study.results, formats)
        if missing:
            raise HexmendError(missing)
        plotted, _ = write_plots(folder, study.record(), formats)
        figures = []
        for one in sorted([*drawn, *plotted], key=lambda one: one["number"]):
            files = [Path(one["file"]).with_suffix(f".{suffix}") for suffix in formats]
            figures.append(Figure(one["number"], f"{one['caption']}.", tuple(folder / file for file in files)))
            print(f"{', '.join(map(str, files))}: {one['caption']}.")
        again = command_line(["figures", args.mesh, *runs.words(args, ("mesh", "output")), "-o", args.output])
        write_captions(folder, args.mesh, [(one, again) for one in figures])
        print(f"Written to {args.output}, with captions.md and commands.sh.")
    return progress.signals.status if study.interrupted else 0


command = Figures()
