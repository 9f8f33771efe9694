"""The document of `hexmend report`."""

from __future__ import annotations

import argparse
import sys
from dataclasses import dataclass, field, replace
from pathlib import Path

from hexmend.cli.arguments.checks import check_memory
from hexmend.cli.output.progress import Progress
from hexmend.cli.process.interrupts import CleanExit, FinishWriting
from hexmend.io.storage.atomic import check_writable
from hexmend.io.storage.suffixes import suffix_for
from hexmend.report.charts import check_matplotlib
from hexmend.run import StoppingCriteria
from hexmend.run.recipe import Recipe
from hexmend.smoothers import Smoother
from hexmend.terminal_text import printable
from hexmend_app.cli import run_options
from hexmend_app.report import case, page
from hexmend_app.report.case import command_line
from hexmend_app.report.figure_set import Style, check_pages
from hexmend_app.report.page import Chapter, write_page
from hexmend_app.report.paper import check_paper, write_paper

#: Suffixes of reports.
_SUFFIXES = (".html", ".pdf")

#: Pixels per inch of the pictures.
_DPI = 220.0


def run(args: argparse.Namespace) -> int:
    """Run the methods on each mesh and write the report; what is wrong is reported before the runs."""
    path = Path(args.output)
    interactive = suffix_for(path, "a report", _SUFFIXES) == ".html"
    check_writable(path)
    check_matplotlib()
    options = run_options.words(args, ("mesh", "output", "title", "force"))
    smoothers, stop = run_options.methods(args)
    names, scene = run_options.names(args, len(smoothers)), run_options.scene(args)
    if not interactive:
        check_paper()
    style = Style(replace(scene, page=replace(scene.page, dpi=scene.page.dpi or _DPI)))
    check_pages(style, 1 + len(smoothers))
    chapters = _Chapters(args, options, smoothers, stop, names, style, interactive)
    with FinishWriting() as writing:
        ended = chapters.write(writing)
        title = printable(args.title or "") or f"Report on {', '.join(one.name for one in chapters.done)}"
        titled = ["--title", args.title] if args.title else []
        command = command_line(["report", *args.mesh, *options, *titled, "-o", args.output])
        document = page.page(title, chapters.done, command, interactive=interactive)
        (write_page if interactive else write_paper)(path, document)
        print(f"{args.output}: {path.stat().st_size / 1e6:.1f} MB")
        if ended:
            print("Interrupted: the report holds what was done so far.", file=sys.stderr)
    return ended.status if ended else 0


@dataclass
class _Chapters:
    """The chapters of a report, one for each mesh."""

    args: argparse.Namespace
    options: list[str]
    smoothers: list[Smoother | Recipe]
    stop: StoppingCriteria
    names: list[str]
    style: Style
    interactive: bool
    done: list[Chapter] = field(default_factory=list)
    folders: list[str] = field(default_factory=list)

    def write(self, writing: FinishWriting) -> CleanExit | FinishWriting | None:
        """Add the chapters of all meshes; return the block in which a signal came, which ends the report early."""
        for path in self.args.mesh:
            signals = CleanExit()
            try:
                with signals:
                    mesh, source = case.source_of(path)
                    check_memory(self.args, self.smoothers, mesh, "report on fewer methods (--methods)")
                with Progress() as progress:
                    signals = progress.signals
                    found = case.run_methods(mesh, source, self.smoothers, self.stop, self.names, progress.show)
            except KeyboardInterrupt:
                if not self.done:
                    raise
                return signals
            self._add(path, found)
            if found.interrupted:
                return signals
            if writing.asked and len(self.done) < len(self.args.mesh):
                return writing
        return None

    def _add(self, path: str, found: case.Case) -> None:
        self.folders.append(_unique_name(self.folders, found.name, printable(Path(path).resolve().parent.name)))
        commands = _commands(path, self.folders[-1], self.options, run_options.method_words(self.args))
        place = f"mesh-{len(self.done) + 1}"
        self.done.append(page.chapter(found, self.style, commands, interactive=self.interactive, place=place))


def _unique_name(taken: list[str], name: str, folder: str) -> str:
    """Return a name for the folders of a mesh: its own or, if that is taken, one with its folder's name or a number.

    >>> _unique_name(["part"], "part", "b"), _unique_name(["part", "b-part"], "Part", "b")
    ('b-part', 'Part-2')
    """
    known = {one.lower() for one in taken}  # some file systems do not distinguish capitals
    names = (
        name,
        *([f"{folder}-{name}"] if folder else []),
        *(f"{name}-{number}" for number in range(2, len(taken) + 3)),
    )
    return next(one for one in names if one.lower() not in known)


def _commands(path: str, name: str, options: list[str], methods: list[str]) -> list[list[str]]:
    """Return commands that give the same results for a mesh as the report."""
    name = f"./{name}" if name.startswith("-") else name  # otherwise it would be read as an option
    found = [["info", path, "--doctor", "--metrics"], ["figures", path, *options, "-o", f"{name}-figures"]]
    return [*found, ["compare", path, *methods, "--write-meshes", "-o", f"{name}-results"]] if methods else found
