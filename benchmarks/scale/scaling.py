"""Seconds and memory of topology and quality by mesh size."""

from __future__ import annotations

from functools import partial
from typing import Any

from benchmarks.section import BenchSection, by_size

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


_TITLE = "Topology and quality against size (whole process)"
SCALING = BenchSection("scaling", _TITLE, partial(by_size, _PROBE), _scaling_lines)
