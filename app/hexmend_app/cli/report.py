"""`hexmend report`: one page on meshes and on what methods make of them, to be kept, sent and printed."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

from hexmend_app.cli import runs

#: What a report can be written as.
_SUFFIXES = (".html", ".pdf")

#: Pixels per inch of the pictures.
_DPI = 220.0


class Report:
    """A report as HTML or PDF."""

    name = "report"
    help = "Write a report on meshes, before and after, with all that is known of them: one HTML page, or PDF."

    def arguments(self, parser: argparse.ArgumentParser) -> None:
        parser.add_argument("mesh", metavar="MESH", nargs="+", help="the mesh files")
        parser.add_argument("-o", "--output", metavar="FILE", required=True, help="the report: .html or .pdf")
        parser.add_argument("--title", metavar="TEXT", help="the page's title")
        runs.add_arguments(parser)

    def run(self, args: argparse.Namespace) -> int:
        from dataclasses import replace

        from hexmend.cli.arguments.checks import check_memory
        from hexmend.cli.output.progress import Progress
        from hexmend.cli.process.interrupts import CleanExit, FinishWriting
        from hexmend.io.storage.atomic import check_writable
        from hexmend.io.storage.suffixes import suffix_for
        from hexmend.report.charts import check_matplotlib
        from hexmend.terminal_text import printable
        from hexmend_app.scene.graphics import prepare_off_screen

        path = Path(args.output)
        alive = suffix_for(path, "a report", _SUFFIXES) == ".html"
        check_writable(path)  # what is wrong is said before the work, not after
        check_matplotlib()
        given = runs.words(args, ("mesh", "output", "title", "force"))
        smoothers, stop = runs.methods(args)
        names, scene = runs.names(args, len(smoothers)), runs.scene(args)
        prepare_off_screen()
        from hexmend_app.report.case import command_line, run_methods, source_of
        from hexmend_app.report.figure_set import Style, check_pages
        from hexmend_app.report.page import Chapter, chapter, page, write_page
        from hexmend_app.report.paper import check_paper, write_paper

        if not alive:
            check_paper()
        style = Style(replace(scene, page=replace(scene.page, dpi=scene.page.dpi or _DPI)))
        check_pages(style, 1 + len(smoothers))
        chapters: list[Chapter] = []
        folders: list[str] = []
        ended: CleanExit | None = None  # the block in which a signal came
        with FinishWriting() as writing:
            for number, one in enumerate(args.mesh, 1):
                signals = CleanExit()
                try:
                    with signals:
                        mesh, source = source_of(one)
                        check_memory(args, smoothers, mesh, "report on fewer methods (--methods)")
                    with Progress() as progress:
                        signals = progress.signals
                        case = run_methods(mesh, source, smoothers, stop, names, progress.show)
                except KeyboardInterrupt:
                    if not chapters:
                        raise
                    ended = signals
                    break
                folders.append(_unlike(folders, case.name, printable(Path(one).resolve().parent.name)))
                again = _again(one, folders[-1], given, runs.method_words(args))
                chapters.append(chapter(case, style, again, alive=alive, place=f"mesh-{number}"))
                if case.interrupted:
                    ended = signals
                elif writing.asked and number < len(args.mesh):
                    ended = writing
                if ended:
                    break
            title = printable(args.title or "") or f"Report on {', '.join(one.name for one in chapters)}"
            titled = ["--title", args.title] if args.title else []
            command = command_line(["report", *args.mesh, *given, *titled, "-o", args.output])
            (write_page if alive else write_paper)(path, page(title, chapters, command, alive=alive))
            print(f"{args.output}: {path.stat().st_size / 1e6:.1f} MB")
            if ended:
                print("Interrupted: the report holds what was done so far.", file=sys.stderr)
        return ended.status if ended else 0


def _unlike(taken: list[str], name: str, folder: str) -> str:
    """What folders of a mesh are called: by its name or, where that is taken, with its folder's before or a number.

    >>> _unlike([], "part", "a"), _unlike(["part"], "part", "b"), _unlike(["part", "b-part"], "Part", "b")
    ('part', 'b-part', 'Part-2')
    """
    known = {one.lower() for one in taken}  # some file systems do not tell capitals
    names = (
        name,
        *([f"{folder}-{name}"] if folder else []),
        *(f"{name}-{number}" for number in range(2, len(taken) + 3)),
    )
    return next(one for one in names if one.lower() not in known)


def _again(path: str, name: str, given: list[str], methods: list[str]) -> list[list[str]]:
    """Commands that tell of a mesh what the report does."""
    name = f"./{name}" if name.startswith("-") else name  # which would be an option
    again = [["info", path, "--doctor", "--metrics"], ["figures", path, *given, "-o", f"{name}-figures"]]
    return [*again, ["compare", path, *methods, "--write-meshes", "-o", f"{name}-results"]] if methods else again


command = Report()
