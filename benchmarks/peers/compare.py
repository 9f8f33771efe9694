"""Comparison with other programs: every mesh of folders, smoothed by all programs that are installed."""

from __future__ import annotations

import subprocess
import tempfile
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

from benchmarks.peers import PEERS
from benchmarks.peers.peer import MissingPeer, Peer
from benchmarks.peers.record import Comparison
from benchmarks.peers.tables import comparison_tables
from benchmarks.prose import wrapped
from hexmend.boundary.comparison import surface_change
from hexmend.errors import HexmendError
from hexmend.io import read
from hexmend.mesh.mesh import Mesh
from hexmend.quality import measure, objective, summarise
from hexmend.report.documents import machine_words
from hexmend.report.markdown import escape, markdown
from hexmend.study.batch.plan import find_meshes
from hexmend.study.machine import machine

#: Marks in a page of Markdown between which the tables are written.
BEGIN, END = "<!-- collection -->", "<!-- end -->"


def run(places: Sequence[str], seconds: float, page: str | None) -> None:
    """Compare the programs on the meshes of folders; print the tables, or write them into a page of Markdown.

    Parameters
    ----------
    places : sequence of str
        Folders, or mesh files.
    seconds : float
        Time limit of a program for a mesh.
    page : str or None
        Page with the marks `BEGIN` and `END`.
    """
    record = compare(find_meshes(map(Path, places)), PEERS, seconds)
    text = wrapped("\n\n".join([conditions(record), *map(markdown, comparison_tables(record))]).rstrip())
    if page is None:
        print(text)
        return
    before, _, rest = Path(page).read_text("utf-8").partition(BEGIN)
    Path(page).write_text(f"{before}{BEGIN}\n{text}\n{END}{rest.partition(END)[2]}", "utf-8")


def compare(meshes: Sequence[Path], programs: Sequence[Peer], seconds: float) -> Comparison:
    """Run programs on meshes, one after another.

    Parameters
    ----------
    meshes : sequence of Path
    programs : sequence of Peer
    seconds : float
        Time limit of a program for a mesh.

    Returns
    -------
    Comparison
        A row has `mesh`, `program`, `status` and `reason`; with a mesh that can be read, `hexes` and its figures with
        `_before` behind their names; with a result, its figures with `_after`, `seconds` of the whole process, and
        `boundary_distance` in per cent of the diagonal.
    """
    versions, missing = {}, {}
    for program in programs:
        try:
            versions[program.name] = program.version()
        except MissingPeer as error:
            missing[program.name] = str(error)
    rows = []
    for path in meshes:
        for program in (program for program in programs if program.name in versions):
            rows.append({"mesh": str(path), "program": program.name, **_row(path, program, seconds)})
            print(f"{path.name}, {program.title}: {rows[-1]['status']}", flush=True)
    return Comparison(rows, programs, versions, missing, machine(), seconds)


def conditions(record: Comparison) -> str:
    """Describe the computer, the limit and the versions of other programs."""
    versions = [record.versions[program.name] for program in record.run if not program.own]
    others = f" Other programs: {escape(', '.join(versions))}." if versions else ""
    return f"{machine_words(record.machine)} A program has {record.limit:g} s for a mesh, on one thread.{others}"


def _row(path: Path, program: Peer, seconds: float) -> dict[str, Any]:
    row: dict[str, Any] = {"status": "unreadable", "reason": ""}
    try:
        mesh = _bare(read(path))
        row |= {"status": "failed", "hexes": mesh.n_hexes, **_figures(mesh, "before")}
        with tempfile.TemporaryDirectory(prefix="hexmend-") as folder:
            points, taken = program.smooth(mesh, Path(folder), seconds)
        result = mesh.with_points(points)
        row |= {"status": "done", "seconds": taken, **_figures(result, "after")}
        row["boundary_distance"] = _distance(mesh, result)
    except subprocess.TimeoutExpired:
        row |= {"status": "out of time", "reason": f"It was not done within {seconds:g} s, and was ended."}
    except HexmendError as error:
        row["reason"] = str(error)
    return row


def _bare(mesh: Mesh) -> Mesh:
    """Return the mesh of linear hexes with the nodes that they use, of which only those of the boundary are fixed."""
    used = np.unique(mesh.hexes)
    return Mesh(mesh.points[used], np.searchsorted(used, mesh.hexes), name=mesh.name)


def _figures(mesh: Mesh, when: str) -> dict[str, Any]:
    """Return the figures of `Summary`, and the objective with p = 1."""
    quality = measure(mesh.points, mesh.hexes)
    figures = summarise(mesh, quality).to_dict() | {"objective_p1": objective(quality, p=1.0)}
    return {f"{key}_{when}": value for key, value in figures.items()}


def _distance(mesh: Mesh, result: Mesh) -> float:
    if np.array_equal(result.points[mesh.fixed], mesh.points[mesh.fixed]):
        return 0.0
    return surface_change(mesh, result).max_percent_of_diagonal
