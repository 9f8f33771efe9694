"""Pictures of the panels of a page, drawn off screen."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
from PIL import Image
from vtkmodules.vtkRenderingCore import vtkCamera, vtkProp

from hexmend.node_step import NodeStep
from hexmend_app.picture import Camera, PicturePanel
from hexmend_app.picture.appearance import Look
from hexmend_app.scene.camera.camera_controller import CameraController
from hexmend_app.scene.camera.directions import look_from
from hexmend_app.scene.camera.fitting import fit
from hexmend_app.scene.camera.vtk_pose import apply_pose
from hexmend_app.scene.colour.colouring import Colouring, declared_ends
from hexmend_app.scene.geometry.filters import Filters
from hexmend_app.scene.page.layout import Layout
from hexmend_app.scene.page.page_mesh import PageMesh
from hexmend_app.scene.render.stage import Stage
from hexmend_app.scene.render.tiles import AT_ONCE, Tiles
from hexmend_app.scene.views.frame import Frame, same_hexes
from hexmend_app.scene.views.pane import Pane
from hexmend_app.scene.views.viewport import Viewport

#: What is drawn on where the paper is transparent: colours are then those of what is seen, by how much of it there is.
_NOTHING = "#000000"


@dataclass(frozen=True, eq=False)
class Rasters:
    """Drawn panels of a page.

    Parameters
    ----------
    images : list of Image
        One of each panel: RGB, or RGBA on transparent paper.
    axes : list of (3, 3) float64
        Of each panel, what the X, Y and Z axis are to who looks: to the right, up, and towards him.
    colouring : Colouring
        Colouring of all panels.
    special_colours : list of (name, count or None, colour)
        Special colours, with the number of hexes if a single mesh is shown.
    """

    images: list[Image.Image]
    axes: list[np.ndarray]
    colouring: Colouring
    special_colours: list[tuple[str, int | None, tuple[int, int, int]]]


def rasters(
    layout: Layout,
    *,
    filters: Filters | None = None,
    node_step: NodeStep | None = None,
    props: Callable[[float], list[vtkProp]] | None = None,
    at_once: int = AT_ONCE,
) -> Rasters:
    """Draw the panels of a page.

    Parameters
    ----------
    layout : Layout
    filters : Filters, optional
        Filters of a view of the first mesh, whose hexes are drawn.
    node_step : NodeStep, optional
        A node's step that is drawn in the first mesh.
    props : callable, optional
        Returns further props for the views of the first mesh, from the width in pixels of a thin line.
    at_once : int
        Pixels that are drawn at once: larger pictures are drawn in tiles.
    """
    scene = layout.scene
    look = scene.look(layout.subjects[0].mesh)
    fine = scene.page.supersampling
    pixel_ratio = scene.page.pen(scene.lines) * fine
    tiles = Tiles.of(layout.panel, fine, pixel_ratio, at_once)
    with Stage(tiles.drawn) as stage:
        views = _Views(stage, layout, look, pixel_ratio, filters)
        views.all[1].extras.selection.show_node_step(node_step)
        for prop in () if props is None else props(pixel_ratio):
            views.all[1].layers[0].AddViewProp(prop)
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
        shown = views.all[min(views.shown)].colours.special_counts
        special_colours = [(name, count if numbered else None, colour) for name, count, colour in shown]
        return Rasters(images, axes, first.colouring, special_colours)


class _Views:
    """Views of the meshes of a page, each drawn alone on one stage."""

    def __init__(self, stage: Stage, layout: Layout, look: Look, pixel_ratio: float, filters: Filters | None):
        self._stage, self._layout, self._ground = stage, layout, layout.scene.page.ground
        self.shown = {panel.mesh for panel in layout.panels}
        self.shown |= {panel.wipe.mesh for panel in layout.panels if panel.wipe is not None}
        self.all: dict[int, Viewport] = {}
        self._cameras: dict[tuple[str, int], vtkCamera] = {}
        first = layout.subjects[0].frame(look)
        for number in sorted(self.shown | {1}):
            view = Viewport(Pane(stage.window), axes=False, filters=filters, pixel_ratio=pixel_ratio)
            view.set_dark(layout.scene.page.dark)
            view.set_background(self._ground or _NOTHING)
            view.draw(first if number == 1 else self._neighbour(layout.subjects[number - 1], first))
            self.all[number] = view
            filters = self.all[1].filters
            for layer in view.layers:
                stage.window.RemoveRenderer(layer)
        self._level(look)

    def _neighbour(self, subject: PageMesh, first: Frame) -> Frame:
        """Return the frame of a further mesh: under the look of the first for equal hexes, else by the scene."""
        if same_hexes(first.mesh, subject.mesh):
            return Frame(subject.mesh, subject.figures).matching(first)
        scene = self._layout.scene
        anew = replace(scene, cut=replace(scene.cut, hexes=""))  # what the cut leaves is said of the first alone
        return Frame(subject.mesh, subject.figures, look=anew.look(subject.mesh))

    def _level(self, look: Look) -> None:
        """Extend a fitted colour range to all views."""
        if declared_ends(look.scale) is None:
            lows, highs = zip(*(self.all[number].colours.ends for number in self.shown), strict=True)
            for view in self.all.values():
                view.extend_range((min(lows), max(highs)))

    def camera(self, panel: PicturePanel) -> vtkCamera:
        """Return the camera of a panel, which shows all meshes that share it whole."""
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
        """Return the points that the picture includes, (k, 3); a cut includes the outline of what it hides."""
        view, look = self.all[number], self.all[number].frame.look
        mesh = view.frame.mesh
        if look.clip is None or not look.outline or look.isolation is not None:
            return view.places
        return np.concatenate([view.places, mesh.points[mesh.topology.used]])

    def _alike(self, number: int) -> set[int]:
        """Return the meshes with the same hexes: only these are compared in place."""
        mesh = self.all[number].frame.mesh
        return {other for other, view in self.all.items() if same_hexes(mesh, view.frame.mesh)}

    def picture(self, number: int, camera: vtkCamera, tiles: Tiles) -> Image.Image:
        """Return the picture of one mesh in the size of a panel."""
        view, window = self.all[number], self._stage.window
        for layer in view.layers:
            window.AddRenderer(layer)
        view.camera.DeepCopy(camera)
        CameraController.of(view).reset_depth()
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
        """Draw the stage and average its supersampled pixels."""
        pixels = self._stage.picture(transparent=self._ground is None)
        image = Image.frombuffer(mode, pixels.shape[1::-1], pixels, "raw", mode, 0, 1)
        return image.reduce(fine) if fine > 1 else image


def aim(camera: vtkCamera, described: Camera, places: np.ndarray, aspect: float) -> None:
    """Set a camera as a scene describes it.

    Parameters
    ----------
    camera : vtkCamera
    described : Camera
    places : (k, 3) float64
        Points that fill the picture if the scene names a direction.
    aspect : float
        Width of the picture by its height.
    """
    stand = described.stand
    if stand is not None:
        apply_pose(camera, stand)
        return
    camera.SetParallelProjection(described.parallel)
    look_from(camera, described.direction, described.up)
    fit(camera, places, aspect)


def _axes(camera: vtkCamera) -> np.ndarray:
    """Return X, Y and Z in camera coordinates, (3, 3), one a row."""
    matrix = camera.GetViewTransformMatrix()
    return np.array([[matrix.GetElement(row, axis) for row in range(3)] for axis in range(3)])
