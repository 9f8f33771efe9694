"""Implementation of `hexmend film`."""

from __future__ import annotations

import argparse
from dataclasses import replace
from pathlib import Path

from hexmend.cli.arguments.run_arguments import check_memory, method_and_limits, with_surface
from hexmend.cli.output.progress import follow, show_count
from hexmend.io import read
from hexmend.io.storage.atomic import check_writable
from hexmend.run import iterate
from hexmend_app.cli.numbers import invalid_value, parse_integer, parse_size
from hexmend_app.cli.scene_options import with_options
from hexmend_app.picture import Scene
from hexmend_app.picture.appearance import Arrows, Since, Traces
from hexmend_app.picture.displacement import Displacement, ReferenceState
from hexmend_app.scene.film.film_files import format_of, write_film
from hexmend_app.scene.film.film_frames import chosen_iterations, film_frames, pictures
from hexmend_app.state.mesh.document import State
from hexmend_app.state.mesh.history import History
from hexmend_app.state.mesh.run_record import RecordedIteration


def run(args: argparse.Namespace) -> int:
    """Run the method, draw the frames and write the animation."""
    path, size = Path(args.output), parse_size(args.size)
    scene = replace(with_options(args, Scene(), page={"pixels": size}), movement=_traces(args))
    max_frames, rate = parse_integer(args.frames, "--frames", 2, 1000), parse_integer(args.rate, "--rate", 1, 50)
    method, stop = method_and_limits(args)
    format_of(path)  # raises for an unknown suffix before the run
    check_writable(path)
    mesh = with_surface(args, read(args.mesh), method)
    check_memory(args, [method], mesh)
    run, history = iterate(mesh, method, stop), History()
    record = history.begin(method.title, State.of(mesh))
    history.add(record, run.start)
    follow(run, lambda iteration: history.add(record, iteration))
    numbers = chosen_iterations(history, record, max_frames)
    start = ReferenceState(mesh.points, run.start.quality, "before the run")
    movement = Displacement(mesh, start, mesh.points, run.start.quality) if args.arrows else None
    states = film_frames(record, numbers, lambda number: history.state(RecordedIteration(record, number), mesh))
    frames = pictures(states, scene, movement=movement, histogram=args.histogram, before=args.before)
    drawn = [*show_count(frames, len(numbers), "drawing frames")]
    write_film(path, drawn, rate, poster=args.poster)
    result = run.result()
    print(result.message)
    if result.surface is not None:
        print(result.surface.sentence)
    print(f"{path}: {len(numbers)} frames of {size[0]} × {size[1]} pixels")
    return 0


def _traces(args: argparse.Namespace) -> Traces:
    """Return the settings of displacement arrows."""
    nodes, since = args.arrows or "none", args.since or "run"
    if nodes not in list(Arrows):
        raise invalid_value("--arrows", nodes, "sight or all")
    if since not in (Since.RUN, Since.ITERATION):
        raise invalid_value("--since", since, "run or iteration")
    return Traces(since=Since(since), arrows=Arrows(nodes))
