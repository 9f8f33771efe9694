"""Benchmark of the viewer: changes of visibility, frames while the view rotates, and memory."""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial
from statistics import median
from time import perf_counter
from typing import Any

import numpy as np

from benchmarks.section import BenchSection
from benchmarks.window.windows import draw, measure_meshes, report, rotation_frame_ms
from hexmend.gallery import make
from hexmend.run.memory import peak_mb
from hexmend_app.picture import Box, Cut, CutStyle, Isolate
from hexmend_app.shell.window import Window

_CHANGES = 9


def _measure() -> dict[str, Any]:
    sizes: Any = (("bridge-sharp", {}), ("five-side", {"size": 110450}), ("five-side", {"size": 1_000_000}))
    return measure_meshes((make(name, **size) for name, size in sizes), _row)


def _row(window: Window) -> dict[str, Any]:
    rotation = rotation_frame_ms(window)
    return {"turning_ms": rotation, "memory_mb": peak_mb(), "ms": _changes(window)}


def _changes(window: Window) -> dict[str, dict[str, float]]:
    """Return the median milliseconds of each change of the look, by stage."""
    mesh = window.session.document.now.mesh
    low, high = mesh.points.min(axis=0), mesh.points.max(axis=0)
    places = [tuple(low + (high - low) * share) for share in np.linspace(0.4, 0.6, _CHANGES)]
    deep = int(mesh.topology.layers.argmax())
    outer = np.flatnonzero(mesh.topology.layers == 0)[:: max(1, mesh.n_hexes // 500)]
    looks: dict[str, Any] = {
        "clip": [{"cut": Cut.at((1, 0, 0), place)} for place in places],
        "smooth cut": [{"cut": Cut.at((1, 0, 0), place, CutStyle.SMOOTH)} for place in places],
        "box": [{"cut": Cut(box=Box(tuple(low), place))} for place in places],
        "corner cut out": [{"cut": Cut(box=Box(place, tuple(high)), notch=True)} for place in places],
        "smooth corner": [
            {"cut": Cut(box=Box(place, tuple(high)), style=CutStyle.SMOOTH, notch=True)} for place in places
        ],
        "quality range": [{"show": {"quality": (0.5 + k / 100, 1.0)}} for k in range(_CHANGES)],
        "peel": [{"show": {"peel": 1 + k % int(mesh.topology.layers.max())}} for k in range(_CHANGES)],
        "isolate": [{"show": {"isolate": Isolate((deep,), 1 + k)}} for k in range(_CHANGES)],
        "dig": [{"show": {"hidden": frozenset(outer[: k + 1].tolist())}} for k in range(_CHANGES)],
        "shrink": [{"show": {"shrink": 0.2 + k / 50}} for k in range(_CHANGES)],
        "clip, peel, shrink": [
            {"cut": Cut.at((1, 0, 0), place), "show": {"peel": 1, "shrink": 0.3}} for place in places
        ],
    }
    viewport = window.canvas.viewport
    window.session.view.set_handles(False)
    compute_mask, mask_seconds = viewport.kept, [0.0]

    def timed_mask() -> np.ndarray | None:
        start = perf_counter()
        mask = compute_mask()
        mask_seconds.append(perf_counter() - start)
        return mask

    viewport.kept = timed_mask  # type: ignore[method-assign]
    result = {}
    for name, changes in looks.items():
        masks, faces, frames = [], [], []
        for fields in changes:
            mask_seconds.clear()
            start = perf_counter()
            window.session.view.change(**fields)
            window.refresh()
            refreshed = perf_counter()
            draw(window)
            frames.append(perf_counter() - refreshed)
            masks.append(sum(mask_seconds))
            faces.append(refreshed - start - masks[-1])
        result[name] = {
            "mask": 1e3 * median(masks),
            "faces": 1e3 * median(faces),
            "drawing": 1e3 * median(frames),
            "quads": len(viewport.mesh_layer.faces.quads),
        }
        window.session.view.show_all()
        window.session.view.change(show={"shrink": 0.0})
    return result


def _lines(row: dict[str, Any]) -> Iterator[str]:
    yield f"{row['mesh']}, {row['hexes']:,} hexes:  mask + faces + drawing = total, quads drawn"
    for name, ms in row["ms"].items():
        parts = [ms[part] for part in ("mask", "faces", "drawing")]
        summands = " + ".join(f"{part:6.1f}" for part in parts)
        yield f"  {name:<18} {summands} = {sum(parts):6.1f} ms   {ms['quads']:>8,}"
    yield f"  a frame while the view rotates: {row['turning_ms']:.1f} ms; peak memory {row['memory_mb']:,.0f} MB"


FILTERS = BenchSection(
    "filters",
    f"The viewer: changes of visibility, and rotation (medians of {_CHANGES})",
    _measure,
    partial(report, lines=_lines),
)
