"""Sections of the benchmark."""

from __future__ import annotations

import json
import os
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Iterator
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from hexmend.errors import FileError, MeshError
from hexmend.io import read, readable_suffixes
from hexmend.mesh.mesh import Mesh

#: Counts of hexes of a summary in the tables.
COUNTS = ("inverted", "invalid")


@dataclass(frozen=True)
class BenchSection:
    """Section of the benchmark.

    Parameters
    ----------
    name, title : str
        Name on the command line, heading of the output.
    measure : callable
        Returns figures for JSON.
    lines : callable
        Formats the figures as lines of text.
    """

    name: str
    title: str
    measure: Callable[[], dict[str, Any]]
    lines: Callable[[dict[str, Any]], list[str]]


#: Numbers of hexes for figures against size.
_SIZES = 10_000, 100_000, 1_000_000


def probe(program: str, *words: object) -> dict[str, Any]:
    """Run a program in a new process, and return the JSON that it prints.

    Parameters
    ----------
    program : str
        Python source.
    *words : object
        Its arguments.

    Returns
    -------
    dict
    """
    command = [sys.executable, "-c", program, *map(str, words)]
    return json.loads(subprocess.run(command, stdout=subprocess.PIPE, text=True, check=True).stdout)


def by_size(program: str) -> dict[str, Any]:
    """Run a program with each size as argument; its rows are the `sizes` of the answer."""
    return {"sizes": [probe(program, size) for size in _SIZES]}


def smoothed(mesh: Path, *words: str) -> tuple[dict[str, Any], float]:
    """Run `hexmend smooth` on a mesh.

    Parameters
    ----------
    mesh : Path
    *words : str
        More options of the command.

    Returns
    -------
    report : dict
        What `--json` writes.
    seconds : float
        Of the whole process.

    Raises
    ------
    FileNotFoundError
        The command ended without a report.
    """
    with tempfile.TemporaryDirectory() as folder:
        output = Path(folder) / "report.json"
        command = ["smooth", str(mesh), "-o", f"{folder}/out.vtu", "--json", str(output), *words]
        begun = time.perf_counter()
        subprocess.run([sys.executable, "-m", "hexmend", *command], capture_output=True, check=False)
        seconds = time.perf_counter() - begun
        return json.loads(output.read_text("utf-8")), seconds


def mesh_files() -> list[Path]:
    """List the mesh files in the folder that the variable HEXMEND_MESHES names; none without it."""
    folder = os.environ.get("HEXMEND_MESHES")
    return [path for path in sorted(Path(folder).iterdir()) if path.suffix in readable_suffixes()] if folder else []


def collection() -> Iterator[tuple[Path, Mesh]]:
    """Yield the files that can be read, with their meshes."""
    for path in mesh_files():
        with suppress(FileError, MeshError):
            yield path, read(path)
