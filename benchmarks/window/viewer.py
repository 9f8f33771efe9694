"""Benchmark of the viewer: milliseconds per frame, and delay of the event loop while a method runs."""

from __future__ import annotations

from collections.abc import Iterator
from statistics import median
from time import perf_counter
from typing import Any

import numpy as np
from PySide6.QtCore import QTimer

from benchmarks.section import BenchSection
from benchmarks.window.large_meshes import VARIABLE, lines_of, measure_large
from benchmarks.window.windows import draw, end_run, measure_meshes, report, run_event_loop
from hexmend.errors import HexmendError
from hexmend.gallery import make
from hexmend.run import StoppingCriteria
from hexmend.smoothers.local.steepest_descent import LocalSteepestDescent
from hexmend_app.picture import Cut, CutStyle
from hexmend_app.scene.geometry.frame import Frame
from hexmend_app.shell.window import Window
from hexmend_app.state.mesh.document import MeasuredMesh

_FRAMES = 40
_SECONDS = 6.0
_BEAT = 5  # milliseconds between two ticks of the timer


def _measure() -> dict[str, Any]:
    meshes = make("bridge-sharp"), make("five-side", size=110450)
    return measure_meshes(meshes, _row) | {"large": measure_large()}


def _report(figures: dict[str, Any]) -> list[str]:
    return report(figures, _lines) + lines_of(figures["large"])


def _row(window: Window) -> dict[str, Any]:
    view = [window.canvas.width(), window.canvas.height()]
    frames = {name: _frame(window, name) for name in ("whole", "crinkle", "smooth")}
    whole, vtk = ({name: both[part] for name, both in frames.items()} for part in (0, 1))
    return {"view": view, "frame_ms": whole, "vtk_ms": vtk, **_while_running(window)}


def _frame(window: Window, cut: str) -> tuple[float, float]:
    """Return the median milliseconds from new points and qualities to the screen, and of VTK's rendering."""
    start = window.session.document.start
    middle = tuple(start.mesh.points.mean(axis=0))
    window.session.view.set_handles(False)
    window.session.view.set_cut(Cut() if cut == "whole" else Cut.at((1, 0, 0), middle, CutStyle(cut)))
    shift = start.mesh.mean_edge_length * 0.05 * np.random.default_rng(0).normal(size=start.mesh.points.shape)
    shift *= start.mesh.free[:, None]
    states = [MeasuredMesh.of(start.mesh.with_points(start.mesh.points + share * shift)) for share in (0.0, 0.5, 1.0)]
    canvas = window.canvas
    draw(window)
    times, starts, vtk = [], [], []
    drawing = canvas.interactor.render_window
    observers = (
        drawing.AddObserver("StartEvent", lambda *_: starts.append(perf_counter())),
        drawing.AddObserver("EndEvent", lambda *_: vtk.append(perf_counter() - starts[-1])),
    )
    for k in range(_FRAMES):
        state = states[k % 3]
        start_time = perf_counter()
        canvas.draw(Frame(state.mesh, state.quality, look=window.session.view.look))
        draw(window)
        times.append(perf_counter() - start_time)
    for observer in observers:
        drawing.RemoveObserver(observer)
    return 1e3 * median(times), 1e3 * median(vtk)


def _while_running(window: Window) -> dict[str, Any]:
    """Run local-sd in the window with a crinkle cut; measure frames per second and the delay of timers."""
    window.session.document.preview(window.session.document.start)
    window.session.run.start(LocalSteepestDescent(), StoppingCriteria(tolerance=0, max_iterations=1_000_000))
    while window.session.run.phase.value != "running":
        run_event_loop(0.1)
    beats: list[float] = []
    timer = QTimer()
    timer.setInterval(_BEAT)
    timer.timeout.connect(lambda: beats.append(perf_counter()))
    frames: list[int] = []
    window.session.run.iterated.connect(lambda frame: frames.append(frame.iteration.number))
    timer.start()
    run_event_loop(_SECONDS)
    timer.stop()
    end_run(window.session)
    delays = np.maximum(np.diff(beats) * 1e3 - _BEAT, 0)
    if not len(delays):
        raise HexmendError("the event loop was blocked while the smoother ran")
    return {
        "lateness_median_ms": float(np.median(delays)),
        "lateness_95_ms": float(np.percentile(delays, 95)),
        "iterations_shown_per_second": len(frames) / _SECONDS,
        "iterations_per_second": (frames[-1] - frames[0]) / _SECONDS if frames else 0.0,
    }


def _lines(row: dict[str, Any]) -> Iterator[str]:
    yield f"{row['mesh']}, {row['hexes']:,} hexes, view of {row['view'][0]} × {row['view'][1]} pixels"
    for name, ms in row["frame_ms"].items():
        of_it = row["vtk_ms"][name]
        yield f"  frame, {name:<8} {ms:6.1f} ms  ({1000 / ms:4.0f} per second), {of_it:.1f} ms of it in VTK"
    yield (
        f"  while local-sd runs: event loop delayed by {row['lateness_median_ms']:.1f} ms (median), "
        f"{row['lateness_95_ms']:.1f} ms (95th percentile); {row['iterations_shown_per_second']:.1f} of "
        f"{row['iterations_per_second']:.1f} iterations per second shown"
    )


VIEWER = BenchSection(
    "viewer",
    f"The viewer: frames with points and colours changing (median of {_FRAMES}); large meshes ({VARIABLE} names sizes)",
    _measure,
    _report,
)
