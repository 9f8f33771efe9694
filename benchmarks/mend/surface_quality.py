"""Benchmark of the hope of 5.2.1: does the quality of boundary quads in the objective improve the mesh?"""

from __future__ import annotations

import os
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np

from benchmarks.section import BenchSection
from hexmend.boundary import SlidingBoundary
from hexmend.energy import SQUARES
from hexmend.energy.quads import SurfaceQuads
from hexmend.gallery import make
from hexmend.io import read
from hexmend.mesh.mesh import Mesh
from hexmend.quality import measure
from hexmend.run import StoppingCriteria, smooth
from hexmend.smoothers import METHODS

_FILES = "hanger_stresstest_in.mesh", "block_in.mesh", "kitten_2.mesh", "fertility_1.mesh"
_METHODS = "local-nr", "global-sd"
_WEIGHTS = 0.0, 0.1, 1.0, 10.0
_ITERATIONS = 100
#: Of the mesh of the gallery, whose nodes are displaced by up to so many mean edge lengths, on the boundary along it.
_SIZE, _AMPLITUDE = 2625, 0.35


def _measure() -> dict[str, Any]:
    return {"runs": [row for name, mesh in _meshes() for row in _rows(name, mesh)]}


def _meshes() -> Iterator[tuple[str, Mesh]]:
    yield "five-side", _perturbed(make("five-side", size=_SIZE))
    folder = os.environ.get("HEXMEND_MESHES")
    for name in _FILES if folder else ():
        if (Path(folder) / name).exists():
            yield name.partition(".")[0].removesuffix("_in"), read(Path(folder) / name)


def _perturbed(mesh: Mesh) -> Mesh:
    """Displace the nodes at random, those of the boundary on its surface."""
    boundary = SlidingBoundary(mesh)
    shift = np.random.default_rng(0).uniform(-1, 1, mesh.points.shape) * _AMPLITUDE * mesh.mean_edge_length
    points = mesh.points + shift * boundary.mesh.free[:, None]
    return mesh.keeping_surface().with_points(boundary.projected(points))


def _rows(name: str, mesh: Mesh) -> Iterator[dict[str, Any]]:
    quads = SurfaceQuads(SlidingBoundary(mesh), SQUARES, 1.0)
    yield {"mesh": name, "hexes": mesh.n_hexes, "method": None} | _figures(mesh, quads, mesh.points)
    for method in _METHODS:
        for weight in _WEIGHTS:
            smoother = METHODS[method](boundary="slide", surface_weight=weight)  # type: ignore[call-arg]
            result = smooth(mesh, smoother, StoppingCriteria(max_iterations=_ITERATIONS), progress=False)
            row = {"mesh": name, "hexes": mesh.n_hexes, "method": method, "weight": weight}
            row |= {"iterations": result.iterations, "seconds": result.seconds + result.setup_seconds}
            yield row | _figures(mesh, quads, result.mesh.points)


def _figures(mesh: Mesh, quads: SurfaceQuads, points: np.ndarray) -> dict[str, Any]:
    """Qualities of hexes and of the boundary's quads, these in the tangent planes of the surface as given."""
    hexes, corners = measure(points, mesh.hexes), quads.corners(points)
    jacobian, q = corners.scaled_jacobians, corners.qualities
    return {
        "inverted": hexes.n_inverted,
        "q_min": float(hexes.q.min()),
        "q_mean": float(hexes.q.mean()),
        "scaled_jacobian_min": float(hexes.scaled_jacobian.min()),
        "flipped_quads": int(np.count_nonzero(jacobian <= 0)),
        "quad_q_min": float(q.min()),
        "quad_q_mean": float(q.mean()),
        "quad_scaled_jacobian_min": float(jacobian.min()),
    }


_COLUMNS = "q_min", "q_mean", "scaled_jacobian_min"


def _lines(figures: dict[str, Any]) -> list[str]:
    lines = [
        "| mesh, hexes | method | weight | inverted, flipped | hexes: q min | q mean | scaled Jacobian min "
        "| quads: q min | q mean | scaled Jacobian min | iterations | s |",
        "|:---|:---|" + "---:|" * 10,
    ]
    for row in figures["runs"]:
        given = row["method"] is None
        cells = [f"{row['mesh']}, {row['hexes']:,}" if given else "", row["method"] or "as given"]
        cells += ["" if given else f"{row['weight']:g}", f"{row['inverted']:,}, {row['flipped_quads']:,}"]
        cells += [f"{row[prefix + key]:.4f}" for prefix in ("", "quad_") for key in _COLUMNS]
        cells += ["", ""] if given else [f"{row['iterations']:,}", f"{row['seconds']:.1f}"]
        lines.append(f"| {' | '.join(cells)} |")
    return lines


_TITLE = "The quality of the boundary's quads in the objective, boundary sliding (5.2.1)"
SURFACE_QUALITY = BenchSection("surface-quality", _TITLE, _measure, _lines)
