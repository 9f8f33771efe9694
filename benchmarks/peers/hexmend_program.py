"""Hexmend as a program: `hexmend smooth` from file to file, so that its seconds are those of a whole process too."""

from __future__ import annotations

import os
import sys
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from benchmarks.peers.peer import Peer, run_program
from hexmend.io import read, write
from hexmend.mesh.mesh import Mesh

#: Exit statuses with a result: done, and done but with invalid hexes.
_ENDS = 0, 4


@dataclass(frozen=True)
class HexmendProgram(Peer):
    """The command `hexmend smooth` with options.

    Parameters
    ----------
    options : tuple of str
    """

    options: tuple[str, ...] = ()
    own: bool = True

    def version(self) -> str:
        """Return the options: tasks have the version of Hexmend already."""
        return " ".join(self.options)

    def smooth(self, mesh: Mesh, folder: Path, seconds: float | None) -> tuple[np.ndarray, float]:
        source, target = folder / "given.vtk", folder / "left.vtk"
        write(source, mesh)
        command = [sys.executable, "-m", "hexmend", "smooth", str(source), "-o", str(target), *self.options]
        path = os.pathsep.join(filter(None, sys.path))
        taken = run_program(command, folder, seconds, variables={"PYTHONPATH": path}, accepted=_ENDS)
        return read(target).points, taken


#: Options under which `mend` minimises the functional of TMOP. It keeps the last iterate, which has the lowest
#: objective, where it would else keep the one with the highest q min.
_SHAPE = ("--goal", "shape", "--set", "p=1", "--layers", "free", "--keep-last")

FIXED = HexmendProgram(
    name="mend-fixed",
    title="mend, fixed",
    note="hexmend smooth with its defaults, the boundary fixed",
)
SLIDE = HexmendProgram(
    name="mend-slide",
    title="mend, slide",
    note="hexmend smooth --boundary slide",
    slides=True,
    options=("--boundary", "slide"),
)
SHAPE = HexmendProgram(
    name="mend-p1",
    title="mend, p = 1",
    note=f"hexmend smooth {' '.join(_SHAPE)}, the boundary fixed: the functional of TMOP",
    options=_SHAPE,
    shape=True,
)
