"""Benchmark of the goals of mend with a fixed boundary: q min, q mean and the minimum scaled Jacobian of each."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Any

from benchmarks.section import COUNTS, BenchSection, smoothed

#: Measured before: q min, q mean and minimum scaled Jacobian that hexsmoothing reaches, by file.
HEXSMOOTHING = {
    "swivel2_7494.mesh": (0.4788, 0.8963, 0.2122),
    "pierrot_32735.mesh": (0.3603, 0.8936, 0.2340),
    "teaport_14941.mesh": (0.3720, 0.8944, 0.2925),
    "pave1.e.vtk": (0.5190, 0.9374, 0.3929),
    "pave3.e.vtk": (0.3093, 0.8863, 0.2444),
    "CAD4Per.vtk": (0.0847, 0.3975, 0.0251),
    "impellerPer.vtk": (0.3414, 0.8282, 0.1846),
}
_OTHERS = ("CAD4.vtk", "bone.vtk", "bunny.vtk", "kitten_2.mesh", "rockerarm_2.mesh", "spring.mesh", "cub_fru.vtk")
_GOALS = ("balanced", "shape", "scaled-jacobian")
_FIGURES = ("q_min", "q_mean", "scaled_jacobian_min")


def _measure() -> dict[str, Any]:
    folder = os.environ.get("HEXMEND_MESHES")
    paths = [Path(folder) / name for name in (*HEXSMOOTHING, *_OTHERS)] if folder else []
    return {"runs": [_row(path) for path in paths if path.exists()]}


def _row(path: Path) -> dict[str, Any]:
    """Run `hexmend smooth` on a mesh with each goal; return figures of the reports and the seconds of each process."""
    row: dict[str, Any] = {"mesh": path.name, "hexsmoothing": HEXSMOOTHING.get(path.name)}
    for goal in _GOALS:
        report, seconds = smoothed(path, "--goal", goal)
        row["given"] = {key: report["before"][key] for key in ("hexes", *COUNTS, *_FIGURES)}
        row[goal] = {key: report["after"][key] for key in (*COUNTS, *_FIGURES)} | {"seconds": seconds}
    return row


def _lines(figures: dict[str, Any]) -> list[str]:
    if not figures["runs"]:
        return ["the variable HEXMEND_MESHES names no folder with any of " + ", ".join(HEXSMOOTHING)]
    head = "| mesh, hexes | | inverted | invalid | q min | q mean | scaled Jacobian min | s |"
    lines = [head, "|:---|:---|" + "---:|" * 6]
    for row in figures["runs"]:
        name = f"{row['mesh'].partition('.')[0]}, {row['given']['hexes']:,}"
        for state in ("given", *_GOALS):
            seconds = f"{row[state]['seconds']:.1f}" if state in _GOALS else ""
            counts = " | ".join(f"{row[state][key]:,}" for key in COUNTS)
            values = " | ".join(f"{row[state][key]:.4f}" for key in _FIGURES)
            lines.append(f"| {name} | {state} | {counts} | {values} | {seconds} |")
            name = ""
        if row["hexsmoothing"]:
            values = " | ".join(f"{value:.4f}" for value in row["hexsmoothing"])
            lines.append(f"| | hexsmoothing | | | {values} | |")
    return lines


GOALS = BenchSection("goals", "The goals of mend, boundary fixed", _measure, _lines)
