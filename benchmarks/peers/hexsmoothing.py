"""The program of the hexsmoothing project (Protais): elliptic smoothing with a fixed boundary, by L-BFGS."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from benchmarks.peers.peer import Peer, find_program, program_version, run_program
from hexmend.io import read, write
from hexmend.mesh.mesh import Mesh

#: Names of its programs that keep the boundary; the first two are for hexes only.
_NAMES = "innerSmoother", "innerSmoothing", "mixedSmoothing", "parallelMixedSmoothing"

VARIABLE = "HEXMEND_HEXSMOOTHING"


@dataclass(frozen=True)
class HexSmoothing(Peer):
    """The program with its own number of iterations, by Medit files.

    Its results depend on the unit of length, because it regularises relative to a cube of edge 1: the mesh is scaled to
    a mean edge of 1.
    """

    def version(self) -> str:
        return program_version(find_program(VARIABLE, _NAMES))

    def smooth(self, mesh: Mesh, folder: Path, seconds: float | None) -> tuple[np.ndarray, float]:
        source, target = folder / "given.mesh", folder / "left.mesh"
        edge = mesh.mean_edge_length
        write(source, mesh.with_points(mesh.points / edge))
        taken = run_program([find_program(VARIABLE, _NAMES), str(source), str(target)], folder, seconds)
        return read(target).points * edge, taken


HEXSMOOTHING = HexSmoothing(
    name="hexsmoothing",
    title="hexsmoothing",
    note="its program for hexes with its own number of iterations, the mesh scaled to a mean edge of 1",
    shape=True,
)
