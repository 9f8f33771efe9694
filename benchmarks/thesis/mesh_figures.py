"""Figures of meshes in Chapter 4 of the thesis."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

from benchmarks.thesis.drawing import MeshFigure, draw
from benchmarks.thesis.experiment_result import ExperimentResult
from benchmarks.thesis.experiments import INITIAL
from hexmend.mesh.mesh import Mesh
from hexmend.quality import Summary, summarise

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


def draw_figures(folder: Path, results: Sequence[ExperimentResult]) -> list[dict[str, Any]]:
    """Draw the figures of measured experiments as PNG.

    Parameters
    ----------
    folder : Path
        Folder of the files.
    results : sequence of ExperimentResult

    Returns
    -------
    list of dict
        Number, caption and file of each figure.
    """
    drawn = []
    for figure in MESH_FIGURES:
        state = _state(figure, results)
        if state is not None:
            mesh, summary = state
            file = f"figure-{figure.number}-{figure.stem}.png"
            draw(figure, mesh, folder / file)
            drawn.append({"number": figure.number, "caption": _caption(figure, summary), "file": file})
    return drawn


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


def _caption(figure: MeshFigure, summary: Summary) -> str:
    inverted = f"{summary.inverted:,}" if summary.inverted else "none"
    state = f", q min {summary.q_min:.4f}, {inverted} inverted" if figure.shows == "section" else ""
    by = "" if figure.column in (INITIAL, "getme") else f" ({figure.column})"
    return f"{figure.caption}{by}: ours, {summary.hexes:,} hexes{state}"
