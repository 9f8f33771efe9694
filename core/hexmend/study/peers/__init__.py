"""Benchmark against other programs, on the same meshes with a fixed boundary; all results are measured by Hexmend.

Environment: `HEXMEND_PEERS` is a Python with their packages (`gmsh`, `mfem`), by default this one;
`HEXMEND_HEXSMOOTHING` is the program of the hexsmoothing project, by default one on the path;
`HEXMEND_PEERS_SECONDS` is the time limit of each for a mesh.
"""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from time import perf_counter
from typing import Any

import numpy as np

from hexmend.errors import HexmendError
from hexmend.gallery import make
from hexmend.io import read, write
from hexmend.mesh.hexahedron import FACES
from hexmend.mesh.mesh import Mesh
from hexmend.quality import summarise
from hexmend.run import StoppingCriteria, smooth
from hexmend.study.bench.collection import collection
from hexmend.study.bench.section import BenchSection
from hexmend.study.peers.programs import GMSH, TMOP

#: Gallery meshes by name, size and scramble.
MESHES = [("cube", 1000, 0.6), ("bridge-sharp", 1372, 0.6), ("five-side", 1360, 0.0), ("plane", 2500, 0.0)]

#: Programs of the hexsmoothing project that keep the boundary; the first is for hexes only.
_HEXSMOOTHING = "innerSmoother", "mixedSmoothing", "parallelMixedSmoothing"

#: Smooths a mesh in a folder within a time limit; returns points and seconds. Raises `MissingProgram`, `HexmendError`
#: or `subprocess.TimeoutExpired`.
Peer = Callable[[Mesh, Path, float], tuple[np.ndarray, float]]


class MissingProgram(Exception):
    """The program is not installed."""


@dataclass(frozen=True)
class PythonPeer:
    """Peer that is a Python package."""

    package: str
    program: str

    def __call__(self, mesh: Mesh, folder: Path, seconds: float) -> tuple[np.ndarray, float]:
        python = os.environ.get("HEXMEND_PEERS") or sys.executable
        found = subprocess.run([python, "-c", f"import {self.package}"], capture_output=True, check=False)
        if found.returncode:
            remedy = f"pip install {self.package}, HEXMEND_PEERS names the Python"
            raise MissingProgram(f"{python} has no {self.package}: {remedy}")
        source, target = folder / "given.npz", folder / "left.npz"
        hexes, faces = np.nonzero(mesh.topology.face_neighbours < 0)
        quads = mesh.hexes[hexes[:, None], FACES[faces]]
        np.savez(source, points=mesh.points, hexes=mesh.hexes.astype(np.int64), quads=quads.astype(np.int64))
        _run([python, "-c", self.program, str(source), str(target)], seconds)
        with np.load(target, allow_pickle=False) as done:
            return np.ascontiguousarray(done["points"], dtype=np.float64), float(done["seconds"])


def _hexsmoothing(mesh: Mesh, folder: Path, seconds: float) -> tuple[np.ndarray, float]:
    """Run hexsmoothing; the time is that of the whole process, with reading and writing Medit files.

    Its results depend on the unit of length, because `innerSmoother` regularises relative to a cube of edge 1: the mesh
    is scaled to a mean edge of 1.
    """
    own = os.environ.get("HEXMEND_HEXSMOOTHING")
    program = shutil.which(own) if own else next(filter(None, map(shutil.which, _HEXSMOOTHING)), None)
    if program is None:
        raise MissingProgram(f"there is no {own or ' or '.join(_HEXSMOOTHING)}: HEXMEND_HEXSMOOTHING names the program")
    source, target = folder / "given.mesh", folder / "left.mesh"
    edge = mesh.mean_edge_length
    write(source, mesh.with_points(mesh.points / edge))
    began = perf_counter()
    # `parallelMixedSmoothing` leaves files in its working folder
    _run([os.path.abspath(program), str(source), str(target)], seconds, folder)
    taken = perf_counter() - began
    return read(target).points * edge, taken


