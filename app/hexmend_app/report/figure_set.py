"""Figure set of a mesh: pictures before and after with one camera and cut, distributions, convergence and table."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from math import ceil, sqrt
from pathlib import Path

from hexmend.errors import ParameterError
from hexmend.report.comparison import comparison_rows, comparison_table
from hexmend.report.documents import write_documents
from hexmend.report.tables import Table
from hexmend_app.picture import Colours, Cut, PicturePanel, Plane, Scene, TextPlace
from hexmend_app.picture.appearance import Traces
from hexmend_app.picture.displacement import DISPLACEMENT_QUANTITIES
from hexmend_app.report.caption_phrases import coloured_by, cut_open, listed, opposite, seen_from
from hexmend_app.report.case import Case, Version
from hexmend_app.report.run_figures import write_convergence, write_distributions
from hexmend_app.scene.page.page_mesh import PageMesh
from hexmend_app.scene.page.page_renderer import PageRenderer, draw_page

#: Maximum number of panels in a row, height relative to width of a panel, and heights of caption and bar in mm.
_IN_A_ROW, _PANEL, _AROUND = 3, 0.9, (5.0, 10.0)


@dataclass(frozen=True)
class Style:
    """Style of a figure set.

    Parameters
    ----------
    scene : Scene
        Camera, cut and colours of the meshes.
    width : float
        Width of a figure in mm.
    formats : tuple of str
        Suffixes without the dot: png, pdf, svg.
    """

    scene: Scene
    width: float = 170.0
    formats: tuple[str, ...] = ("png",)


@dataclass(frozen=True)
class Figure:
    """Figure that has been written.

    Parameters
    ----------
    part : str
        One of `PARTS`.
    caption : str
        A sentence.
    paths : tuple of Path
    """

    part: str
    caption: str
    paths: tuple[Path, ...]


def write_figures(case: Case, folder: Path, style: Style, parts: Sequence[str] = ()) -> Iterator[Figure]:
    """Write the figures and yield each of them.

    Parameters
    ----------
    case : Case
    folder : Path
    style : Style
    parts : sequence of str
        Names in `PARTS`; by default all. A part without data is omitted.

    Raises
    ------
    HexmendError
        If OpenGL is not available, or a file cannot be written.
    """
    for part in parts or PARTS:
        figure = PARTS[part](case, folder, style)
        if figure is not None:
            yield figure


def check_pages(style: Style, versions: int, parts: Sequence[str] = ()) -> None:
    """Check that the pages of the pictures can be drawn, before any method runs.

    Parameters
    ----------
    style : Style
    versions : int
        Number of meshes: the original mesh and the results.
    parts : sequence of str
        Names in `PARTS`; by default all.

    Raises
    ------
    ParameterError
        If a page has too many or too few pixels.
    """
    if not parts or {"surface", "behind", "cut"} & set(parts):
        try:
            figure_scene(style, style.scene, [""] * versions)
        except ParameterError as error:
            problem = f"{versions} picture{'s' * (versions > 1)} on a page {style.width:g} mm wide: {error}"
            raise ParameterError(f"{problem}; change the width, or the dpi in the scene") from None


def figure_scene(style: Style, scene: Scene, names: Sequence[str]) -> Scene:
    """Return a scene with a panel for each named mesh; with an exact camera, panels have the aspect of its page."""
    scene, count = stationary(scene), len(names)
    columns = count if count <= _IN_A_ROW else ceil(sqrt(count))
    caption, bar = _AROUND
    width, height = scene.page.size
    aspect = _PANEL if scene.camera.pose is None else height / width
    page_height = -(-count // columns) * (style.width / columns * aspect + caption) + bar
    page = replace(scene.page, width=style.width, height=page_height, pixels=None, columns=columns)
    bar_style = replace(scene.bar, place=TextPlace.BELOW) if scene.bar.place is TextPlace.RIGHT else scene.bar
    panels = tuple(PicturePanel(mesh=number, caption=name) for number, name in enumerate(names, 1))
    return replace(scene, page=page, panels=panels, bar=bar_style)


def draw_versions(scene: Scene, versions: Sequence[Version]) -> PageRenderer:
    """Draw a scene with a panel for each version."""
    return draw_page(scene, [PageMesh(version.mesh, version.figures, name=version.name) for version in versions])


def stationary(scene: Scene) -> Scene:
    """Return a scene without displacements and panels; a figure set has one panel for each mesh."""
    moved = scene.colours.metric in DISPLACEMENT_QUANTITIES
    return replace(
        scene,
        colours=Colours() if moved else scene.colours,
        movement=Traces(),
        structure=scene.structure.without("original", "kinds"),
        panels=(),
    )


def table_of(case: Case) -> Table:
    """Return the table of methods as in the thesis."""
    summary = case.initial.summary
    columns = {version.name: version.record(case.norm) for version in case.versions}
    columns |= {row.method: row.record(case.norm) for row in case.failed}
    title = f"{case.name}: {summary.hexes:,} hexes, {summary.free_nodes:,} free nodes"
    return comparison_table(title, columns)


def _surface(case: Case, folder: Path, style: Style) -> Figure:
    scene = replace(style.scene, cut=Cut())
    return _mesh_figure(case, folder, style, "surface", scene, f"whole, {seen_from(scene.camera)}")


def _behind(case: Case, folder: Path, style: Style) -> Figure:
    scene = replace(style.scene, cut=Cut(), camera=opposite(style.scene.camera))
    return _mesh_figure(case, folder, style, "behind", scene, "whole, seen from the opposite side")


def _cut(case: Case, folder: Path, style: Style) -> Figure:
    scene = style.scene
    if not scene.cut.active:
        scene = replace(scene, cut=Cut((Plane(position=0.5),)))
    options = f"{cut_open(scene.cut)}, {seen_from(scene.camera)}"
    return _mesh_figure(case, folder, style, "cut", scene, options)


def _mesh_figure(case: Case, folder: Path, style: Style, part: str, scene: Scene, description: str) -> Figure:
    """Draw one panel for each version with the same camera."""
    versions = case.versions
    names = [version.name for version in versions]
    renderer = draw_versions(figure_scene(style, scene, names), versions)
    paths = [folder / f"{part}.{suffix}" for suffix in style.formats]
    for path in paths:
        renderer.write(path)
    invalid = any(version.figures.n_invalid for version in versions)
    text = f"{case.name}, {listed(names)}: {description}. {coloured_by(scene.colours, invalid)}"
    return Figure(part, text, tuple(paths))


def _distributions(case: Case, folder: Path, style: Style) -> Figure:
    counts = {version.name: version.record()["distribution"] for version in case.versions}
    paths = tuple(folder / f"distributions.{suffix}" for suffix in style.formats)
    for path in paths:
        write_distributions(path, counts, title=case.name, width_mm=style.width)
    return Figure("distributions", f"Number of hexes of {case.name} by quality q(H): {listed([*counts])}.", paths)


def _convergence(case: Case, folder: Path, style: Style) -> Figure | None:
    histories = {version.name: version.history for version in case.versions if version.history}
    if not histories:
        return None
    paths = tuple(folder / f"convergence.{suffix}" for suffix in style.formats)
    for path in paths:
        write_convergence(path, histories, title=case.name, width_mm=style.width)
    return Figure("convergence", f"Convergence of {listed([*histories])} on {case.name}.", paths)


def _table(case: Case, folder: Path, style: Style) -> Figure:
    record = {
        "mesh": case.name,
        "stop": None if case.stop is None else case.stop.values(),
        "interrupted": case.interrupted,
        "initial": case.initial.record(case.norm),
        "rows": [version.record(case.norm) | {"name": version.name} for version in case.versions[1:]]
        + [row.record(case.norm) for row in case.failed],
    }
    table = table_of(case)
    paths = write_documents(folder, "table", table, comparison_rows(record), record)
    return Figure("table", f"{table.title}.", tuple(paths))


#: Figures of a set in order, and the functions that write them.
PARTS: dict[str, Callable[[Case, Path, Style], Figure | None]] = {
    "surface": _surface,
    "behind": _behind,
    "cut": _cut,
    "distributions": _distributions,
    "convergence": _convergence,
    "table": _table,
}
