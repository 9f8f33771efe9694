"""The pictures of a page's panels, drawn off screen one after another."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from PIL import Image
from vtkmodules.vtkRenderingCore import vtkCamera

from hexmend.node_step import NodeStep
from hexmend_app.scene.camera.directions import look_from
from hexmend_app.scene.camera.eye import Eye
from hexmend_app.scene.camera.fitting import fit
from hexmend_app.scene.camera.pose import Pose
from hexmend_app.scene.colours import Colouring, declared_ends
from hexmend_app.scene.export.layout import Layout
from hexmend_app.scene.export.subject import Subject
from hexmend_app.scene.export.tiles import AT_ONCE, Tiles
from hexmend_app.scene.filters import Filters
from hexmend_app.scene.frame import Frame, same_hexes
from hexmend_app.scene.pane import Pane
from hexmend_app.scene.stage import Stage
from hexmend_app.scene.viewport import Viewport
from hexmend_app.state.look import Look
from hexmend_app.state.scene import Camera, Panel

#: What is drawn on where the paper is transparent: colours are then those of what is seen, by how much of it there is.
_NOTHING = "#000000"


@dataclass(frozen=True, eq=False)
class Rasters:
    """What was drawn.

    Parameters
    ----------
    images : list of Image
        One of each panel: RGB, or RGBA on transparent paper.
    axes : list of (3, 3) float64
        Of each panel, what the X, Y and Z axis are to who looks: to the right, up, and towards him.
    colouring : Colouring
        What the colours stand for, in all panels.
    apart : list of (name, count or None, colour)
        What has a colour of its own; the number where one mesh alone is shown.
    """

    images: list[Image.Image]
    axes: list[np.ndarray]
    colouring: Colouring
    apart: list[tuple[str, int | None, tuple[int, int, int]]]


def rasters(
    layout: Layout, *, filters: Filters | None = None, node_step: NodeStep | None = None, at_once: int = AT_ONCE
) -> Rasters:
    """Draw the panels of a page.

    Parameters
    ----------
    layout : Layout
    filters : Filters, optional
        Those of a view of the first mesh, whose elements are drawn.
    node_step : NodeStep, optional
        A node's step that is drawn in the first mesh.
    at_once : int
        Pixels that are drawn at once: larger pictures are drawn in tiles.
    """
    scene = layout.scene
    look = scene.look(layout.subjects[0].mesh)
    fine = scene.page.supersampling
    pen = scene.page.pen(scene.lines) * fine
    tiles = Tiles.of(layout.panel, fine, pen, at_once)
    with Stage(tiles.drawn) as stage:
        views = _Views(stage, layout, look, pen, filters)
        views.all[1].extras.selection.show_node_step(node_step)
        images, axes = [], []
        for panel in layout.panels:
            camera = views.camera(panel)
            image = views.picture(panel.mesh, camera, tiles)
            if panel.wipe is not None:
                edge = round(panel.wipe.at * image.width)
                image.paste(views.picture(panel.wipe.mesh, camera, tiles).crop((edge, 0, *image.size)), (edge, 0))
            images.append(image)
            axes.append(_axes(camera))
        first = views.all[1]
        numbered = len(views.shown) == 1
        shown = views.all[min(views.shown)].colours.apart
        apart = [(name, count if numbered else None, colour) for name, count, colour in shown]
        return Rasters(images, axes, first.colouring, apart)


class _Views:
    """Views of the meshes of a page, each drawn alone on one stage."""

    def __init__(self, stage: Stage, layout: Layout, look: Look, pen: float, filters: Filters | None):
        self._stage, self._layout, self._ground = stage, layout, layout.scene.page.ground
        self.shown = {panel.mesh for panel in layout.panels}
        self.shown |= {panel.wipe.mesh for panel in layout.panels if panel.wipe is not None}
        self.all: dict[int, Viewport] = {}
        self._cameras: dict[tuple[str, int], vtkCamera] = {}
        first = layout.subjects[0].frame(look)
        for number in sorted(self.shown | {1}):
            view = Viewport(Pane(stage.window), axes=False, filters=filters, pen=pen)
            view.set_dark(layout.scene.page.dark)
            view.set_ground(self._ground or _NOTHING)
            view.draw(first if number == 1 else self._beside(layout.subjects[number - 1], first))
            self.all[number] = view
            filters = self.all[1].filters
            for layer in view.layers:
                stage.window.RemoveRenderer(layer)
        self._level(look)

    def _beside(self, subject: Subject, first: Frame) -> Frame:
        """A mesh under the look of the first, with its movement; of another mesh, what the scene says of that."""
        if same_hexes(first.mesh, subject.mesh):
            return Frame(subject.mesh, subject.figures).beside(first)
        scene = self._layout.scene
        anew = replace(scene, cut=replace(scene.cut, hexes=""))  # what the cut leaves is said of the first alone
        return Frame(subject.mesh, subject.figures, look=anew.look(subject.mesh))

    def _level(self, look: Look) -> None:
        """Let a range of colours that is fitted span what is drawn in all views."""
        if declared_ends(look.scale) is None:
            lows, highs = zip(*(self.all[number].colours.ends for number in self.shown), strict=True)
            for view in self.all.values():
                view.span((min(lows), max(highs)))

    def camera(self, panel: Panel) -> vtkCamera:
        """The camera of a panel, from which all is seen that is shown of its mesh through the same camera."""
        alike = self._alike(panel.mesh)
        key = panel.camera, min(alike)
        if key not in self._cameras:
            mine = [one for one in self._layout.panels if one.camera == panel.camera]
            numbers = {one.mesh for one in mine} | {one.wipe.mesh for one in mine if one.wipe is not None}
            places = np.concatenate([self._places(number) for number in sorted(numbers & alike)])
            width, height = self._layout.panel
            camera = self._cameras[key] = vtkCamera()
            aim(camera, self._layout.scene.camera_of(panel), places, width / height)
        return self._cameras[key]

    def _places(self, number: int) -> np.ndarray:
        """What has to be in the picture, (k, 3): with a cut, the outline of what it hides too."""
        view, look = self.all[number], self.all[number].frame.look
        mesh = view.frame.mesh
        if look.clip is None or not look.outline or look.isolation is not None:
            return view.places
        return np.concatenate([view.places, mesh.points[mesh.topology.used]])

    def _alike(self, number: int) -> set[int]:
        """The meshes with the same hexes: these alone are compared as they stand."""
        mesh = self.all[number].frame.mesh
        return {other for other, view in self.all.items() if same_hexes(mesh, view.frame.mesh)}

    def picture(self, number: int, camera: vtkCamera, tiles: Tiles) -> Image.Image:
        """The picture of one mesh, as large as a panel."""
        view, window = self.all[number], self._stage.window
        for layer in view.layers:
            window.AddRenderer(layer)
        view.camera.DeepCopy(camera)
        Eye.of(view).reset_depth()
        view.still()
        if tiles.fine > 1:
            window.SetMultiSamples(0)  # edges become smooth as pixels are put together
        view.shade()
        # Without paper, colours are multiplied by how much of a pixel is covered.
        mode = "RGB" if self._ground is not None else "RGBa"
        image, whole, around = Image.new(mode, tiles.size), vtkCamera(), tiles.around
        whole.DeepCopy(view.camera)
        for tile in tiles:
            tiles.aim(view.camera, whole, tile)
            drawn = self._drawn(mode, tiles.fine)
            image.paste(drawn.crop((around, around, around + tile.width, around + tile.height)), (tile.left, tile.top))
        for layer in view.layers:
            window.RemoveRenderer(layer)
        return image.convert("RGBA") if mode == "RGBa" else image

    def _drawn(self, mode: str, fine: int) -> Image.Image:
        """What the stage shows, several of its pixels along each side as one."""
        pixels = self._stage.picture(transparent=self._ground is None)
        image = Image.frombuffer(mode, pixels.shape[1::-1], pixels, "raw", mode, 0, 1)
        return image.reduce(fine) if fine > 1 else image


def aim(camera: vtkCamera, described: Camera, places: np.ndarray, aspect: float) -> None:
    """Bring a camera to where a scene has it.

    Parameters
    ----------
    camera : vtkCamera
    described : Camera
    places : (k, 3) float64
        What just fills the picture where the scene names a direction.
    aspect : float
        Width of the picture by its height.
    """
    stand = described.stand
    if stand is not None:
        Pose(stand.position, stand.focal, stand.up, stand.parallel, stand.scale).give(camera)
        return
    camera.SetParallelProjection(described.parallel)
    look_from(camera, described.direction, described.up)
    fit(camera, places, aspect)


def _axes(camera: vtkCamera) -> np.ndarray:
    """What X, Y and Z are to who looks, (3, 3): a row for each axis."""
    matrix = camera.GetViewTransformMatrix()
    return np.array([[matrix.GetElement(row, axis) for row in range(3)] for axis in range(3)])
