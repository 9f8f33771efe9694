"""Benchmark of the least scaled Jacobian of meshes with more and more freedom of their boundary."""

from __future__ import annotations

from contextlib import suppress
from pathlib import Path
from statistics import median
from typing import Any

from benchmarks.section import COUNTS, BenchSection, mesh_files, smoothed

_SLIDE = "--boundary", "slide"
#: Options of the runs, by column: the boundary fixed; sliding, with tolerances in mean edge lengths; with the
#: defaults; and with every edge beyond 40 degrees a feature.
_RUNS = {
    "fixed": (),
    "0.03": (*_SLIDE, "--set", "surface_tolerance=0.03"),
    "0.1": (*_SLIDE, "--set", "surface_tolerance=0.1"),
    "0.3": (*_SLIDE, "--set", "surface_tolerance=0.3"),
    "1": (*_SLIDE, "--set", "surface_tolerance=1"),
    "auto": _SLIDE,
    "40 degrees": (*_SLIDE, "--set", "feature_angle=40"),
}
#: Pairs of columns of which the second has more freedom.
_PAIRS = ("fixed", "0.03"), ("0.03", "0.1"), ("0.1", "0.3"), ("0.3", "1"), ("fixed", "auto"), ("40 degrees", "auto")
#: Fall of the minimum scaled Jacobian that counts.
_FALL = 5e-4
#: Bytes of a file above which the mesh is left out.
_LARGEST_FILE = 3_000_000


def _measure() -> dict[str, Any]:
    rows = []
    for path in mesh_files():
        if path.stat().st_size < _LARGEST_FILE:
            with suppress(FileNotFoundError):  # no report: the file holds no mesh of hexes
                rows.append(_row(path))
    return {"runs": rows}


def _row(path: Path) -> dict[str, Any]:
    """Run `hexmend smooth` on a mesh with each freedom; counts of hexes, minimum scaled Jacobian, seconds of each."""
    row: dict[str, Any] = {"mesh": path.name}
    for name, words in _RUNS.items():
        report, seconds = smoothed(path, "--set", "goal=scaled-jacobian", *words)
        after = report["after"]
        counts = {key: after[key] for key in COUNTS}
        row[name] = {**counts, "least": after["scaled_jacobian_min"], "seconds": seconds}
    return row


def lower(row: dict[str, Any]) -> list[str]:
    """Name the pairs of columns of a mesh where more freedom leaves more invalid hexes, or a lower least."""
    return [f"{less} to {more}" for less, more in _PAIRS if _is_lower(row[more], row[less])]


def _is_lower(more: dict[str, Any], less: dict[str, Any]) -> bool:
    for key in COUNTS:
        if more[key] != less[key]:
            return bool(more[key] > less[key])
    return bool(more["least"] < less["least"] - _FALL)


def _lines(figures: dict[str, Any]) -> list[str]:
    if not figures["runs"]:
        return ["the variable HEXMEND_MESHES names no folder with meshes"]
    lines = [
        "| mesh | " + " | ".join(_RUNS) + " | lower with more freedom |",
        "|:---|" + "---:|" * len(_RUNS) + ":---|",
    ]
    for row in figures["runs"]:
        cells = [_cell(row[name]) for name in _RUNS]
        lines.append(f"| {' | '.join([row['mesh'], *cells, ', '.join(lower(row))])} |")
    of_runs = [[row[name] for row in figures["runs"]] for name in _RUNS]
    medians = [f"{median(run['least'] for run in runs):.4f}" for runs in of_runs]
    inverted = [str(sum(run["inverted"] > 0 for run in runs)) for runs in of_runs]
    lines += [f"| {' | '.join(['median', *medians])} | |"]
    lines += [f"| {' | '.join(['meshes with inverted hexes', *inverted])} | |"]
    pairs, falls = len(_PAIRS) * len(figures["runs"]), sum(len(lower(row)) for row in figures["runs"])
    text = f"{falls} of {pairs} pairs end lower by more than {_FALL}; in brackets: inverted and invalid hexes."
    return [*lines, "", text]


def _cell(run: dict[str, Any]) -> str:
    return f"{run['least']:.4f}" + (f" ({run['inverted']:,}, {run['invalid']:,})" if run["invalid"] else "")


FREEDOM = BenchSection("freedom", "More freedom of the boundary: the minimum scaled Jacobian", _measure, _lines)
