"""Benchmark of padding: meshes before and after, with the boundary as it was."""

from __future__ import annotations

import os
import time
from pathlib import Path
from typing import Any

import numpy as np

import hexmend as hx
from benchmarks.section import BenchSection

#: Mesh, and the argument `around`.
_CASES = (
    ("bunny.vtk", None),
    ("bunny.vtk", "locked"),
    ("bunnyPer.vtk", None),
    ("block_in.mesh", None),
    ("cap_in.mesh", None),
    ("dragon_in.mesh", None),
    ("dragon_in.mesh", "locked"),
    ("jet.exo", None),
    ("n10-id2_hex.msh", None),
)
_FIGURES = "hexes", "inverted", "locked_inverted", "scaled_jacobian_min", "q_mean"


def _measure() -> dict[str, Any]:
    folder = Path(os.environ.get("HEXMEND_MESHES", "."))
    return {"runs": [_row(folder / file, around) for file, around in _CASES if (folder / file).exists()]}


def _row(path: Path, around: str | None) -> dict[str, Any]:
    mesh = hx.read(path)
    began = time.perf_counter()
    padding = hx.pad(mesh, around=around)
    row = {"mesh": path.name, "around": around, "seconds": time.perf_counter() - began}
    row |= {key: [getattr(one, key) for one in (padding.before, padding.after)] for key in _FIGURES}
    moved = np.abs(padding.mesh.points[: mesh.n_nodes] - mesh.points)[mesh.topology.boundary]
    return row | {"boundary_moved": float(moved.max())}


def _lines(figures: dict[str, Any]) -> list[str]:
    lines = [
        "| mesh | layer | hexes | inverted (locked) | scaled Jacobian min | q mean | boundary moved | s |",
        "|:---|:---|---:|---:|---:|---:|---:|---:|",
    ]
    for row in figures["runs"]:
        (before, after), (locked, _) = row["inverted"], row["locked_inverted"]
        cells = [row["mesh"], f"around {row['around']}" if row["around"] else "whole boundary"]
        cells += ["{:,} → {:,}".format(*row["hexes"]), f"{before} ({locked}) → {after}"]
        cells += ["{:.4f} → {:.4f}".format(*row[key]) for key in ("scaled_jacobian_min", "q_mean")]
        cells += [f"{row['boundary_moved']:g}", f"{row['seconds']:.1f}"]
        lines.append(f"| {' | '.join(cells)} |")
    return lines


PADDING = BenchSection("padding", "Padding, boundary fixed", _measure, _lines)
