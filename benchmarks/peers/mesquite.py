"""Mesquite by its program `msqshape`: ShapeImprovementWrapper on a VTK file with fixed nodes."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from benchmarks.peers.peer import Peer, find_program, program_version, run_program
from hexmend.io import read
from hexmend.mesh.mesh import Mesh

VARIABLE = "HEXMEND_MESQUITE"


@dataclass(frozen=True)
class Mesquite(Peer):
    """The program `msqshape`, which is built with Mesquite."""

    def version(self) -> str:
        return program_version(find_program(VARIABLE, ("msqshape",)))

    def smooth(self, mesh: Mesh, folder: Path, seconds: float | None) -> tuple[np.ndarray, float]:
        source, target = folder / "given.vtk", folder / "left.vtk"
        _write(source, mesh)
        taken = run_program([find_program(VARIABLE, ("msqshape",)), str(source), str(target)], folder, seconds)
        return read(target).points, taken


def _write(path: Path, mesh: Mesh) -> None:
    """Write a mesh as Mesquite reads it: ASCII, with the attribute `fixed` of the nodes."""
    cells = np.column_stack([np.full(mesh.n_hexes, 8), mesh.hexes])
    with open(path, "w", encoding="ascii") as file:
        file.write("# vtk DataFile Version 3.0\nmesh\nASCII\nDATASET UNSTRUCTURED_GRID\n")
        file.write(f"POINTS {mesh.n_nodes} double\n")
        np.savetxt(file, mesh.points, "%.17g")
        file.write(f"CELLS {mesh.n_hexes} {cells.size}\n")
        np.savetxt(file, cells, "%d")
        file.write(f"CELL_TYPES {mesh.n_hexes}\n")
        np.savetxt(file, np.full(mesh.n_hexes, 12), "%d")
        file.write(f"POINT_DATA {mesh.n_nodes}\nSCALARS fixed int\nLOOKUP_TABLE default\n")
        np.savetxt(file, mesh.fixed.astype(int), "%d")


MESQUITE = Mesquite(
    name="mesquite",
    title="Mesquite",
    note="msqshape: ShapeImprovementWrapper with its defaults",
)
