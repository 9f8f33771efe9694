"""The viewer's parts of the benchmark: milliseconds a frame and a change of what is hidden, and how late the event loop
is beside a smoother."""

from __future__ import annotations

from statistics import median
from time import perf_counter
from typing import TYPE_CHECKING, Any

import numpy as np

from hexmend.errors import HexmendError
from hexmend.gallery import make
from hexmend.study.section import Section

if TYPE_CHECKING:
    from hexmend.mesh import Mesh
    from hexmend_app.window import Window

_FRAMES = 40
_CHANGES = 9
_SECONDS = 6.0
_BEAT = 5  # milliseconds between two beats of the event loop


def _measure() -> dict[str, Any]:
    from hexmend_app.display import DisplayError, check_display

    try:
        check_display()
    except DisplayError as error:
        return {"skipped": str(error)}
    from hexmend_app.program import application
    from hexmend_app.window import Window

    app = application()
    rows = []
    for mesh in (make("bridge-sharp"), make("five-side", size=110450)):
        window = Window()
        window.resize(1440, 900)
        window.show()
        window.build_canvas()
        _open(window, mesh)
        _turn(0.5)  # until the layout has settled
        row = {"mesh": mesh.name, "hexes": mesh.n_hexes, "view": [window.canvas.width(), window.canvas.height()]}
        row["frame_ms"] = {name: _frame(window, name) for name in ("whole", "crinkle", "smooth")}
        row |= _while_running(window)
        window.document.saved(window.document.path)
        window.close()
        app.processEvents()
        rows.append(row)
    return {"meshes": rows}


def _open(window: Window, mesh: Mesh) -> None:
    from pathlib import Path

    from hexmend_app.state.document import State

    window.document.replace(State.of(mesh), Path(f"{mesh.name}.vtu"))


def _frame(window: Window, cut: str) -> float:
    """Median milliseconds from new points and qualities to the finished picture."""
    from hexmend_app.state.document import State
    from hexmend_app.state.look import ClipPlane

    start = window.document.start
    middle = tuple(start.mesh.points.mean(axis=0))
    window.view.set_plane_shown(False)
    window.view.set_clip(None if cut == "whole" else ClipPlane((1, 0, 0), middle, cut == "crinkle"))
    shift = start.mesh.mean_edge_length * 0.05 * np.random.default_rng(0).normal(size=start.mesh.points.shape)
    shift *= start.mesh.free[:, None]
    states = [State.of(start.mesh.with_points(start.mesh.points + share * shift)) for share in (0.0, 0.5, 1.0)]
    canvas = window.canvas
    canvas.interactor.render()
    times = []
    for k in range(_FRAMES):
        state = states[k % 3]
        began = perf_counter()
        canvas.set_points(state.mesh.points, state.figures)
        canvas.interactor.render()
        times.append(perf_counter() - began)
    return 1e3 * median(times)


def _measure_filters() -> dict[str, Any]:
    from hexmend_app.display import DisplayError, check_display

    try:
        check_display()
    except DisplayError as error:
        return {"skipped": str(error)}
    from hexmend_app.program import application
    from hexmend_app.window import Window

    app = application()
    rows = []
    for mesh in (make("bridge-sharp"), make("five-side", size=110450), make("five-side", size=1_000_000)):
        window = Window()
        window.resize(1440, 900)
        window.show()
        window.build_canvas()
        _open(window, mesh)
        _turn(0.5)
        rows.append({"mesh": mesh.name, "hexes": mesh.n_hexes, "ms": _changes(window, mesh)})
        window.close()
        app.processEvents()
    return {"meshes": rows}


