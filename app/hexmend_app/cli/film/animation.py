"""Implementation of `hexmend film`."""

from __future__ import annotations

import argparse
from pathlib import Path

from hexmend.cli.arguments.run_arguments import check_memory, method_and_limits, with_surface
from hexmend.cli.output.progress import follow, show_count
from hexmend.io import read
from hexmend.io.storage.atomic import check_writable
from hexmend.run import iterate
from hexmend_app.cli import scene_options
from hexmend_app.cli.numbers import page_size, parse_integer
from hexmend_app.picture.displacement import Displacement, ReferenceState
from hexmend_app.scene.film.film_files import format_of, write_film
from hexmend_app.scene.film.film_frames import chosen_iterations, pictures
from hexmend_app.state.mesh.document import MeasuredMesh
from hexmend_app.state.mesh.history import History
from hexmend_app.state.mesh.run_record import RecordedIteration


def run(args: argparse.Namespace) -> int:
    """Run the method, draw the frames and write the animation."""
    path = Path(args.output)
    movements = {key: value for key, value in (("arrows", args.arrows), ("since", args.since)) if value}
    scene = scene_options.scene(args, page=page_size(args.size), movement=movements)
    max_frames, rate = parse_integer(args.frames, "--frames", 2, 1000), parse_integer(args.rate, "--rate", 1, 50)
    method, stop = method_and_limits(args)
    format_of(path)  # raises for an unknown suffix before the run
    check_writable(path)
    mesh = with_surface(args, read(args.mesh), method)
    check_memory(args, [method], mesh)
    run, history = iterate(mesh, method, stop), History()
    record = history.begin(method.title, MeasuredMesh.of(mesh))
    history.add(record, run.start)
    follow(run, lambda iteration: history.add(record, iteration))
    numbers = chosen_iterations(history, record, max_frames)
    start = ReferenceState(mesh.points, run.start.quality, "before the run")
    movement = Displacement(mesh, start, mesh.points, run.start.quality) if scene.shows_movement else None
    frames = pictures(
        record,
        numbers,
        lambda number: history.state(RecordedIteration(record, number), mesh),
        scene,
        movement=movement,
        histogram=args.histogram,
        before=args.before,
    )
    drawn = [*show_count(frames, len(numbers), "drawing frames")]
    write_film(path, drawn, rate, poster=args.poster)
    result = run.result()
    print(result.message)
    if result.surface is not None:
        print(result.surface.sentence)
    print(f"{path}: {len(numbers)} frames of {drawn[0].width} × {drawn[0].height} pixels")
    return 0