def _hexmend(mesh: Mesh, folder: Path, seconds: float) -> tuple[np.ndarray, float]:
    stop = StoppingCriteria(max_iterations=1000, max_seconds=seconds)
    result = smooth(mesh, "mend", stop, progress=False, goal="shape")
    return result.mesh.points, result.seconds + result.setup_seconds


def _run(command: list[str], seconds: float, folder: Path | None = None) -> None:
    done = subprocess.run(command, capture_output=True, text=True, timeout=seconds, check=False, cwd=folder)
    if done.returncode:
        lines = done.stderr.strip().splitlines() or [f"it ended with status {done.returncode}"]
        raise HexmendError(lines[-1])


PROGRAMS: dict[str, Peer] = {
    "Hexmend, mend": _hexmend,
    "hexsmoothing": _hexsmoothing,
    "Gmsh, UntangleMeshGeometry": PythonPeer("gmsh", GMSH),
    "PyMFEM, TMOP": PythonPeer("mfem", TMOP),
}


def _peers() -> dict[str, Any]:
    seconds = float(os.environ.get("HEXMEND_PEERS_SECONDS") or 120)
    gallery = [make(name, size=size, scramble=scramble, seed=1) for name, size, scramble in MESHES]
    absent: dict[str, str] = {}
    rows = []
    for source in [*gallery, *(mesh for _, mesh in collection())]:
        mesh = Mesh(source.points, source.hexes, name=source.name)  # only the boundary is fixed
        before = summarise(mesh)
        rows.append({"mesh": mesh.name, "program": "before", **_figures(mesh)})
        for name, program in PROGRAMS.items():
            if name not in absent:
                row = {"mesh": mesh.name, "program": name, "hexes": before.hexes}
                try:
                    rows.append(row | _run_program(program, mesh, seconds))
                except MissingProgram as error:
                    absent[name] = str(error)
    return {"limit_seconds": seconds, "rows": rows, "absent": absent}


def _run_program(program: Peer, mesh: Mesh, seconds: float) -> dict[str, Any]:
    """Run a program on a mesh; return figures of the result, or the reason of its failure."""
    with tempfile.TemporaryDirectory() as name:
        try:
            points, taken = program(mesh, Path(name), seconds)
            after = mesh.with_points(points)
        except subprocess.TimeoutExpired:
            return {"failure": f"not done in {seconds:.0f} s"}
        except (HexmendError, OSError, KeyError, ValueError) as error:
            return {"failure": str(error)}
    moved = float(np.abs(points - mesh.points)[mesh.fixed].max(initial=0.0)) / mesh.mean_edge_length
    return {"seconds": taken, "boundary_moved": moved, **_figures(after)}


def _figures(mesh: Mesh) -> dict[str, Any]:
    summary = summarise(mesh).to_dict()
    return {key: summary[key] for key in ("hexes", "inverted", "scaled_jacobian_min", "q_min", "q_mean")}


def _lines(figures: dict[str, Any]) -> list[str]:
    lines = [f"{'':<26} inverted  scaled Jacobian min   q min  q mean   seconds"]
    for row in figures["rows"]:
        name = row["program"]
        if name == "before":
            lines.append(f"{row['mesh']}, {row['hexes']:,} hexes")
        if "failure" in row:
            lines.append(f"  {name:<26} {row['failure']}")
            continue
        note = "   moved the boundary" if row.get("boundary_moved", 0.0) > 1e-6 else ""
        taken = f"{row['seconds']:9.2f}" if "seconds" in row else ""
        lines.append(
            f"  {name:<26} {row['inverted']:>6,} {row['scaled_jacobian_min']:>20.4f} {row['q_min']:>7.4f} "
            f"{row['q_mean']:>7.4f} {taken}{note}"
        )
    return lines + [f"absent: {name} ({reason})" for name, reason in figures["absent"].items()]


PEERS = BenchSection("peers", "Other programs, the boundary fixed", _peers, _lines)
