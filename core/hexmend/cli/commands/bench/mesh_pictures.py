"""Small pictures of meshes, drawn by the command `hexmend render` of the viewer in processes of their own."""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile
from collections.abc import Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

from hexmend.errors import HexmendError
from hexmend.study.peers.peer import run_program

_OPTIONS = ("--size", "240x180", "--no-bar", "--key", "axes.show=false", "--key", "page.figures=false")

_MAX_SECONDS = 120.0


def draw_pictures(rows: Sequence[Mapping[str, Any]], folder: Path, jobs: int) -> tuple[dict[str, bytes], str]:
    """Draw a picture of each mesh that could be read; pictures that are in the folder already are reused.

    Parameters
    ----------
    rows : sequence of mapping
        Rows of the study.
    folder : Path
        Folder of the pictures, which are named by the hash of the mesh file.
    jobs : int
        Pictures drawn at a time.

    Returns
    -------
    pictures : dict
        PNG by the path of the mesh.
    problem : str
        Reason of the first picture that is missing; "" if there is none.
    """
    places = {row["mesh"]: folder / f"{row['mesh_hash']}.png" for row in rows if row["hexes"] is not None}
    missing = {target: mesh for mesh, target in places.items() if not target.is_file()}
    with ThreadPoolExecutor(jobs) as pool:
        problems = [problem for problem in pool.map(_draw, missing.values(), missing) if problem]
    found = {mesh: target.read_bytes() for mesh, target in places.items() if target.is_file()}
    return found, problems[0] if problems else ""


def _draw(mesh: str, target: Path) -> str:
    """Draw a mesh, and return the reason if it cannot be drawn."""
    source, target = Path(mesh).absolute(), target.absolute()
    command = [sys.executable, "-m", "hexmend", "render", str(source), "-o", str(target), *_OPTIONS]
    path = os.pathsep.join(filter(None, sys.path))
    try:
        with tempfile.TemporaryDirectory(prefix="hexmend-") as folder:
            run_program(command, Path(folder), _MAX_SECONDS, variables={"PYTHONPATH": path})
    except HexmendError as error:
        return f"{source.name}: {error}"
    except subprocess.TimeoutExpired:
        return f"{Path(mesh).name} was not drawn within {_MAX_SECONDS:g} s"
    return ""
