"""Benchmark of several views: milliseconds per frame while they rotate, and to open a view."""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial
from time import perf_counter
from typing import Any

import numpy as np

from benchmarks.section import BenchSection
from benchmarks.window.windows import draw, measure_meshes, report, rotation_frame_ms, run_event_loop
from hexmend.gallery import make
from hexmend_app.shell.window import Window
from hexmend_app.state.mesh.document import MeasuredMesh

_SIZES: Any = (("bridge-sharp", {}), ("five-side", {"size": 110450}))


def _measure() -> dict[str, Any]:
    return measure_meshes((make(name, **size) for name, size in _SIZES), _row)


def _row(window: Window) -> dict[str, Any]:
    """Return the milliseconds per frame of one, two and four views and a wipe, and to open the second view."""
    rotation = {"1 view": rotation_frame_ms(window)}
    states = _other_states(window)
    start = perf_counter()
    window.session.side_views.show("0", states[0])
    draw(window)
    opening = 1e3 * (perf_counter() - start)
    rotation["2 views"] = rotation_frame_ms(window)
    for k in (1, 2):
        window.session.side_views.show(str(k), states[k])
    rotation["4 views"] = rotation_frame_ms(window)
    window.session.side_views.set_wiping(True)
    rotation["wipe"] = rotation_frame_ms(window)
    wiping = []
    for at in np.linspace(0.2, 0.8, 20):
        start = perf_counter()
        window.session.side_views.move_wipe(float(at))
        draw(window)
        wiping.append(1e3 * (perf_counter() - start))
    run_event_loop(0.1)
    view = [window.canvas.interactor.width(), window.canvas.interactor.height()]
    return {"view": view, "turning_ms": rotation, "opening_ms": opening, "wiping_ms": float(np.median(wiping))}


def _other_states(window: Window) -> list[MeasuredMesh]:
    mesh = window.session.document.now.mesh
    shifts = mesh.mean_edge_length * 0.005 * np.random.default_rng(0).normal(size=(3, *mesh.points.shape))
    return [MeasuredMesh.of(mesh.with_points(mesh.points + shift * mesh.free[:, None])) for shift in shifts]


def _lines(row: dict[str, Any]) -> Iterator[str]:
    yield f"{row['mesh']}, {row['hexes']:,} hexes, {row['view'][0]} × {row['view'][1]} pixels in total"
    for name, ms in row["turning_ms"].items():
        yield f"  rotating, {name:<8} {ms:6.1f} ms  ({1000 / ms:4.0f} per second)"
    yield f"  dragging the wipe  {row['wiping_ms']:6.1f} ms; opening another view takes {row['opening_ms']:.0f} ms"


VIEWS = BenchSection(
    "views", "The viewer: several views side by side (medians)", _measure, partial(report, lines=_lines)
)
