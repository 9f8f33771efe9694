"""Benchmark of whole processes against size: seconds, memory and iterations of `hexmend smooth` from file to file."""

from __future__ import annotations

import json
import os
import subprocess
import sys
import tempfile
from pathlib import Path
from time import perf_counter
from typing import Any

import numpy as np

from benchmarks.scale.launching import environment, launcher, on_ranks
from benchmarks.section import BenchSection
from hexmend import kernels
from hexmend.gallery import make
from hexmend.io import read, write

#: Variable that names other numbers of hexes of five-side, with commas between them.
_VARIABLE = "HEXMEND_SCALE"
_SIZES = "100000,1000000,4000000"
#: Variable that names other numbers of MPI ranks; more than one where mpiexec is installed.
_VARIABLE_OF_RANKS = "HEXMEND_RANKS"
_RANKS = "1,2,4"
#: Variable that names other numbers of hexes along an edge of the Kershaw meshes, whose optimum with a sliding boundary
#: is the perfect lattice.
_VARIABLE_OF_KERSHAW = "HEXMEND_KERSHAW"
_KERSHAW = "24,48,96"

_OF_KERSHAW = ("--boundary", "slide", "--layers", "free", "--set", "goal=shape", "--set", "p=1")

_PROBE = """
import sys
from pathlib import Path
from hexmend.cli.main import main
from hexmend.run.memory import peak_mb
status = main(sys.argv[2:])
Path(sys.argv[1]).write_text(str(peak_mb()))
sys.exit(status)
"""


def measure_process(path: Path, folder: Path, options: tuple[str, ...] = (), ranks: int = 1) -> dict[str, Any]:
    """Measure `hexmend smooth` of a file to another one, in a new process or in several.

    Parameters
    ----------
    path : Path
    folder : Path
        Where the result is written, as `out.vtu`.
    options : tuple of str
        Of the command.
    ranks : int
        MPI ranks.

    Returns
    -------
    dict
        `hexes`; `left`, inverted ones that remain; `seconds` of the process, and `method_seconds` of the method in it;
        `iterations`; `ranks`, `threads` of each; `peak_mb`, MiB, the largest of a rank.
    """
    report, peak = folder / "report.json", folder / "peak.txt"
    words = ["smooth", str(path), "-o", str(folder / "out.vtu"), "--json", str(report), *options]
    command = on_ranks(ranks, [sys.executable, "-c", _PROBE, str(peak), *words])
    began = perf_counter()
    done = subprocess.run(command, capture_output=True, text=True, env=environment() if ranks > 1 else None)
    if done.returncode:
        raise RuntimeError(f"hexmend {' '.join(words)}: {done.stderr.strip()}")
    seconds, output = perf_counter() - began, json.loads(report.read_text(encoding="utf-8"))
    return {
        "hexes": output["after"]["hexes"],
        "left": output["after"]["inverted"],
        "seconds": seconds,
        "method_seconds": output["seconds"],
        "iterations": output["iterations"],
        "ranks": ranks,
        "threads": kernels.threads() if ranks == 1 else max(output["ranks"]["threads"]),
        "peak_mb": float(peak.read_text(encoding="utf-8")) if ranks == 1 else max(output["ranks"]["peak_mb"]),
    }


def _scale() -> dict[str, Any]:
    rows, counts = [], [int(word) for word in os.environ.get(_VARIABLE_OF_RANKS, _RANKS).split(",")]
    counts = counts if launcher() is not None else [1]
    with tempfile.TemporaryDirectory(prefix="hexmend-") as name:
        folder, path = Path(name), Path(name) / "mesh.vtu"
        for size in os.environ.get(_VARIABLE, _SIZES).split(","):
            write(path, make("five-side", size=int(size), scramble=0.3))
            for ranks in counts:
                rows.append({"mesh": "five-side", **measure_process(path, folder, ranks=ranks)})
        for edge in os.environ.get(_VARIABLE_OF_KERSHAW, _KERSHAW).split(","):
            write(path, make("kershaw", size=int(edge) ** 3))
            row = {"mesh": "kershaw", **measure_process(path, folder, _OF_KERSHAW)}
            rows.append(row | {"deviation": _deviation(folder / "out.vtu")})
    return {"rows": rows}


def _deviation(path: Path) -> float:
    """Largest distance of a node from the lattice of the unit cube, in its edges, along an axis."""
    mesh = read(path)
    x = mesh.points * round(mesh.n_hexes ** (1 / 3))
    return float(np.abs(x - np.round(x)).max())


def _lines(figures: dict[str, Any]) -> list[str]:
    lines = [
        "| mesh | hexes | ranks | threads of each | seconds | of it the method | peak of a rank, MiB | in kB a hex "
        "| iterations |",
        "|:---|---:|---:|---:|---:|---:|---:|---:|---:|",
    ]
    for row in figures["rows"]:
        lines.append(
            f"| {row['mesh']} | {row['hexes']:,} | {row['ranks']} | {row['threads']} | {row['seconds']:.1f} "
            f"| {row['method_seconds']:.1f} | {row['peak_mb']:,.0f} "
            f"| {row['peak_mb'] * 1.024**2 * 1000 / row['hexes']:.2f} | {row['iterations']} |"
        )
    kershaw = [row for row in figures["rows"] if "deviation" in row]
    furthest = max((row["deviation"] for row in kershaw), default=0.0)
    left = sum(row["left"] for row in figures["rows"])
    return [*lines, f"inverted hexes left: {left}; nodes of kershaw from the lattice: at most {furthest:.1e} edges"]


_TITLE = (
    f"Whole processes against size: five-side scrambled by 0.3, and kershaw sliding ({_VARIABLE} and "
    f"{_VARIABLE_OF_KERSHAW} name other sizes, {_VARIABLE_OF_RANKS} other numbers of MPI ranks)"
)
SCALE = BenchSection("scale", _TITLE, _scale, _lines)
