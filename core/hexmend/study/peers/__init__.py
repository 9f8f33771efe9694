"""Measuring beside others: other programs on the same meshes with the same fixed boundary, all measured here.

`HEXMEND_PEERS` names a Python that has their packages (`gmsh`, `mfem`), this one if there is none;
`HEXMEND_HEXSMOOTHING` the program of the hexsmoothing project, one on the path if there is none;
`HEXMEND_PEERS_SECONDS` how long each may take for a mesh.
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
from hexmend.study.bench.default_method import real_meshes
from hexmend.study.bench.section import BenchSection
from hexmend.study.peers.programs import GMSH, TMOP

#: Gallery meshes by name, size and scramble.
MESHES = [("cube", 1000, 0.6), ("bridge-sharp", 1372, 0.6), ("five-side", 1360, 0.0), ("plane", 2500, 0.0)]

#: Names of the programs of the hexsmoothing project that keep the boundary, the one for hexes alone first.
_HEXSMOOTHING = "innerSmoother", "mixedSmoothing", "parallelMixedSmoothing"

#: Positions and seconds of a mesh; raises `Absent`, `HexmendError` or `subprocess.TimeoutExpired`.
Peer = Callable[[Mesh, Path, float], tuple[np.ndarray, float]]


class Absent(Exception):
    """A program that is not here."""


@dataclass(frozen=True)
class PythonPeer:
    """A peer that is a package of Python."""

    package: str
    program: str

    def __call__(self, mesh: Mesh, folder: Path, seconds: float) -> tuple[np.ndarray, float]:
        python = os.environ.get("HEXMEND_PEERS") or sys.executable
        found = subprocess.run([python, "-c", f"import {self.package}"], capture_output=True, check=False)
        if found.returncode:
            raise Absent(f"{python} has no {self.package}: pip install {self.package}, HEXMEND_PEERS names the Python")
        given, left = folder / "given.npz", folder / "left.npz"
        hexes, faces = np.nonzero(mesh.topology.face_neighbours < 0)
        quads = mesh.hexes[hexes[:, None], FACES[faces]]
        np.savez(given, points=mesh.points, hexes=mesh.hexes.astype(np.int64), quads=quads.astype(np.int64))
        _run([python, "-c", self.program, str(given), str(left)], seconds)
        with np.load(left, allow_pickle=False) as done:
            return np.ascontiguousarray(done["points"], dtype=np.float64), float(done["seconds"])


def _hexsmoothing(mesh: Mesh, folder: Path, seconds: float) -> tuple[np.ndarray, float]:
    """The whole process is timed; of the formats that it reads, Medit's is the one that keeps every digit.

    `innerSmoother` compares corners with those of a cube of edge 1 and regularises by fixed fractions of it, so that
    what it leaves depends on the unit of length: it has the mesh with a mean edge of 1.
    """
    own = os.environ.get("HEXMEND_HEXSMOOTHING")
    program = shutil.which(own) if own else next(filter(None, map(shutil.which, _HEXSMOOTHING)), None)
    if program is None:
        raise Absent(f"there is no {own or ' or '.join(_HEXSMOOTHING)}: HEXMEND_HEXSMOOTHING names the program")
    given, left = folder / "given.mesh", folder / "left.mesh"
    edge = mesh.mean_edge_length
    write(given, mesh.with_points(mesh.points / edge))
    began = perf_counter()
    # In its folder: `parallelMixedSmoothing` leaves files of its own where it is run.
    _run([os.path.abspath(program), str(given), str(left)], seconds, folder)
    taken = perf_counter() - began
    return read(left).points * edge, taken


def _hexmend(mesh: Mesh, folder: Path, seconds: float) -> tuple[np.ndarray, float]:
    result = smooth(mesh, "mend", StoppingCriteria(max_iterations=1000, max_seconds=seconds))
    return result.mesh.points, result.seconds + result.setup_seconds


def _run(command: list[str], seconds: float, folder: Path | None = None) -> None:
    done = subprocess.run(command, capture_output=True, text=True, timeout=seconds, check=False, cwd=folder)
    if done.returncode:
        said = done.stderr.strip().splitlines() or [f"it ended with status {done.returncode}"]
        raise HexmendError(said[-1])


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
    for given in [*gallery, *real_meshes()]:
        mesh = Mesh(given.points, given.hexes, name=given.name)  # the boundary is fixed, and nothing else
        before = summarise(mesh)
        rows.append({"mesh": mesh.name, "program": "before", **_figures(mesh)})
        for name, program in PROGRAMS.items():
            if name not in absent:
                row = {"mesh": mesh.name, "program": name, "hexes": before.hexes}
                try:
                    rows.append(row | _done(program, mesh, seconds))
                except Absent as error:
                    absent[name] = str(error)
    return {"limit_seconds": seconds, "rows": rows, "absent": absent}


def _done(program: Peer, mesh: Mesh, seconds: float) -> dict[str, Any]:
    """What a program makes of a mesh, or why nothing."""
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
        aside = "   moved the boundary" if row.get("boundary_moved", 0.0) > 1e-6 else ""
        taken = f"{row['seconds']:9.2f}" if "seconds" in row else ""
        lines.append(
            f"  {name:<26} {row['inverted']:>6,} {row['scaled_jacobian_min']:>20.4f} {row['q_min']:>7.4f} "
            f"{row['q_mean']:>7.4f} {taken}{aside}"
        )
    return lines + [f"absent: {name} ({why})" for name, why in figures["absent"].items()]


PEERS = BenchSection("peers", "Beside other programs, the boundary fixed", _peers, _lines)
