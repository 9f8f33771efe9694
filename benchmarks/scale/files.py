"""Benchmark of files: seconds to write and to read a mesh, and the memory that reading takes."""

from __future__ import annotations

import os
import tempfile
from pathlib import Path
from typing import Any

from benchmarks.section import BenchSection, probe
from hexmend.gallery import make
from hexmend.io import write

#: Variable that names another number of hexes.
_VARIABLE = "HEXMEND_FILES"
_SIZE = 1_000_000
_SUFFIXES = ".vtu", ".vtkhdf", ".vtk", ".meshb", ".msh", ".exo"

# The mesh is read twice: once from VTU, to be written, and then from the file that is measured, in another process.
_WRITE = """
import json, sys
from time import perf_counter
from hexmend.io import read, write
mesh = read(sys.argv[1])
began = perf_counter()
write(sys.argv[2], mesh)
print(json.dumps({"seconds": perf_counter() - began}))
"""
_READ = """
import json, sys
from pathlib import Path
from time import perf_counter
from hexmend.gallery import make
from hexmend.io import read, write
from hexmend.run.memory import peak_mb, resident_mb
small = Path(sys.argv[1]).with_stem("small")
write(small, make("cube", size=8))
read(small)  # whatever has to be imported
before, began = resident_mb(), perf_counter()
mesh = read(sys.argv[1])
seconds, arrays = perf_counter() - began, (mesh.points.nbytes + mesh.hexes.nbytes) / 2**20
print(json.dumps({"seconds": seconds, "peak_mb": peak_mb() - before, "arrays_mb": arrays}))
"""


def _files() -> dict[str, Any]:
    rows = []
    with tempfile.TemporaryDirectory(prefix="hexmend-") as name:
        given = Path(name) / "given.vtu"
        mesh = make("five-side", size=int(os.environ.get(_VARIABLE, _SIZE)), scramble=0.3)
        write(given, mesh)
        for suffix in _SUFFIXES:
            path = Path(name) / f"mesh{suffix}"
            wrote, read = probe(_WRITE, given, path), probe(_READ, path)
            rows.append({
                "suffix": suffix,
                "mb": path.stat().st_size / 2**20,
                "write_seconds": wrote["seconds"],
                "read_seconds": read["seconds"],
                "peak_mb": read["peak_mb"],
                "arrays_mb": read["arrays_mb"],
            })  # fmt: skip
            path.unlink()
    return {"hexes": mesh.n_hexes, "rows": rows}


def _lines(figures: dict[str, Any]) -> list[str]:
    lines = [
        f"five-side, {figures['hexes']:,} hexes",
        "",
        "| file | size, MB | written, s | read, s | memory to read, in arrays of the mesh |",
        "|:---|---:|---:|---:|---:|",
    ]
    for row in figures["rows"]:
        share = row["peak_mb"] / row["arrays_mb"]
        seconds = f"{row['write_seconds']:.2f} | {row['read_seconds']:.2f}"
        lines.append(f"| {row['suffix']} | {row['mb']:.0f} | {seconds} | {share:.1f} |")
    return lines


FILES = BenchSection("files", f"Files of a mesh of the size {_VARIABLE} or {_SIZE:,} hexes", _files, _lines)
