"""Pictures of the meshes of Chapter 4."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from PIL import Image
from vtkmodules.vtkRenderingCore import vtkCamera

from hexmend.io.storage.atomic import atomic_write
from hexmend.mesh.hexahedron import EDGES
from hexmend.mesh.mesh import Mesh
from hexmend_app.picture import Camera, Colours, Cut, Isolate, LineStyle, Page, Scene, Show, TextPlace
from hexmend_app.picture.appearance import Look, Structure
from hexmend_app.scene.camera.vtk_pose import pose_of
from hexmend_app.scene.page.layout import Layout
from hexmend_app.scene.page.page_mesh import PageMesh
from hexmend_app.scene.page.page_renderer import draw_page
from hexmend_app.scene.page.rasters import aim
from hexmend_app.scene.render.colour_count import count_colours
from hexmend_app.scene.render.graphics import prepare_off_screen

#: Colours and lines of figures that show the shape of the mesh alone.
_NEUTRAL, _NO_EDGES = Colours(neutral=True), LineStyle(edges=0.0)

#: Width and height in pixels.
SIZE = (900, 600)

#: Weight of the colour bar in the selection of 256 colours.
_BAR = 30

#: Margin of a section around the inner boundary, relative to the boundary's extent.
_AROUND = 0.35

#: Offset of a section's plane from the middle, which contains hex centres, relative to the same extent.
_ASIDE = -0.02

#: Factor that flattens the layer of hexes on the inner boundary, so that the picture shows the surface.
_PRESSED = 0.01


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


@dataclass(frozen=True, eq=False)
class _Subject:
    """Mesh of a figure, its look, and points (k, 3) that the picture must contain."""

    mesh: Mesh
    look: Look
    places: np.ndarray


def draw(figure: MeshFigure, mesh: Mesh, path: Path) -> None:
    """Draw a figure of the thesis off screen as PNG with 256 colours.

    Raises
    ------
    GraphicsError
        If OpenGL is not available.
    FileError
        If the file cannot be written.
    """
    prepare_off_screen()
    subject = _SUBJECTS[figure.shows](mesh)
    page_mesh, page = PageMesh.of(subject.mesh), Page(pixels=SIZE)
    layout = Layout.of(Scene.of(subject.look, page=page), [page_mesh])
    bar = 0 if layout.bar is TextPlace.NONE else layout.strip
    camera = vtkCamera()
    aim(camera, Camera(figure.view, up=figure.up), subject.places, layout.panel[0] / layout.panel[1])
    renderer = draw_page(Scene.of(subject.look, pose_of(camera, figure.up), page=page), [page_mesh])
    with atomic_write(path) as temporary:
        _with_palette(renderer.image(), bar).save(temporary, format="PNG")


def _with_palette(image: Image.Image, bar: int) -> Image.Image:
    """Reduce a picture to 256 colours; small areas and the colour bar of height `bar` in pixels have more weight."""
    pixels = np.asarray(image)
    weighted = np.concatenate([pixels.reshape(-1, 3), np.tile(pixels[image.height - bar :].reshape(-1, 3), (_BAR, 1))])
    colours, counts = count_colours(weighted)
    palette = Image.fromarray(np.repeat(colours, np.sqrt(counts).astype(int), axis=0)[None]).quantize(256, kmeans=3)
    return image.quantize(palette=palette, dither=Image.Dither.NONE)


def _geometry(mesh: Mesh) -> _Subject:
    return _Subject(mesh, Look(colours=_NEUTRAL, lines=_NO_EDGES, structure=Structure.of("sharp")), mesh.points)


def _mesh(mesh: Mesh) -> _Subject:
    return _Subject(mesh, Look(colours=_NEUTRAL), mesh.points)


def _domain(mesh: Mesh) -> _Subject:
    """Show the inner boundary within the outline of the mesh."""
    surface = _inside(mesh)
    layer = np.flatnonzero(surface[mesh.hexes].sum(axis=1) >= 4)
    ends = mesh.hexes[layer][:, EDGES].reshape(-1, 2)
    ends = np.concatenate([ends, ends[:, ::-1]])
    below, above = ends[surface[ends[:, 0]] & ~surface[ends[:, 1]]].T
    points = mesh.points.copy()
    points[above] = points[below] + _PRESSED * (points[above] - points[below])
    show = Show(isolate=Isolate(tuple(layer.tolist()), rings=0))
    return _Subject(mesh.with_points(points), Look(show=show, colours=_NEUTRAL, lines=_NO_EDGES), mesh.points)


def _section(mesh: Mesh) -> _Subject:
    """Show the half behind the middle y plane of the inner boundary, and the mesh around it."""
    points = mesh.points[_inside(mesh)]
    low, high = points.min(axis=0), points.max(axis=0)
    cut = Cut.at((0.0, -1.0, 0.0), tuple((low + high) / 2 + _ASIDE * (high - low)))
    around = _AROUND * (high - low).max()
    places = np.array([(x, (low + high)[1] / 2, z) for x in (low[0] - around, high[0] + around)
                       for z in (low[2] - around, high[2] + around)])  # fmt: skip
    return _Subject(mesh, Look(cut=cut), places)


def _inside(mesh: Mesh) -> np.ndarray:
    """Return a mask (n,) of the nodes of boundary faces that are not on the bounding box."""
    used = mesh.points[mesh.topology.used]
    ends = np.stack([used.min(axis=0), used.max(axis=0)])
    on_box = np.isclose(mesh.points[:, None], ends, atol=1e-9 * np.ptp(ends)).reshape(-1, 6)
    faces = mesh.topology.boundary_faces
    nodes = np.zeros(mesh.n_nodes, dtype=bool)
    nodes[faces[~on_box[faces].all(axis=1).any(axis=1)]] = True
    return nodes


_SUBJECTS: dict[str, Callable[[Mesh], _Subject]] = {
    "geometry": _geometry,
    "mesh": _mesh,
    "domain": _domain,
    "section": _section,
}
