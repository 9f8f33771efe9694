"""Seconds of an iteration of each method, compared with the thesis's program."""

from __future__ import annotations

import itertools
from statistics import median
from typing import Any

from benchmarks.section import BenchSection
from hexmend.gallery import make
from hexmend.run import StoppingCriteria, iterate
from hexmend.smoothers import METHODS

#: Seconds per iteration and node in the tables of the thesis for BridgeSharp: 4.1 for the optimisers, 4.2 for GETMe,
#: 4.3 for Laplacian smoothing.
THESIS_SECONDS_PER_NODE = {
    "laplacian": 2.495e-06,
    "getme": 1.595e-05,
    "local-sd": 6.755e-04,
    "local-nr": 2.458e-03,
    "global-sd": 2.959e-04,
    "global-nr": 5.839e-03,
    "global-mnr": 5.906e-03,
}


def _iterations() -> dict[str, Any]:
    mesh = make("bridge-sharp")
    nodes = int(mesh.free.sum())
    figures = {}
    for name in METHODS:
        run = iterate(mesh, name, StoppingCriteria(max_iterations=9, tolerance=0))
        at = [0.0, *(it.seconds for it in run)]
        seconds = median(b - a for a, b in itertools.pairwise(at))
        thesis = THESIS_SECONDS_PER_NODE.get(name)
        figures[name] = {
            "seconds": seconds,
            "seconds_per_node": seconds / nodes,
            "thesis_seconds_per_node": thesis,
            "ratio": thesis / (seconds / nodes) if thesis else None,
        }
    return figures


def _iteration_lines(figures: dict[str, Any]) -> list[str]:
    rows = []
    for name, row in figures.items():
        against = f"   {row['ratio']:,.0f} x faster than the program of the thesis" if row["ratio"] else ""
        milliseconds, nanoseconds = row["seconds"] * 1e3, row["seconds_per_node"] * 1e9
        rows.append(f"{name:<18} {milliseconds:8.1f} ms   {nanoseconds:8.0f} ns a node{against}")
    return rows


ITERATIONS = BenchSection(
    "iterations", "One iteration on bridge-sharp, 32,000 hexes (median of 9)", _iterations, _iteration_lines
)
