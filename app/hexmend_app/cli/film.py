"""`hexmend film`: a moving picture of a run, without a window and without an X server."""

from __future__ import annotations

import argparse
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

from hexmend.cli.arguments.options import add_force, add_method
from hexmend_app.cli import looks
from hexmend_app.cli.numbers import whole, wrong

if TYPE_CHECKING:
    from hexmend_app.state.look import Traces


class Film:
    """A run as an animation."""

    name = "film"
    help = "Run a method and write an animation of its iterations: MP4, GIF, WebP or PNG, by the suffix."

    def arguments(self, parser: argparse.ArgumentParser) -> None:
        looks.prepare(parser)
        parser.add_argument("mesh", metavar="MESH", help="the mesh file")
        parser.add_argument("-o", "--output", metavar="FILE.gif", required=True, help="where to write the animation")
        add_method(parser)
        parser.add_argument("--frames", metavar="N", default="40", help="most frames (default %(default)s)")
        parser.add_argument("--rate", metavar="N", default="10", help="frames a second (default %(default)s)")
        looks.add_arguments(parser)
        parser.add_argument("--size", metavar="WxH", default="800x500", help="in pixels (default %(default)s)")
        parser.add_argument("--histogram", action="store_true", help="show the distribution beside the mesh")
        parser.add_argument("--arrows", metavar="WHICH", help="from where nodes were to where they are: sight or all")
        parser.add_argument("--since", metavar="WHEN", help="what arrows begin at: run (default) or iteration")
        add_force(parser)

    def run(self, args: argparse.Namespace) -> int:
        from hexmend.boundary.displacement import Displacement, ReferenceState
        from hexmend.cli.arguments.checks import check_memory
        from hexmend.cli.arguments.run_arguments import method_and_limits
        from hexmend.cli.output.progress import follow
        from hexmend.io import read
        from hexmend.run import iterate
        from hexmend_app.scene.graphics import prepare_off_screen

        size, view, path = looks.size_of(args.size), looks.view_of(args), Path(args.output)
        most, rate = whole(args.frames, "--frames", 2, 1000), whole(args.rate, "--rate", 1, 50)
        what, stop = method_and_limits(args)
        mesh = read(args.mesh)
        check_memory(args, [what], mesh)
        look = replace(looks.look_of(args, mesh), traces=_traces(args))
        prepare_off_screen()
        from hexmend_app.scene.export.film import format_of, pictures, write_film
        from hexmend_app.scene.export.shots import chosen as shown
        from hexmend_app.scene.export.shots import shots
        from hexmend_app.state.document import State
        from hexmend_app.state.history import History
        from hexmend_app.state.record import Moment as Shown

        format_of(path)  # an unknown suffix is said before the work, not after
        run, history = iterate(mesh, what, stop), History()
        record = history.begin(what.title, State.of(mesh))
        history.add(record, run.start)
        follow(run, lambda iteration: history.add(record, iteration))
        numbers = shown(history, record, most)
        start = ReferenceState(mesh.points, run.start.quality, "before the run")
        movement = Displacement(mesh, start, mesh.points, run.start.quality) if args.arrows else None
        taken = shots(record, numbers, lambda number: history.state(Shown(record, number), mesh))
        frames = pictures(taken, look, size, view=view, movement=movement, chart=args.histogram)
        write_film(path, [*frames], rate)
        print(f"{run.message}\n{path}: {len(numbers)} frames of {size[0]} × {size[1]} pixels")
        return 0


def _traces(args: argparse.Namespace) -> Traces:
    """What the options say of how the mesh has moved."""
    from hexmend_app.state.look import Arrows, Since, Traces

    which, when = args.arrows or "none", args.since or "run"
    if which not in ("none", "sight", "all"):
        raise wrong("--arrows", which, "sight or all")
    if when not in ("run", "iteration"):
        raise wrong("--since", when, "run or iteration")
    return Traces(since=Since(when), arrows=Arrows(which))


command = Film()
