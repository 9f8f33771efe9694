"""Drawing of a figure set."""

from __future__ import annotations

from collections.abc import Generator, Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

from hexmend.mesh.mesh import Mesh
from hexmend.quality import measure, summarise
from hexmend.report.documents import output_folder
from hexmend.run.recipe import Recipe
from hexmend.run.recipe_files import write_recipe
from hexmend.study.table_row import Row
from hexmend_app.picture import Scene, write_scene
from hexmend_app.report.case import Case, Version, command_line
from hexmend_app.report.charts import check_matplotlib
from hexmend_app.report.figure_captions import write_captions
from hexmend_app.report.figure_set import Figure, Style, write_figures
from hexmend_app.state.mesh.run_record import RunRecord

#: File formats of each figure.
_FORMATS = ("png", "pdf", "svg")

#: Version of the mesh: name and mesh; name and row of a comparison; or name, run, iteration and mesh.
NamedVersion = tuple[str, Mesh] | tuple[str, Row] | tuple[str, RunRecord, int, Mesh]


def prepare(folder: Path, scene: Scene, recipes: Mapping[str, Recipe]) -> None:
    """Create the folder with the scene and the recipes.

    Raises
    ------
    HexmendError
        If Matplotlib is missing or a file cannot be written.
    """
    check_matplotlib()
    output_folder(folder)
    write_scene(folder / "scene.toml", scene)
    for name, recipe in recipes.items():
        write_recipe(folder / name, recipe)


def draw(
    folder: Path,
    title: str,
    mesh: str,
    scene: Scene,
    versions: Sequence[NamedVersion],
    recipes: Mapping[str, Recipe],
    file: Path | None,
) -> Generator[Figure]:
    """Write and yield figure by figure, then write captions and commands.

    Parameters
    ----------
    folder : Path
        Has been prepared.
    title : str
        Title above the captions.
    mesh : str
        Name of the mesh in the captions.
    scene : Scene
        Camera, cut and colours.
    versions : sequence of NamedVersion
        Meshes to compare, the mesh as opened first.
    recipes : mapping of str to Recipe
        Recipes that make them from the first mesh, by file name.
    file : Path or None
        File of the mesh, for the commands that reproduce the figures.
    """
    figures = []
    case = Case(mesh, None, tuple(map(version_of, versions)))
    for figure in write_figures(case, folder, Style(scene, formats=_FORMATS)):
        figures.append(figure)
        yield figure
    methods = ",".join(str(folder / name) for name in recipes) or "none"
    arguments = [
        "figures",
        "MESH" if file is None else str(file),
        "--methods",
        methods,
        "--scene",
        str(folder / "scene.toml"),
    ]
    arguments += ["--format", ",".join(_FORMATS), "-o", str(folder), "--only"]
    write_captions(folder, title, [(figure, command_line([*arguments, figure.part])) for figure in figures])


def version_of(named: tuple[Any, ...]) -> Version:
    """Return the version of a mesh with its measurements, and those of its run."""
    name, source, *iteration = named
    if isinstance(source, Mesh):
        return Version.of(name, source)
    if isinstance(source, Row):
        return Version.of(name, source.mesh, source)
    number, mesh = iteration
    version = Version.of(name, mesh, _row(source, number, mesh))
    return replace(version, history=source.rows[: number + 1], advice=source.advice)


def _row(record: RunRecord, number: int, mesh: Mesh) -> Row:
    """Return an iteration of a run as a row of a comparison."""
    seconds = float(record.rows[number]["seconds"])
    outcome = "" if number == record.result else "stopped"
    summary = summarise(mesh, measure(mesh.points, mesh.hexes, mesh.mid_nodes))
    work = record.work
    parameters = {} if work is None or isinstance(work, Recipe) else work.values()
    return Row(record.title, parameters, outcome, record.message, mesh, summary, number, seconds)
