"""All sections of the benchmark, and those of iterations and scaling."""

from __future__ import annotations

import itertools
import os
import platform
from functools import partial
from importlib.metadata import entry_points
from statistics import median
from typing import Any

import numpy as np

from hexmend import kernels
from hexmend.gallery import make
from hexmend.run import StoppingCriteria, iterate
from hexmend.smoothers import METHODS
from hexmend.study.bench.boundaries import BOUNDARIES
from hexmend.study.bench.default_method import OPTIMA, SIZES, UNTANGLING
from hexmend.study.bench.files import FILES
from hexmend.study.bench.freedom import FREEDOM
from hexmend.study.bench.goals import GOALS
from hexmend.study.bench.kernels import KERNELS, PRECONDITIONERS
from hexmend.study.bench.memory import MEMORY
from hexmend.study.bench.offsets import OFFSETS
from hexmend.study.bench.processes import PROCESSES
from hexmend.study.bench.remarks import REMARKS
from hexmend.study.bench.scale import SCALE
from hexmend.study.bench.section import BenchSection, by_size
from hexmend.study.bench.surface_quality import SURFACE_QUALITY
from hexmend.study.bench.surfaces import SURFACES

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


def sections() -> dict[str, BenchSection]:
    """Return all sections by name, those of the entry-point group `hexmend.benchmarks` included."""
    optimisation = OPTIMA, UNTANGLING, GOALS, BOUNDARIES, FREEDOM, SURFACES, SURFACE_QUALITY, OFFSETS, REMARKS, SIZES
    own = KERNELS, PROCESSES, ITERATIONS, PRECONDITIONERS, *optimisation, SCALING, SCALE, FILES, MEMORY
    found = {section.name: section for section in own}
    for entry in entry_points(group="hexmend.benchmarks"):
        try:
            found[entry.name] = entry.load()
        except ImportError:  # the libraries of the viewer are not installed
            continue
    return found


def machine() -> dict[str, Any]:
    """Describe the machine."""
    return {
        "processor": _processor(),
        "cores": os.cpu_count(),
        "threads": kernels.threads(),
        "kernels": kernels.BUILD,
        "system": platform.system(),
        "python": platform.python_version(),
        "numpy": np.__version__,
    }


def _processor() -> str:
    try:
        with open("/proc/cpuinfo", encoding="utf-8") as file:
            return next(line.split(":", 1)[1].strip() for line in file if line.startswith("model name"))
    except (OSError, StopIteration):
        return platform.processor() or "unknown"


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


_PROBE = """
import json, sys
from time import perf_counter
from hexmend.gallery import make
from hexmend.quality import measure
from hexmend.mesh.mesh import Mesh
from hexmend.run.memory import peak_mb
mesh = make("cube", size=27)
mesh.topology.face_neighbours, mesh.topology.edges, mesh.topology.colouring(mesh.free)
measure(mesh.points, mesh.hexes)
mesh = make("cube", size=int(sys.argv[1]))
mesh = Mesh(mesh.points, mesh.hexes)
began = perf_counter()
mesh.topology.face_neighbours, mesh.topology.boundary, mesh.topology.edges, mesh.topology.colouring(mesh.free)
topology = perf_counter() - began
began = perf_counter()
measure(mesh.points, mesh.hexes)
quality = perf_counter() - began
row = {"hexes": mesh.n_hexes, "topology_seconds": topology, "quality_seconds": quality, "peak_mb": peak_mb()}
print(json.dumps(row))
"""


def _scaling_lines(figures: dict[str, Any]) -> list[str]:
    return [
        f"{row['hexes']:>9,} hexes   topology {row['topology_seconds']:6.2f} s   "
        f"quality {row['quality_seconds'] * 1e3:7.1f} ms   peak {row['peak_mb']:6.0f} MB"
        for row in figures["sizes"]
    ]


ITERATIONS = BenchSection(
    "iterations", "One iteration on bridge-sharp, 32,000 hexes (median of 9)", _iterations, _iteration_lines
)
_TITLE = "Topology and quality against size (whole process)"
SCALING = BenchSection("scaling", _TITLE, partial(by_size, _PROBE), _scaling_lines)