def _changes(window: Window, mesh: Mesh) -> dict[str, dict[str, float]]:
    """Median milliseconds of each change of the look, in the parts that it has."""
    from hexmend_app.state.look import ClipPlane, Isolation, ValueRange

    low, high = mesh.points.min(axis=0), mesh.points.max(axis=0)
    places = [tuple(low + (high - low) * share) for share in np.linspace(0.4, 0.6, _CHANGES)]
    deep = int(mesh.topology.layers.argmax())
    outer = np.flatnonzero(mesh.topology.layers == 0)[:: max(1, mesh.n_hexes // 500)]
    looks = {
        "clip": [{"clip": ClipPlane((1, 0, 0), place)} for place in places],
        "quality range": [{"quality_range": ValueRange("q", 0.5 + k / 100, 1.0)} for k in range(_CHANGES)],
        "peel": [{"peel": 1 + k % int(mesh.topology.layers.max())} for k in range(_CHANGES)],
        "isolate": [{"isolation": Isolation((deep,), 1 + k)} for k in range(_CHANGES)],
        "dig": [{"dug": frozenset(outer[: k + 1].tolist())} for k in range(_CHANGES)],
        "shrink": [{"shrink": 0.2 + k / 50} for k in range(_CHANGES)],
        "clip, peel, shrink": [{"clip": ClipPlane((1, 0, 0), place), "peel": 1, "shrink": 0.3} for place in places],
    }
    viewport, canvas = window.canvas.viewport, window.canvas
    window.view.set_plane_shown(False)
    kept, spent = viewport._kept, [0.0]

    def timed() -> np.ndarray | None:
        began = perf_counter()
        answer = kept()
        spent.append(perf_counter() - began)
        return answer

    viewport._kept = timed
    answer = {}
    for name, changes in looks.items():
        masks, faces, frames = [], [], []
        for fields in changes:
            spent.clear()
            began = perf_counter()
            window.view.change(**fields)
            done = perf_counter()
            canvas.interactor.render()
            frames.append(perf_counter() - done)
            masks.append(sum(spent))
            faces.append(done - began - masks[-1])
        answer[name] = {
            "mask": 1e3 * median(masks),
            "faces": 1e3 * median(faces),
            "drawing": 1e3 * median(frames),
            "quads": len(viewport._faces.quads),
        }
        window.view.show_another()
        window.view.change(shrink=0.0)
    return answer


def _filter_lines(figures: dict[str, Any]) -> list[str]:
    if "skipped" in figures:
        return [f"left out: {figures['skipped']}"]
    rows = []
    for row in figures["meshes"]:
        rows.append(f"{row['mesh']}, {row['hexes']:,} hexes:  mask + faces + drawing, quads drawn at last")
        for name, ms in row["ms"].items():
            rows.append(
                f"  {name:<18} {ms['mask']:6.1f} + {ms['faces']:6.1f} + {ms['drawing']:6.1f} ms   {ms['quads']:>8,}"
            )
    return rows


def _turn(seconds: float) -> None:
    """Let Qt's own event loop turn; one of ours would take the processor from the worker."""
    from PySide6.QtCore import QEventLoop, QTimer

    loop = QEventLoop()
    QTimer.singleShot(round(seconds * 1e3), loop.quit)
    loop.exec()


def _while_running(window: Window) -> dict[str, Any]:
    """Run local-sd in the window with a crinkle cut: frames a second, and how late timers fire."""
    from PySide6.QtCore import QTimer

    from hexmend.run import Stop
    from hexmend.smoothers.local_sd import LocalSteepestDescent

    window.document.preview(window.document.start)
    window.smoothing.start(LocalSteepestDescent(), Stop(tolerance=0, max_iterations=1_000_000))
    while window.smoothing.phase.value != "running":
        _turn(0.1)
    beats: list[float] = []
    timer = QTimer()
    timer.setInterval(_BEAT)
    timer.timeout.connect(lambda: beats.append(perf_counter()))
    frames: list[int] = []
    window.smoothing.iterated.connect(lambda frame: frames.append(frame.iteration.number))
    timer.start()
    _turn(_SECONDS)
    timer.stop()
    window.smoothing.end_now()
    late = np.maximum(np.diff(beats) * 1e3 - _BEAT, 0)
    if not len(late):
        raise HexmendError("the event loop did not turn while the smoother ran")
    return {
        "lateness_median_ms": float(np.median(late)),
        "lateness_95_ms": float(np.percentile(late, 95)),
        "iterations_shown_per_second": len(frames) / _SECONDS,
        "iterations_per_second": (frames[-1] - frames[0]) / _SECONDS if frames else 0.0,
    }


def _lines(figures: dict[str, Any]) -> list[str]:
    if "skipped" in figures:
        return [f"left out: {figures['skipped']}"]
    rows = []
    for row in figures["meshes"]:
        rows.append(f"{row['mesh']}, {row['hexes']:,} hexes, view of {row['view'][0]} × {row['view'][1]} pixels")
        for name, ms in row["frame_ms"].items():
            rows.append(f"  frame, {name:<8} {ms:6.1f} ms  ({1000 / ms:4.0f} a second)")
        rows.append(
            f"  beside local-sd: event loop late by {row['lateness_median_ms']:.1f} ms (median), "
            f"{row['lateness_95_ms']:.1f} ms (95th percentile); {row['iterations_shown_per_second']:.1f} of "
            f"{row['iterations_per_second']:.1f} iterations a second shown"
        )
    return rows


section = Section(
    "viewer", f"The viewer: frames with points and colours changing (median of {_FRAMES})", _measure, _lines
)
filters = Section(
    "filters",
    f"The viewer: a change of what is hidden (median of {_CHANGES})",
    _measure_filters,
    _filter_lines,
)
