"""The figure set of a mesh: before and after with one camera and cut, distributions, convergence, the table."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from math import ceil, sqrt
from pathlib import Path

from hexmend.boundary.displacement import DISPLACEMENT_QUANTITIES
from hexmend.errors import ParameterError
from hexmend.report import comparison_rows, comparison_table, write_documents
from hexmend.report.run_figures import write_convergence, write_distributions
from hexmend.report.tables import Table
from hexmend_app.report.case import Case
from hexmend_app.report.wording import coloured_by, cut_open, listed, opposite, seen_from
from hexmend_app.scene.export.sheet import draw_sheet
from hexmend_app.scene.export.subject import Subject
from hexmend_app.state.look import Traces
from hexmend_app.state.scene import Colours, Cut, Panel, Place, Plane, Scene

#: Panels in one row at most, the height of one by its width, and of what stands around them, in mm.
_IN_A_ROW, _PANEL, _AROUND = 3, 0.9, (5.0, 10.0)


@dataclass(frozen=True)
class Style:
    """How figures of a set are drawn.

    Parameters
    ----------
    scene : Scene
        Camera, cut and colours of the meshes.
    width : float
        Of a figure, in mm.
    formats : tuple of str
        Suffixes without the dot: png, pdf, svg.
    """

    scene: Scene
    width: float = 170.0
    formats: tuple[str, ...] = ("png",)


@dataclass(frozen=True)
class Figure:
    """A figure that was written.

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
    """Write the figures one by one, as they are asked for.

    Parameters
    ----------
    case : Case
    folder : Path
    style : Style
    parts : sequence of str
        Of `PARTS`; all where none is named. What there is nothing of is left out.

    Raises
    ------
    HexmendError
        Where nothing can be drawn here, or a file cannot be written.
    """
    for part in parts or PARTS:
        figure = PARTS[part](case, folder, style)
        if figure is not None:
            yield figure


def write_behind(case: Case, folder: Path, style: Style) -> Figure:
    """Write what `surface` does not show: the meshes from the opposite side; parameters as of `write_figures`."""
    scene = replace(style.scene, cut=Cut(), camera=opposite(style.scene.camera))
    return _sheet(case, folder, style, "behind", scene, "whole, seen from the opposite side")


def check_pages(style: Style, versions: int, parts: Sequence[str] = ()) -> None:
    """Find out before the work whether pictures of so many versions have pages that can be drawn.

    Parameters
    ----------
    style : Style
    versions : int
        The mesh as it was given, and what methods are to make of it.
    parts : sequence of str
        Of `PARTS`; all where none is named.

    Raises
    ------
    ParameterError
        Where a page has too many pixels, or too few.
    """
    if not parts or {"surface", "cut"} & set(parts):
        try:
            _paged(style, style.scene, [Panel(mesh=number) for number in range(1, versions + 1)])
        except ParameterError as error:
            problem = f"{versions} picture{'s' * (versions > 1)} on a page {style.width:g} mm wide: {error}"
            raise ParameterError(f"{problem}; choose another width, or other dpi in the scene") from None


