"""Adapter of a program that smooths meshes, and the processes in which programs run."""

from __future__ import annotations

import hashlib
import os
import shutil
import subprocess
import sys
from abc import ABC, abstractmethod
from collections.abc import Container, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from time import perf_counter

import numpy as np

from hexmend.errors import HexmendError
from hexmend.mesh.hexahedron import FACES
from hexmend.mesh.mesh import Mesh

#: Python with the packages of peers; this one if it is not set.
PYTHON_VARIABLE = "HEXMEND_PEERS"

#: Variables that give a program one thread.
_THREADS = "HEXMEND_THREADS", "OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS"


class MissingPeer(HexmendError):
    """Program that is not installed; the message says how it is made available."""


@dataclass(frozen=True)
class Peer(ABC):
    """Adapter of a program.

    Parameters
    ----------
    name : str
        Key of its rows.
    title : str
        Name in tables.
    note : str
        Method of the program and its settings, as a sentence.
    slides : bool
        The program moves nodes of the boundary.
    shape : bool
        The program minimises the objective of `mend` with p = 1, or nearly so.
    own : bool
        A run of Hexmend.
    """

    name: str
    title: str
    note: str
    slides: bool = False
    shape: bool = False
    own: bool = False

    @abstractmethod
    def version(self) -> str:
        """Return the version that is installed; results are stored under it.

        Raises
        ------
        MissingPeer
            If it is not installed.
        """

    @abstractmethod
    def smooth(self, mesh: Mesh, folder: Path, seconds: float | None) -> tuple[np.ndarray, float]:
        """Smooth a mesh.

        Parameters
        ----------
        mesh : Mesh
            Only nodes of its boundary are fixed.
        folder : Path
            Folder for files, which is removed afterwards.
        seconds : float or None
            Time limit of the process.

        Returns
        -------
        points : (n, 3) float
            New positions of the nodes.
        seconds : float
            Seconds of the whole process, with start, reading and writing.

        Raises
        ------
        HexmendError
            If the program fails, with the last line of its errors, or if its result cannot be read.
        subprocess.TimeoutExpired
            If it exceeds the limit; its process has been ended.
        """


@dataclass(frozen=True)
class PythonPeer(Peer):
    """Peer that is a Python package; Hexmend need not be installed in its Python.

    Parameters
    ----------
    package : str
        Name of the package, also for pip.
    program : str
        Source of a script. Its arguments are the paths of two NumPy archives: input with `points` (n, 3), `hexes`
        (m, 8) and `quads` (k, 4) of the boundary, output with `points` (n, 3).
    """

    package: str = ""
    program: str = ""

    def version(self) -> str:
        python = self._python
        script = f"import {self.package} as package; print(getattr(package, '__version__', 'unknown'))"
        try:
            done = subprocess.run([python, "-c", script], capture_output=True, text=True, check=False)
        except OSError as error:
            raise MissingPeer(f"{python} cannot be run ({error.strerror}): {PYTHON_VARIABLE} names a Python") from None
        if done.returncode:
            remedy = f"pip install {self.package}; {PYTHON_VARIABLE} names the Python that has it"
            raise MissingPeer(remedy)
        return f"{self.package} {done.stdout.split()[-1]}"

    def smooth(self, mesh: Mesh, folder: Path, seconds: float | None) -> tuple[np.ndarray, float]:
        source, target = folder / "given.npz", folder / "left.npz"
        hexes, faces = np.nonzero(mesh.topology.face_neighbours < 0)
        quads = mesh.hexes[hexes[:, None], FACES[faces]]
        np.savez(source, points=mesh.points, hexes=mesh.hexes.astype(np.int64), quads=quads.astype(np.int64))
        taken = run_program([self._python, "-c", self.program, str(source), str(target)], folder, seconds)
        try:
            with np.load(target, allow_pickle=False) as done:
                return np.ascontiguousarray(done["points"], dtype=np.float64), taken
        except (OSError, KeyError, ValueError) as error:
            raise HexmendError(f"it left no positions: {error}") from None

    @property
    def _python(self) -> str:
        return os.environ.get(PYTHON_VARIABLE) or sys.executable


def run_program(
    command: Sequence[str],
    folder: Path,
    seconds: float | None = None,
    *,
    variables: Mapping[str, str] | None = None,
    accepted: Container[int] = (0,),
) -> float:
    """Run a command in a folder, with its output in files there, and return its seconds.

    Parameters
    ----------
    command : sequence of str
    folder : Path
    seconds : float, optional
        Time limit.
    variables : mapping, optional
        Variables of its environment in addition to those of this process.
    accepted : container of int
        Exit statuses with which it has done its work.

    Returns
    -------
    float

    Raises
    ------
    HexmendError
        If it fails; the message is the last line of its errors.
    subprocess.TimeoutExpired
        If it takes more than `seconds`.
    """
    errors = folder / "errors.txt"
    began = perf_counter()
    with open(folder / "output.txt", "wb") as output, open(errors, "wb") as lines:
        environment = {**os.environ, **dict.fromkeys(_THREADS, "1"), **(variables or {})}
        try:
            done = subprocess.run(
                command, stdout=output, stderr=lines, timeout=seconds, check=False, cwd=folder, env=environment
            )
        except OSError as error:
            raise HexmendError(f"{command[0]} cannot be run: {error.strerror or error}") from None
    taken = perf_counter() - began
    if done.returncode not in accepted:
        last = errors.read_text(encoding="utf-8", errors="replace").strip().splitlines()[-1:]
        raise HexmendError(last[0] if last else f"it ended with status {done.returncode} and gave no reason")
    return taken


def find_program(variable: str, names: Sequence[str]) -> str:
    """Return the absolute path of a program: that which a variable of the environment names, else one on the path.

    Raises
    ------
    MissingPeer
        If there is none.
    """
    own = os.environ.get(variable)
    found = shutil.which(own) if own else next(filter(None, map(shutil.which, names)), None)
    if found is None:
        raise MissingPeer(f"there is no {own or ', '.join(names)}; {variable} names the program")
    return os.path.abspath(found)


def program_version(path: str) -> str:
    """Return the name of a program and a hash of its file, for programs that print no version."""
    with open(path, "rb") as file:
        return f"{Path(path).name} {hashlib.file_digest(file, 'sha256').hexdigest()[:12]}"
