"""A window's figure set, figure by figure: the same from a script as from the window."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from pathlib import Path

from hexmend.mesh.mesh import Mesh
from hexmend.quality import measure, summarise
from hexmend.report import output_folder
from hexmend.report.charts import check_matplotlib
from hexmend.run.recipe import Recipe
from hexmend.run.recipe_files import write_recipe
from hexmend.study.table_row import Row
from hexmend_app.picture import Scene, write_scene
from hexmend_app.report.case import Case, Version, command_line
from hexmend_app.report.figure_captions import write_captions
from hexmend_app.report.figure_set import Figure, Style, write_figures
from hexmend_app.scene.render.graphics import prepare_off_screen
from hexmend_app.state.mesh.run_record import RunRecord

#: Kinds of file that every figure is written as.
_FORMATS = ("png", "pdf", "svg")

#: A version of the mesh: its name, and the mesh, what a comparison knows of it, or an iteration of a run.
Shown = tuple[str, Mesh] | tuple[str, Row] | tuple[str, RunRecord, int, Mesh]


def write_set(
    folder: str | Path,
    title: str,
    mesh: str,
    scene: Scene,
    shown: Sequence[Shown],
    recipes: Mapping[str, Recipe],
    file: str = "MESH",
) -> None:
    """Write a figure set, off screen.

    Parameters
    ----------
    folder : path-like
        Created if missing.
    title : str
        Title above the captions.
    mesh : str
        Name of the mesh in the captions.
    scene : Scene
        Camera, cut and colours.
    shown : sequence
        What is compared, the mesh as it was opened first: (name, Mesh), (name, Row) of a comparison, or (name, Record,
        number, Mesh) of an iteration of a run.
    recipes : mapping
        What makes these from the first, by the names of the files that they go to.
    file : str
        Name of the mesh file in the commands that draw a figure again.

    Raises
    ------
    HexmendError
        If drawing off screen is impossible or a file cannot be written.
    """
    prepare_off_screen()
    prepare(Path(folder), scene, recipes)
    for _ in draw(folder, title, mesh, scene, shown, recipes, file):
        pass


def prepare(folder: Path, scene: Scene, recipes: Mapping[str, Recipe]) -> None:
    """Make the folder, with what the commands of the set read; raises as `write_set`."""
    check_matplotlib()
    output_folder(folder)
    write_scene(folder / "scene.toml", scene)
    for name, recipe in recipes.items():
        write_recipe(folder / name, recipe)


def draw(
    folder: str | Path,
    title: str,
    mesh: str,
    scene: Scene,
    shown: Sequence[Shown],
    recipes: Mapping[str, Recipe],
    file: str = "MESH",
) -> Iterator[Figure]:
    """Write the figures one by one, as they are asked for, and captions and commands last; see `write_set`."""
    folder, done = Path(folder), []
    for figure in write_figures(case(mesh, shown), folder, Style(scene, formats=_FORMATS)):
        done.append(figure)
        yield figure
    methods = ",".join(str(folder / name) for name in recipes) or "none"
    again = ["figures", file, "--methods", methods, "--scene", str(folder / "scene.toml")]
    again += ["--format", ",".join(_FORMATS), "-o", str(folder), "--only"]
    write_captions(folder, title, [(one, command_line([*again, one.part])) for one in done])


def case(mesh: str, shown: Sequence[Shown]) -> Case:
    """Return the case that a figure set describes."""
    return Case(mesh, None, tuple(map(_version, shown)))


def _version(one: Shown) -> Version:
    name, subject, *moment = one
    if isinstance(subject, Mesh):
        return Version.of(name, subject)
    if isinstance(subject, Row):
        return Version.of(name, subject.mesh, subject)
    number, mesh = moment
    rows = subject.rows[: number + 1]
    version = Version.of(name, mesh, _row(subject, number, mesh))
    return replace(version, history=rows, advice=subject.advice)


def _row(record: RunRecord, number: int, mesh: Mesh) -> Row:
    """Return an iteration of a run as a row of a comparison."""
    seconds = float(record.rows[number]["seconds"])
    ended = "" if number == record.result else "stopped"
    summary = summarise(mesh, measure(mesh.points, mesh.hexes))
    return Row(record.title, {}, ended, record.message, mesh, summary, number, seconds)
