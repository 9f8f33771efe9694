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

from hexmend import kernels
from hexmend.gallery import make
from hexmend.io import read, write
from hexmend.study.bench.section import BenchSection

#: Variable that names other numbers of hexes of five-side, with commas between them.
_VARIABLE = "HEXMEND_SCALE"
_SIZES = "100000,1000000,4000000"
#: Numbers of hexes of the Kershaw meshes, whose optimum with a sliding boundary is the perfect lattice.
_KERSHAW = 24**3, 48**3

_OF_KERSHAW = ("--boundary", "slide", "--layers", "free", "--set", "goal=shape", "--set", "p=1")

_PROBE = """
import sys
from pathlib import Path
from hexmend.cli.main import main
from hexmend.study.bench.section import peak_mb
status = main(sys.argv[2:])
Path(sys.argv[1]).write_text(str(peak_mb()))
sys.exit(status)
"""


def measure_process(path: Path, folder: Path, options: tuple[str, ...] = ()) -> dict[str, Any]:
    """Measure `hexmend smooth` of a file to another one, in a new process.

    Parameters
    ----------
    path : Path
    folder : Path
        Where the result is written, as `out.vtu`.
    options : tuple of str
        Of the command.

    Returns
    -------
    dict
        `hexes`; `left`, inverted ones that remain; `seconds` of the process, and `method_seconds` of the method in it;
        `iterations`; `peak_mb`, MiB.
    """
    report, peak = folder / "report.json", folder / "peak.txt"
    words = ["smooth", str(path), "-o", str(folder / "out.vtu"), "--json", str(report), *options]
    began = perf_counter()
    done = subprocess.run([sys.executable, "-c", _PROBE, str(peak), *words], capture_output=True, text=True)
    if done.returncode:
        raise RuntimeError(f"hexmend {' '.join(words)}: {done.stderr.strip()}")
    seconds, output = perf_counter() - began, json.loads(report.read_text(encoding="utf-8"))
    return {
        "hexes": output["after"]["hexes"],
        "left": output["after"]["inverted"],
        "seconds": seconds,
        "method_seconds": output["seconds"],
        "iterations": output["iterations"],
        "peak_mb": float(peak.read_text(encoding="utf-8")),
    }


def _scale() -> dict[str, Any]:
    rows = []
    with tempfile.TemporaryDirectory(prefix="hexmend-") as name:
        folder, path = Path(name), Path(name) / "mesh.vtu"
        for size in os.environ.get(_VARIABLE, _SIZES).split(","):
            write(path, make("five-side", size=int(size), scramble=0.3))
            rows.append({"mesh": "five-side", **measure_process(path, folder)})
        for size in _KERSHAW:
            write(path, make("kershaw", size=size))
            row = {"mesh": "kershaw", **measure_process(path, folder, _OF_KERSHAW)}
            rows.append(row | {"deviation": _deviation(folder / "out.vtu")})
    return {"threads": kernels.threads(), "rows": rows}


def _deviation(path: Path) -> float:
    """Largest distance of a node from the lattice of the unit cube, in its edges, along an axis."""
    mesh = read(path)
    x = mesh.points * round(mesh.n_hexes ** (1 / 3))
    return float(np.abs(x - np.round(x)).max())


def _lines(figures: dict[str, Any]) -> list[str]:
    threads = figures["threads"]
    lines = [
        "| mesh | hexes | processes | threads | seconds | of it the method | peak, MiB | kB a hex | iterations |",
        "|:---|---:|---:|---:|---:|---:|---:|---:|---:|",
    ]
    for row in figures["rows"]:
        lines.append(
            f"| {row['mesh']} | {row['hexes']:,} | 1 | {threads} | {row['seconds']:.1f} | {row['method_seconds']:.1f} "
            f"| {row['peak_mb']:,.0f} | {row['peak_mb'] * 1.024**2 * 1000 / row['hexes']:.2f} | {row['iterations']} |"
        )
    kershaw = [row for row in figures["rows"] if "deviation" in row]
    furthest = max((row["deviation"] for row in kershaw), default=0.0)
    left = sum(row["left"] for row in figures["rows"])
    return [*lines, f"inverted hexes left: {left}; nodes of kershaw from the lattice: at most {furthest:.1e} edges"]


_TITLE = (
    f"Whole processes against size: five-side scrambled by 0.3, and kershaw sliding ({_VARIABLE} names other sizes)"
)
SCALE = BenchSection("scale", _TITLE, _scale, _lines)
