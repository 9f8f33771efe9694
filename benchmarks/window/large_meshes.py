"""Measurements of large meshes in the window: first picture, a cut that is dragged and at rest, and memory."""

from __future__ import annotations

import os
import tempfile
from pathlib import Path
from statistics import median
from time import perf_counter
from typing import Any

import numpy as np

from benchmarks.section import probe
from benchmarks.window.start import measure_start
from benchmarks.window.windows import draw, measure_meshes, rotation_frame_ms
from hexmend.gallery import make
from hexmend.io import read, write
from hexmend.run.memory import peak_mb
from hexmend_app.picture import Cut, CutStyle
from hexmend_app.shell.window import Window

#: Variable that names other numbers of hexes of five-side, with commas between them.
VARIABLE = "HEXMEND_VIEWER"
_SIZES = "1000000,10000000"
_MOVES = 20

_PROBE = """
import json, sys
from benchmarks.window.large_meshes import measure_file
print(json.dumps(measure_file(sys.argv[1])))
"""


def measure_large() -> list[dict[str, Any]]:
    """Measure meshes of the sizes that `VARIABLE` names, each in new processes."""
    rows = []
    with tempfile.TemporaryDirectory(prefix="hexmend-") as folder:
        path = Path(folder) / "mesh.vtkhdf"
        for size in os.environ.get(VARIABLE, _SIZES).split(","):
            write(path, make("five-side", size=int(size)))
            moments = measure_start(path)
            rows.append(probe(_PROBE, path) | {"picture_seconds": moments["picture"]["seconds"]})
    return rows


def measure_file(path: str) -> dict[str, Any]:
    """Measure a mesh of a file in a window of this process.

    Returns
    -------
    dict
        `hexes`; for whole hexes and a smooth cut `drag_ms`, median milliseconds a picture while the plane is dragged,
        and `rest_ms`, those of the fine picture after it; `turning_ms`; `peak_mb`, MiB.
    """
    return measure_meshes([read(path)], _row)["meshes"][0]


def _row(window: Window) -> dict[str, Any]:
    row: dict[str, Any] = {"turning_ms": rotation_frame_ms(window), "drag_ms": {}, "rest_ms": {}}
    points = window.session.document.start.mesh.points
    low, high = points.min(axis=0), points.max(axis=0)
    window.session.view.set_handles(False)
    for style in CutStyle:
        times = []
        for share in np.linspace(0.4, 0.6, _MOVES + 1):
            begun = perf_counter()
            window.session.view.set_cut(Cut.at((1, 0, 0), tuple(low + share * (high - low)), style))
            draw(window)
            times.append(perf_counter() - begun)
        row["drag_ms"][style.value] = 1e3 * median(times[1:])  # the first move prepares the others
        begun = perf_counter()
        window.canvas.draw_still()
        draw(window)
        row["rest_ms"][style.value] = 1e3 * (perf_counter() - begun)
    return row | {"peak_mb": peak_mb()}


def lines_of(rows: list[dict[str, Any]]) -> list[str]:
    """Format rows of `measure_large` as a table."""
    lines = [
        "| hexes | first picture, s | turning, ms | whole hexes dragged, ms | at rest | smooth cut dragged, ms "
        "| at rest | peak, MiB |",
        "|---:|---:|---:|---:|---:|---:|---:|---:|",
    ]
    for row in rows:
        cuts = (f"{row[part][style.value]:.0f}" for style in CutStyle for part in ("drag_ms", "rest_ms"))
        cells = [f"{row['hexes']:,}", f"{row['picture_seconds']:.1f}", f"{row['turning_ms']:.0f}", *cuts]
        lines.append(f"| {' | '.join(cells)} | {row['peak_mb']:,.0f} |")
    return lines
