"""The figures of `hexmend study` that show meshes; joined through the entry-point group `hexmend.figures`."""

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
from hexmend.study.thesis.mesh_figures import MeshFigure
from hexmend_app.scene.camera.pose import Pose
from hexmend_app.scene.export.layout import Layout
from hexmend_app.scene.export.rasters import aim
from hexmend_app.scene.export.sheet import draw_sheet, format_of
from hexmend_app.scene.export.subject import Subject
from hexmend_app.scene.export.tally import tally
from hexmend_app.scene.graphics import prepare_off_screen
from hexmend_app.state.clip import PlaneClip
from hexmend_app.state.look import Isolation, Look, Structure
from hexmend_app.state.scene import Camera, Page, Place, Scene
from hexmend_app.state.stand import Stand

#: Width and height in pixels.
SIZE = (900, 600)

#: How often the colour bar counts when 256 colours are chosen.
_BAR = 30

#: How much of the mesh around what lies in its middle a section shows, by the extent of that.
_AROUND = 0.35

#: How far the plane of a section is beside the middle, where elements have their centres, by the same extent.
_ASIDE = -0.02

#: Thickness to which the layer on what lies in the middle of a domain is pressed, so that what is seen is the surface.
_PRESSED = 0.01


@dataclass(frozen=True, eq=False)
class _Shown:
    """What is drawn, how, and the places (k, 3) that the picture is to hold."""

    mesh: Mesh
    look: Look
    places: np.ndarray


def draw(figure: MeshFigure, mesh: Mesh, path: Path) -> None:
    """Draw a figure of the thesis, off screen, as the path's suffix says; a PNG has few colours.

    Raises
    ------
    GraphicsError
        Where nothing can be drawn here.
    FileError
        Where the file cannot be written.
    """
    prepare_off_screen()
    shown = _SHOWN[figure.shows](mesh)
    subject, page = Subject.of(shown.mesh), Page(pixels=SIZE)
    layout = Layout.of(Scene.of(shown.look, page=page), [subject])
    bar = 0 if layout.bar is Place.NONE else layout.strip
    camera = vtkCamera()
    aim(camera, Camera(figure.view, up=figure.up), shown.places, layout.panel[0] / layout.panel[1])
    pose = Pose.of(camera)
    stand = Stand(pose.position, pose.focal, pose.up, pose.parallel, pose.scale, figure.up)
    sheet = draw_sheet(Scene.of(shown.look, stand, page=page), [subject])
    if format_of(path) != "PNG":
        sheet.write(path)
        return
    with atomic_write(path) as temporary:
        _with_palette(sheet.image(), bar).save(temporary, format="PNG")


def _with_palette(image: Image.Image, bar: int) -> Image.Image:
    """The picture in 256 colours, which make it a third as large; small areas, and the bar so high, count for more."""
    pixels = np.asarray(image)
    seen = np.concatenate([pixels.reshape(-1, 3), np.tile(pixels[image.height - bar :].reshape(-1, 3), (_BAR, 1))])
    colours, counts = tally(seen)
    palette = Image.fromarray(np.repeat(colours, np.sqrt(counts).astype(int), axis=0)[None]).quantize(256, kmeans=3)
    return image.quantize(palette=palette, dither=Image.Dither.NONE)


def _geometry(mesh: Mesh) -> _Shown:
    return _Shown(mesh, Look(neutral=True, edges=False, structure=Structure(sharp=True)), mesh.points)


def _mesh(mesh: Mesh) -> _Shown:
    return _Shown(mesh, Look(neutral=True), mesh.points)


def _domain(mesh: Mesh) -> _Shown:
    """What lies in the middle, in the outline of the whole."""
    surface = _inside(mesh)
    layer = np.flatnonzero(surface[mesh.hexes].sum(axis=1) >= 4)
    ends = mesh.hexes[layer][:, EDGES].reshape(-1, 2)
    ends = np.concatenate([ends, ends[:, ::-1]])
    below, above = ends[surface[ends[:, 0]] & ~surface[ends[:, 1]]].T
    points = mesh.points.copy()
    points[above] = points[below] + _PRESSED * (points[above] - points[below])
    isolation = Isolation(tuple(layer.tolist()), rings=0)
    return _Shown(mesh.with_points(points), Look(isolation=isolation, neutral=True, edges=False), mesh.points)


def _section(mesh: Mesh) -> _Shown:
    """The half behind the middle plane y of what lies inside, around that."""
    points = mesh.points[_inside(mesh)]
    low, high = points.min(axis=0), points.max(axis=0)
    clip = PlaneClip.at((0.0, -1.0, 0.0), tuple((low + high) / 2 + _ASIDE * (high - low)))
    around = _AROUND * (high - low).max()
    places = np.array([(x, (low + high)[1] / 2, z) for x in (low[0] - around, high[0] + around)
                       for z in (low[2] - around, high[2] + around)])  # fmt: skip
    return _Shown(mesh, Look(clip=clip), places)


def _inside(mesh: Mesh) -> np.ndarray:
    """The nodes (n,) bool of boundary faces that are not on the mesh's box."""
    used = mesh.points[mesh.topology.used]
    ends = np.stack([used.min(axis=0), used.max(axis=0)])
    on_box = np.isclose(mesh.points[:, None], ends, atol=1e-9 * np.ptp(ends)).reshape(-1, 6)
    faces = mesh.topology.boundary_faces
    nodes = np.zeros(mesh.n_nodes, dtype=bool)
    nodes[faces[~on_box[faces].all(axis=1).any(axis=1)]] = True
    return nodes


_SHOWN: dict[str, Callable[[Mesh], _Shown]] = {
    "geometry": _geometry,
    "mesh": _mesh,
    "domain": _domain,
    "section": _section,
}
