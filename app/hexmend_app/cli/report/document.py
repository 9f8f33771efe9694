"""Implementation of `hexmend report`."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Generator, Iterator
from dataclasses import dataclass, field, replace
from pathlib import Path

from hexmend.cli.arguments.run_arguments import check_memory
from hexmend.cli.output.progress import Progress, show_count
from hexmend.cli.process.interrupts import CleanExit, FinishWriting
from hexmend.run import StoppingCriteria
from hexmend.run.recipe import Recipe
from hexmend.smoothers import Smoother
from hexmend.terminal_text import printable
from hexmend_app.cli import run_options, scene_options
from hexmend_app.report import case, page
from hexmend_app.report.case import command_line
from hexmend_app.report.figure_set import Figure, Style, check_pages
from hexmend_app.report.page import Chapter


def run(args: argparse.Namespace) -> int:
    """Run the methods on each mesh and write the report; invalid options are reported before the runs."""
    path = Path(args.output)
    interactive = page.check_report(path)
    options = run_options.words(args, ("mesh", "output", "title", "force"))
    smoothers, stop = run_options.methods(args)
    names, scene = run_options.names(args, len(smoothers)), scene_options.scene(args)
    style = Style(replace(scene, page=replace(scene.page, dpi=scene.page.dpi or page.REPORT_DPI)))
    check_pages(style, 1 + len(smoothers))
    writer = _ChapterWriter(args, smoothers, stop, names, style, interactive)
    with FinishWriting() as writing:
        interrupted = writer.write(writing)
        title = printable(args.title or "") or f"Report on {', '.join(chapter.name for chapter in writer.chapters)}"
        title_option = ["--title", args.title] if args.title else []
        command = command_line(["report", *args.mesh, *options, *title_option, "-o", args.output])
        document = page.page(title, writer.chapters, command, interactive=interactive)
        page.write_report(path, document)
        print(f"{args.output}: {path.stat().st_size / 1e6:.1f} MB")
        if interrupted:
            print("Interrupted: the report shows the results so far.", file=sys.stderr)
    return interrupted.status if interrupted else 0


@dataclass
class _ChapterWriter:
    """Writer of the chapters of a report, one for each mesh."""

    args: argparse.Namespace
    smoothers: list[Smoother | Recipe]
    stop: StoppingCriteria
    names: list[str]
    style: Style
    interactive: bool
    chapters: list[Chapter] = field(default_factory=list)

    def write(self, writing: FinishWriting) -> CleanExit | FinishWriting | None:
        """Add the chapters of all meshes; return the block interrupted by a signal, which ends the report early."""
        for path in self.args.mesh:
            signals = CleanExit()
            try:
                with signals:
                    mesh, source = case.source_of(path)
                    check_memory(self.args, self.smoothers, mesh, "report on fewer methods (--methods)")
                with Progress() as progress:
                    signals = progress.signals
                    done = case.run_methods(mesh, source, self.smoothers, self.stop, self.names, progress.show)
            except KeyboardInterrupt:
                if not self.chapters:
                    raise
                return signals
            self._add(done)
            if done.interrupted:
                return signals
            if writing.asked and len(self.chapters) < len(self.args.mesh):
                return writing
        return None

    def _add(self, done: case.Case) -> None:
        place = f"mesh-{len(self.chapters) + 1}"
        steps = page.draw_chapter(done, self.style, interactive=self.interactive, place=place)
        for _ in show_count(self._drawn(steps), len(page.figures_of(done)), f"drawing figures of {done.name}"):
            pass

    def _drawn(self, steps: Generator[Figure, None, Chapter]) -> Iterator[Figure]:
        """Yield the figures of a chapter one by one, and add the chapter."""
        self.chapters.append((yield from steps))
