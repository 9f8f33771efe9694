"""Benchmark of the lowest quality with a fixed and a sliding boundary, compared with published figures."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Any

from benchmarks.section import COUNTS, BenchSection, smoothed

#: Published lowest scaled Jacobian and distance of the surfaces in per cent of the diagonal, by file:
#: HexOpt (bunny, CAD4, impeller), edge-cone rectification (block, cap, hanger), HybridOctree (bone), and two more;
#: None where nothing is published.
PUBLISHED = {
    "bunny.vtk": (0.0698, 1.84),
    "CAD4.vtk": (0.1200, 0.0),
    "impeller.vtk": (0.4300, 0.58),
    "block_in.mesh": (0.2501, 0.41),
    "cap_in.mesh": (0.1062, 1.06),
    "hanger_stresstest_in.mesh": (0.7162, 0.24),
    "bone.vtk": (0.6100, None),
    "mid2FemPer.vtk": (0.4800, 0.70),
    "dragon_in.mesh": (0.1018, 2.79),
    "fertility_1.mesh": (None, None),
    "kitten_2.mesh": (None, None),
    "spring.mesh": (None, None),
    "rockerarm_2.mesh": (None, None),
    "fancy_ring.mesh": (None, None),
}


def _measure() -> dict[str, Any]:
    folder = os.environ.get("HEXMEND_MESHES")
    paths = [Path(folder) / name for name in PUBLISHED] if folder else []
    return {"runs": [_row(path, boundary) for path in paths if path.exists() for boundary in ("fixed", "slide")]}


def _row(path: Path, boundary: str) -> dict[str, Any]:
    """Run `hexmend smooth` on a mesh; return figures of its report and the seconds of the process."""
    report, seconds = smoothed(path, "--boundary", boundary, "--method", "mend", "--set", "goal=scaled-jacobian")
    before, after, surface = report["before"], report["after"], report.get("surface") or {}
    return {
        "mesh": path.name,
        "boundary": boundary,
        "hexes": before["hexes"],
        **{key: [before[key], after[key]] for key in (*COUNTS, "scaled_jacobian_min", "q_min", "q_mean")},
        "distance_percent": surface.get("max_percent_of_diagonal", 0.0),
        "volume_change": surface.get("volume_change", 0.0),
        "seconds": seconds,
        "published": PUBLISHED[path.name],
    }


def _lines(figures: dict[str, Any]) -> list[str]:
    if not figures["runs"]:
        return ["the variable HEXMEND_MESHES names no folder with any of " + ", ".join(PUBLISHED)]
    head = "| mesh | boundary | inverted | invalid | scaled Jacobian min | published | q min | q mean | distance % |"
    lines = [head + " published | volume % | s |", "|:---|:---|" + "---:|" * 10]
    for row in figures["runs"]:
        lowest, distance = row["published"]
        slides = row["boundary"] == "slide"
        cells = [
            row["mesh"].partition(".")[0].removesuffix("_in"),
            row["boundary"],
            *("{:,} → {:,}".format(*row[key]) for key in COUNTS),
            "{:.4f} → {:.4f}".format(*row["scaled_jacobian_min"]),
            "–" if lowest is None else f"{lowest:.4f}",
            "{:.4f} → {:.4f}".format(*row["q_min"]),
            "{:.4f} → {:.4f}".format(*row["q_mean"]),
            f"{row['distance_percent']:.3f}" if slides else "–",
            f"{distance:.2f}" if slides and distance is not None else "–",
            f"{100 * row['volume_change']:+.3f}" if slides else "–",
            f"{row['seconds']:.1f}",
        ]
        lines.append(f"| {' | '.join(cells)} |")
    return lines


_TITLE = "The worst hex: boundary fixed and sliding, and published figures"
BOUNDARIES = BenchSection("boundaries", _TITLE, _measure, _lines)
