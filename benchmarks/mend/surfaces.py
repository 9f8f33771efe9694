"""Benchmark of a fine surface: what nodes that slide on a file's triangles cost beyond those that slide on the skin."""

from __future__ import annotations

import os
import tempfile
from pathlib import Path
from statistics import median
from typing import Any

import numpy as np

from benchmarks.scale.scale import measure_process
from benchmarks.section import BenchSection
from hexmend.boundary.closest_point import triangulate
from hexmend.gallery import make
from hexmend.io import read, write
from hexmend.io.surfaces.formats import TRIANGLE

#: Files in the folder of HEXMEND_MESHES; one of the gallery is measured where it has none of them.
_FILES = "rockerarm_2.mesh", "pierrot_32735.mesh"
_METHODS = "laplacian", "getme", "local-sd", "global-sd", "mend"
_TIMES = 3
_ITERATIONS = 30
#: The skin is refined until it has as many triangles.
_TRIANGLES = 128_000


def refined(points: np.ndarray, faces: np.ndarray, triangles: int) -> tuple[np.ndarray, np.ndarray]:
    """Divide quads into triangles, and these at the midpoints of their edges until there are enough.

    Parameters
    ----------
    points : (n, 3) float64
    faces : (k, 4) int32
    triangles : int
        Least number of triangles.

    Returns
    -------
    points : (v, 3) float64
    triangles : (t, 3) int32
    """
    points, corners, _ = triangulate(points, faces)
    while len(corners) < triangles:
        edges = np.sort(corners[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2), axis=1)
        edges, at = np.unique(edges, axis=0, return_inverse=True)
        middle = at.reshape(-1, 3) + len(points)
        points = np.concatenate([points, points[edges].mean(axis=1)])
        a, b, c = corners.T
        ab, bc, ca = middle.T
        parts = (a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca)
        corners = np.concatenate([np.stack(part, axis=1) for part in parts])
    return points, corners.astype(np.int32)


def _write_stl(path: Path, points: np.ndarray, triangles: np.ndarray) -> None:
    rows = np.zeros(len(triangles), dtype=TRIANGLE)
    rows["corners"] = points[triangles]
    path.write_bytes(bytes(80) + np.uint32(len(rows)).tobytes() + rows.tobytes())


def _surfaces() -> dict[str, Any]:
    named = Path(os.environ.get("HEXMEND_MESHES", "."))
    rows = []
    with tempfile.TemporaryDirectory(prefix="hexmend-") as name:
        folder = Path(name)
        paths = [named / file for file in _FILES if (named / file).exists()]
        if not paths:
            paths = [folder / "bridge-sharp.mesh"]
            write(paths[0], make("bridge-sharp", size=7500))
        for path in paths:
            mesh = read(path)
            points, triangles = refined(mesh.points, mesh.topology.boundary_faces, _TRIANGLES)
            _write_stl(folder / "surface.stl", points, triangles)
            rows += [_row(path, folder, method) | {"triangles": len(triangles)} for method in _METHODS]
    return {"rows": rows}


def _row(path: Path, folder: Path, method: str) -> dict[str, Any]:
    """Medians of the seconds of process and method, with the skin and with the surface, run in turn."""
    slide = ("--boundary", "slide", "--method", method, "--max-iterations", str(_ITERATIONS))
    both = {"skin": slide, "surface": (*slide, "--surface", str(folder / "surface.stl"))}
    runs: dict[str, list[dict[str, Any]]] = {name: [] for name in both}
    for _ in range(_TIMES):
        for name, options in both.items():
            runs[name].append(measure_process(path, folder, options))
    row: dict[str, Any] = {"mesh": path.stem, "hexes": runs["skin"][0]["hexes"], "method": method}
    for name, figures in runs.items():
        row[name] = {key: median(one[key] for one in figures) for key in ("seconds", "method_seconds", "iterations")}
    return row


def _lines(figures: dict[str, Any]) -> list[str]:
    lines = [
        "| mesh | hexes | triangles | method | iterations | on it | seconds | on it | ratio | process | on it "
        "| ratio |",
        "|:---|---:|---:|:---|" + "---:|" * 8,
    ]
    for row in figures["rows"]:
        skin, surface = row["skin"], row["surface"]
        cells = [row["mesh"], f"{row['hexes']:,}", f"{row['triangles']:,}", row["method"]]
        cells += [f"{one['iterations']:.0f}" for one in (skin, surface)]
        for key in ("method_seconds", "seconds"):
            cells += [f"{one[key]:.2f}" for one in (skin, surface)] + [f"{surface[key] / skin[key]:.2f}"]
        lines.append(f"| {' | '.join(cells)} |")
    return lines


_TITLE = (
    f"A surface of {_TRIANGLES:,} triangles and the skin of the mesh, {_ITERATIONS} iterations (median of {_TIMES})"
)
SURFACES = BenchSection("surfaces", _TITLE, _surfaces, _lines)