def _paged(style: Style, scene: Scene, panels: Sequence[Panel]) -> Scene:
    """A scene with its panels on a page of their own, in which they have the shape of the scene's where it stands."""
    scene, count = stationary(scene), len(panels)
    columns = count if count <= _IN_A_ROW else ceil(sqrt(count))
    caption, bar = _AROUND
    wide, tall = scene.page.size
    shape = _PANEL if scene.camera.stand is None else tall / wide
    high = -(-count // columns) * (style.width / columns * shape + caption) + bar
    page = replace(scene.page, width=style.width, height=high, pixels=None, columns=columns)
    bar_of = replace(scene.bar, place=Place.BELOW) if scene.bar.place is Place.RIGHT else scene.bar
    return replace(scene, page=page, panels=tuple(panels), bar=bar_of)


def stationary(scene: Scene) -> Scene:
    """A scene without what needs a mesh that has moved, and without panels: those of a set are its meshes."""
    moved = scene.colours.metric in DISPLACEMENT_QUANTITIES
    return replace(
        scene,
        colours=Colours() if moved else scene.colours,
        movement=Traces(),
        structure=replace(scene.structure, original=False, kinds=False),
        panels=(),
    )


def table_of(case: Case) -> Table:
    """The thesis's table of methods."""
    summary = case.initial.summary
    columns = {one.name: one.record(case.power) for one in case.versions}
    columns |= {row.method: row.record(case.power) for row in case.failed}
    title = f"{case.name}: {summary.hexes:,} hexes, {summary.free_nodes:,} free nodes"
    return comparison_table(title, columns)


def _surface(case: Case, folder: Path, style: Style) -> Figure:
    scene = replace(style.scene, cut=Cut())
    return _sheet(case, folder, style, "surface", scene, f"whole, {seen_from(scene.camera)}")


def _cut(case: Case, folder: Path, style: Style) -> Figure:
    scene = style.scene
    if not scene.cut.planes and scene.cut.box is None:
        scene = replace(scene, cut=Cut((Plane(position=0.5),)))
    how = f"{cut_open(scene.cut)}, {seen_from(scene.camera)}"
    return _sheet(case, folder, style, "cut", scene, how)


def _sheet(case: Case, folder: Path, style: Style, part: str, scene: Scene, how: str) -> Figure:
    """One panel a version, with one camera; where that stands exactly, panels have the shape of the scene's page."""
    panels = [Panel(mesh=k, caption=one.name) for k, one in enumerate(case.versions, 1)]
    subjects = [Subject(one.name, one.mesh, one.figures) for one in case.versions]
    sheet = draw_sheet(_paged(style, scene, panels), subjects)
    paths = [folder / f"{part}.{suffix}" for suffix in style.formats]
    for path in paths:
        sheet.write(path)
    inverted = any(one.figures.n_inverted for one in case.versions)
    said = f"{case.name}, {listed([one.name for one in case.versions])}: {how}. {coloured_by(scene.colours, inverted)}"
    return Figure(part, said, tuple(paths))


def _distributions(case: Case, folder: Path, style: Style) -> Figure:
    counts = {one.name: one.record()["distribution"] for one in case.versions}
    paths = tuple(folder / f"distributions.{suffix}" for suffix in style.formats)
    for path in paths:
        write_distributions(path, counts, title=case.name, width_mm=style.width)
    return Figure(
        "distributions", f"Numbers of hexes of {case.name} by their quality q(H): {listed([*counts])}.", paths
    )


def _convergence(case: Case, folder: Path, style: Style) -> Figure | None:
    histories = {one.name: one.history for one in case.versions if one.history}
    if not histories:
        return None
    paths = tuple(folder / f"convergence.{suffix}" for suffix in style.formats)
    for path in paths:
        write_convergence(path, histories, title=case.name, width_mm=style.width)
    return Figure("convergence", f"How {listed([*histories])} went on {case.name}, by iteration.", paths)


def _table(case: Case, folder: Path, style: Style) -> Figure:
    record = {
        "mesh": case.name,
        "stop": case.stop.values(),
        "interrupted": case.interrupted,
        "initial": case.initial.record(case.power),
        "rows": [one.record(case.power) | {"name": one.name} for one in case.versions[1:]]
        + [row.record(case.power) for row in case.failed],
    }
    table = table_of(case)
    paths = write_documents(folder, "table", table, comparison_rows(record), record)
    return Figure("table", f"{table.title}.", tuple(paths))


#: The figures of a set, in order, and who writes them.
PARTS: dict[str, Callable[[Case, Path, Style], Figure | None]] = {
    "surface": _surface,
    "cut": _cut,
    "distributions": _distributions,
    "convergence": _convergence,
    "table": _table,
}
