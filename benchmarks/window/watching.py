"""Benchmark of the timeline: frames per second while scrubbing, memory of iterations, and delay of a stop."""

from __future__ import annotations

from functools import partial
from statistics import median
from time import perf_counter
from typing import Any

import numpy as np

from benchmarks.section import BenchSection
from benchmarks.window.windows import draw, measure_meshes, report, run_event_loop
from hexmend.gallery import make
from hexmend.run import StoppingCriteria
from hexmend.smoothers.laplacian.laplacian import Laplacian
from hexmend.smoothers.local.steepest_descent import LocalSteepestDescent
from hexmend_app.shell.window import Window
from hexmend_app.state.mesh.history import LIMIT

_SCRUBBED, _ITERATIONS, _STOPS = 200, 500, 5


def _measure() -> dict[str, Any]:
    return measure_meshes((make("bridge-sharp"), make("five-side", size=110450)), _row)


def _row(window: Window) -> dict[str, Any]:
    stops = [_stop(window) for _ in range(_STOPS)]
    for record in list(window.session.history.records):
        window.session.timeline.delete(record)
    window.session.history.set_limit(LIMIT)
    _run(window, _ITERATIONS)
    history, record = window.session.history, window.session.timeline.record
    numbers = history.recorded_numbers(record)
    scrubbed = numbers[np.linspace(0, len(numbers) - 1, _SCRUBBED).astype(int)]
    return {
        "scrub_ms": _scrub(window, scrubbed),
        "jump_ms": _scrub(window, np.random.default_rng(0).permutation(scrubbed)),
        "iterations": record.newest,
        "kept": len(numbers) - 1,
        "kept_mb": history.bytes / (1 << 20),
        "limit_mb": history.limit / (1 << 20),
        "iteration_mb": history.bytes / (1 << 20) / (len(numbers) - 1),
        "stop_ms": median(delay for delay, _ in stops),
        "stop_iteration_ms": median(iteration for _, iteration in stops),
    }


def _run(window: Window, iterations: int) -> None:
    """Run the fastest method to fill the history."""
    window.session.run.start(Laplacian(), StoppingCriteria(tolerance=0, max_iterations=iterations))
    while window.session.run.busy:
        run_event_loop(0.1)


def _scrub(window: Window, numbers: np.ndarray) -> float:
    """Return the median milliseconds from the selection of an iteration until view and panels are drawn."""
    timeline, times = window.session.timeline, []
    for number in numbers:
        start = perf_counter()
        timeline.go(timeline.record, int(number))
        draw(window)
        times.append(perf_counter() - start)
    return 1e3 * median(times)


def _stop(window: Window) -> tuple[float, float]:
    """Return the milliseconds from the stop of local-sd until it ends, and of one iteration."""
    window.session.document.preview(window.session.document.start)
    window.session.run.start(LocalSteepestDescent(), StoppingCriteria(tolerance=0, max_iterations=1_000_000))
    while window.session.run.record.newest < 3:
        run_event_loop(0.05)
    ended: list[float] = []
    window.session.run.ended.connect(lambda result: ended.append(perf_counter()))
    start = perf_counter()
    window.session.run.stop()
    while not ended:
        run_event_loop(0.02)
    last = window.session.run.record.rows[-1]
    return 1e3 * (ended[0] - start), 1e3 * last["seconds"] / last["iteration"]


def _lines(row: dict[str, Any]) -> list[str]:
    return [
        f"{row['mesh']}, {row['hexes']:,} hexes",
        f"  scrubbing {_SCRUBBED} iterations: {row['scrub_ms']:.1f} ms each "
        f"({1000 / row['scrub_ms']:.0f} per second), {row['jump_ms']:.1f} ms in random order",
        f"  history of {row['iterations']} iterations: positions of {row['kept']} in {row['kept_mb']:.0f} MB "
        f"({row['iteration_mb']:.2f} each), limit {row['limit_mb']:.0f} MB",
        f"  stopped after {row['stop_ms']:.0f} ms; an iteration of local-sd takes {row['stop_iteration_ms']:.0f} ms",
    ]


WATCHING = BenchSection(
    "watching", "Watching: the timeline, and the delay of a stop", _measure, partial(report, lines=_lines)
)
