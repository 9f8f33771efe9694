"""Figure set of a mesh: pictures before and after with one camera and cut, distributions, convergence and table."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from math import ceil, sqrt
from pathlib import Path

from hexmend.errors import ParameterError
from hexmend.mesh.solid_cells import count_cells
from hexmend.report.comparison import comparison_rows, comparison_table
from hexmend.report.documents import write_documents
from hexmend.report.tables import Table
from hexmend_app.picture import Camera, Colours, Cut, PicturePanel, Plane, Scene, TextPlace
from hexmend_app.picture.appearance import Traces
from hexmend_app.picture.camera import Vector
from hexmend_app.picture.colours import colour_quantity
from hexmend_app.picture.cut import CutStyle
from hexmend_app.picture.displacement import DISPLACEMENT_QUANTITIES
from hexmend_app.report.case import Case, Version
from hexmend_app.report.run_figures import write_convergence, write_distributions
from hexmend_app.scene.camera.directions import direction_of
from hexmend_app.scene.page.page_mesh import PageMesh
from hexmend_app.scene.page.page_renderer import PageRenderer, draw_page

#: Maximum number of panels in a row, height relative to width of a panel, and heights of caption and bar in mm.
_IN_A_ROW, _PANEL, _AROUND = 3, 0.9, (5.0, 10.0)
_AXES = "xyz"


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
    return draw_page(scene, [PageMesh(version.mesh, version.quality, name=version.name) for version in versions])


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
    title = f"{case.name}: {count_cells(case.initial.mesh.elements)}, {summary.free_nodes:,} free nodes"
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
    invalid = any(version.quality.n_invalid for version in versions)
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


def listed(names: Sequence[str]) -> str:
    """Join names with commas and "and".

    >>> listed(["initial", "laplacian", "mend"])
    'initial, laplacian and mend'
    """
    return " and ".join(filter(None, [", ".join(names[:-1]), names[-1]]))


def opposite(camera: Camera) -> Camera:
    """Return the camera on the opposite side, with the same axis up.

    >>> opposite(Camera(from_="+x")).from_
    (-1.0, -0.0, -0.0)
    """
    if camera.pose is None:
        x, y, z = direction_of(camera.direction, camera.up)
        return replace(camera, from_=(-x, -y, -z))
    x, y, z = (2 * focal - place for focal, place in zip(camera.focal, camera.position, strict=True))
    return replace(camera, position=(x, y, z))


def seen_from(camera: Camera) -> str:
    """Return the direction of view.

    >>> seen_from(Camera()), seen_from(Camera(from_="-y")), seen_from(Camera(from_=(1.0, 0.5, 0.0)))
    ('seen from a corner', 'seen from -y', 'seen from direction (1, 0.5, 0)')
    """
    if camera.pose is not None:
        return "seen as in the scene"
    if camera.direction == "iso":
        return "seen from a corner"
    return f"seen from {camera.direction if isinstance(camera.direction, str) else _named(camera.direction)}"


def cut_open(cut: Cut) -> str:
    """Return the description of a cut.

    >>> cut_open(Cut((Plane(position=0.25),)))
    'cut across x at 25 % of its extent'
    >>> cut_open(Cut((Plane((0.0, 0.0, -1.0), point=(0.0, 0.0, 2.0)), Plane()), style=CutStyle.SMOOTH))
    'cut across -z through (0, 0, 2) and across x at 50 % of its extent, through the hexes'
    >>> from hexmend_app.picture import Slab, Sphere
    >>> cut_open(Cut(slab=Slab(thickness=0.2))), cut_open(Cut(sphere=Sphere((0, 0, 1), 2), notch=True))
    ('cut by a slab across x at 50 % of its extent', 'cut by a sphere, without its inside')
    """
    if cut.slab is not None:
        place = f"by a slab {_plane(cut.slab)}"
    elif cut.planes:
        place = listed([_plane(one) for one in cut.planes])
    else:
        place = f"by a {cut.kind}" if cut.depth is None else "by the depth of hexes"
    inside = ", without its inside" if cut.notch and not cut.planes else ""
    return f"cut {place}{inside}{', through the hexes' if cut.style is CutStyle.SMOOTH else ''}"


def coloured_by(colours: Colours, invalid: bool) -> str:
    """Return a sentence about the colours, with the colours of invalid hexes if `invalid` is True.

    >>> coloured_by(Colours("scaled-jacobian"), invalid=True)
    'Coloured by Scaled Jacobian; inverted hexes are magenta, those invalid inside light magenta.'
    """
    text = "Without colours" if colours.neutral else f"Coloured by {colour_quantity(colours.metric).title}"
    return f"{text}; inverted hexes are magenta, those invalid inside light magenta." if invalid else f"{text}."


def _plane(plane: Plane) -> str:
    if plane.point is not None:
        place = f"through {_vector(plane.point)}"
    else:
        place = f"at {100 * (0.5 if plane.position is None else plane.position):.3g} % of its extent"
    return f"across {_named(plane.normal)} {place}"


def _named(direction: Vector) -> str:
    """Return an axis with its sign, or the components of a direction.

    >>> _named((0.0, -2.0, 0.0)), _named((1.0, 1.0, 0.0))
    ('-y', 'direction (1, 1, 0)')
    """
    (*along,) = (k for k, part in enumerate(direction) if part)
    if len(along) == 1:
        return f"{'-' if direction[along[0]] < 0 else ''}{_AXES[along[0]]}"
    return f"direction {_vector(direction)}"


def _vector(parts: Sequence[float]) -> str:
    return f"({', '.join(f'{part:.4g}' for part in parts)})"
