"""Figures of meshes in Chapter 4 of the thesis.

The core cannot draw meshes: a function of type `Draw` is found by the entry-point group `hexmend.figures`.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from importlib.metadata import entry_points
from pathlib import Path
from typing import Any

from hexmend.errors import HexmendError
from hexmend.mesh.mesh import Mesh
from hexmend.quality import Summary, summarise
from hexmend.study.thesis.experiment_result import ExperimentResult
from hexmend.study.thesis.experiments import INITIAL
from hexmend.terminal_text import install_hint


@dataclass(frozen=True)
class MeshFigure:
    """Figure of the thesis.

    Parameters
    ----------
    number : str
        Number in the thesis.
    stem : str
        Part of the file name after the number.
    caption : str
        Caption in the thesis.
    mesh : str
        Name of the gallery mesh.
    column : str
        State of the mesh: initial, or the result of a method.
    shows : str
        "geometry": the boundary and its sharp edges. "mesh": the boundary and all edges. "domain": the body in
        the middle of it. "section": whole hexes behind a plane through that, coloured by quality.
    view : tuple of 3 floats
        Direction of view.
    up : str
        Upward axis: x, y or z.
    """

    number: str
    stem: str
    caption: str
    mesh: str
    column: str
    shows: str
    view: tuple[float, float, float]
    up: str = "z"


#: Draws a figure of a mesh as PNG, PDF or SVG, by the suffix of the path.
Draw = Callable[[MeshFigure, Mesh, Path], object]

#: Kind and direction of view of the three cross sections of the plane.
_SECTION = "section", (-0.35, -1.0, 0.25)
_BY_GETME = "Plane mesh smoothed using the GETMe Simultaneous smoother"
_BY_OPTIMISATION = "Plane mesh smoothed using optimisation smoothers"

#: Figures of Chapter 4, in order.
MESH_FIGURES = (
    MeshFigure("4.1", "bridge-sharp", "BridgeSharp geometry", "bridge-sharp", INITIAL, "geometry", (0.7, 0.45, 1), "y"),
    MeshFigure("4.2", "bridge-sharp-mesh", "BridgeSharp mesh", "bridge-sharp", INITIAL, "mesh", (0, 0, 1), "y"),
    MeshFigure("4.3", "five-side", "FiveSide geometry", "five-side", INITIAL, "geometry", (0.2, -1, 0.5)),
    MeshFigure("4.5", "plane", "Domain around an aeroplane", "plane", INITIAL, "domain", (-0.8, -1, 0.6)),
    MeshFigure("4.6", "plane-initial", "Original Plane mesh", "plane", INITIAL, *_SECTION),
    MeshFigure("4.7", "plane-getme", _BY_GETME, "plane", "getme", *_SECTION),
    MeshFigure("4.8", "plane-optimised", _BY_OPTIMISATION, "plane", "local-sd", *_SECTION),
)


def draw_figures(
    folder: Path, results: Sequence[ExperimentResult], formats: Sequence[str] = ("png",)
) -> tuple[list[dict[str, Any]], str]:
    """Draw the figures of measured experiments.

    Parameters
    ----------
    folder : Path
        Folder of the files.
    results : sequence of ExperimentResult
    formats : sequence of str
        Suffixes of the files, without the dot.

    Returns
    -------
    figures : list of dict
        Number, caption and file (in the last of the formats) of each drawn figure, for JSON.
    missing : str
        Numbers of the others, and what to do; "" if all were drawn.
    """
    found = [(figure, state) for figure in MESH_FIGURES if (state := _state(figure, results)) is not None]
    draw, drawn, problem = _drawer(), [], install_hint("app")
    for figure, (mesh, summary) in found:
        if draw is None:
            break
        files = [f"figure-{figure.number}-{figure.stem}.{suffix}" for suffix in formats]
        try:
            for file in files:
                draw(figure, mesh, folder / file)
        except HexmendError as error:  # the tables are still useful
            problem = str(error)
            break
        drawn.append({"number": figure.number, "caption": _caption(figure, summary), "file": files[-1]})
    missing = [figure.number for figure, _ in found[len(drawn) :]]
    names = f"{'figure' if len(missing) == 1 else 'figures'} {', '.join(missing)}"
    return drawn, f"Without {names}, of meshes: {problem}" if missing else ""


def _state(figure: MeshFigure, results: Sequence[ExperimentResult]) -> tuple[Mesh, Summary] | None:
    """Return the mesh of a figure: of the size in the thesis, or the largest that was measured."""
    found = [result for result in results if result.experiment.mesh == figure.mesh]
    if figure.shows != "section":
        mesh = found[0].experiment.build(quick=False) if found else None
        return None if mesh is None else (mesh, summarise(mesh))
    states = []
    for result in found:
        row = result.rows.get(figure.column) if result.experiment.start == INITIAL else None
        if figure.column == INITIAL:
            states.append((result.mesh, result.initial))
        elif row is not None and row.mesh is not None:
            states.append((row.mesh, row.after))
    return max(states, key=lambda state: state[1].hexes, default=None)


def _drawer() -> Draw | None:
    for entry in entry_points(group="hexmend.figures"):
        try:
            return entry.load()
        except ImportError:  # the libraries of the viewer are not installed
            continue
    return None


def _caption(figure: MeshFigure, summary: Summary) -> str:
    inverted = f"{summary.inverted:,}" if summary.inverted else "none"
    state = f", q min {summary.q_min:.4f}, {inverted} inverted" if figure.shows == "section" else ""
    by = "" if figure.column in (INITIAL, "getme") else f" ({figure.column})"
    return f"{figure.caption}{by}: ours, {summary.hexes:,} hexes{state}"
