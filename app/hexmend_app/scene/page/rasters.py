"""Pictures of the panels of a page, rendered off screen."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, replace

import numpy as np
from PIL import Image
from vtkmodules.vtkRenderingCore import vtkCamera

from hexmend_app.picture import Camera, PicturePanel
from hexmend_app.picture.appearance import Look
from hexmend_app.scene.camera.camera_controller import CameraController
from hexmend_app.scene.camera.directions import look_from
from hexmend_app.scene.camera.fitting import fit
from hexmend_app.scene.camera.pane import Pane
from hexmend_app.scene.camera.vtk_pose import apply_pose
from hexmend_app.scene.colour.colouring import Colouring, declared_ends
from hexmend_app.scene.geometry.frame import Frame, same_hexes
from hexmend_app.scene.page.layout import Layout
from hexmend_app.scene.page.lettering import Entry
from hexmend_app.scene.page.page_mesh import PageMesh
from hexmend_app.scene.render.stage import Stage
from hexmend_app.scene.render.tiles import AT_ONCE, Tiles
from hexmend_app.scene.views.viewport import Viewport
from hexmend_app.state.node_step import NodeStep

#: Background of transparent pages: black, so that colours are premultiplied by coverage.
_TRANSPARENT = "#000000"


@dataclass(frozen=True, eq=False)
class Rasters:
    """Rendered panels of a page.

    Parameters
    ----------
    images : list of Image
        Picture of each panel: RGB, or RGBA with a transparent background.
    axes : list of (3, 3) float64
        Directions of the X, Y and Z axes in each panel, in camera coordinates: right, up, and towards the viewer.
    colouring : Colouring
        Colouring of all panels.
    special_colours : list of Entry
        Special colours for the legend, with the number of hexes if a single mesh is shown.
    values : list of ((m,) float64, (m,) uint8)
        Coloured values of the hexes of each mesh that is shown, and the numbers of their special colours.
    """

    images: list[Image.Image]
    axes: list[np.ndarray]
    colouring: Colouring
    special_colours: list[Entry]
    values: list[tuple[np.ndarray, np.ndarray]]


def rasters(layout: Layout, *, node_step: NodeStep | None = None, at_once: int = AT_ONCE) -> Rasters:
    """Render the panels of a page; for the parameters see `page_views`."""
    with page_views(layout, node_step=node_step, at_once=at_once) as views:
        return views.rasters(layout)


@contextmanager
def page_views(
    layout: Layout,
    *,
    node_step: NodeStep | None = None,
    at_once: int = AT_ONCE,
    aspect: float = 0.0,
) -> Iterator[PageViews]:
    """Open the views of the meshes of a page, to render its panels once or several times.

    Parameters
    ----------
    layout : Layout
    node_step : NodeStep, optional
        Node step to draw in the first mesh.
    at_once : int
        Maximum number of pixels that are rendered at once; larger pictures are rendered in tiles.
    aspect : float
        Smallest width by height of what the cameras show; panels that are narrower show more above and below.
    """
    page = layout.scene.page
    pixel_ratio = page.line_width(layout.scene.lines) * page.supersampling
    tiles = Tiles.of(layout.panel, page.supersampling, pixel_ratio, at_once)
    with Stage(tiles.drawn) as stage:
        views = PageViews(stage, tiles, layout, pixel_ratio, aspect)
        views.all[1].overlay_layers.selection.show_node_step(node_step)
        yield views


class PageViews:
    """Views of the meshes of a page, which share a stage and are rendered one at a time.

    Attributes
    ----------
    all : dict of Viewport
        Views by the number of their mesh, from 1.

    Parameters
    ----------
    stage : Stage
    tiles : Tiles
        Division of the picture of a panel.
    layout : Layout
    pixel_ratio : float
        Width of a thin line, in rendered pixels.
    aspect : float
        Smallest width by height of what the cameras show.
    """

    def __init__(self, stage: Stage, tiles: Tiles, layout: Layout, pixel_ratio: float, aspect: float):
        self._stage, self._tiles, self._layout, self._aspect = stage, tiles, layout, aspect
        self._background = layout.scene.page.ground
        self.shown = layout.shown
        self.all: dict[int, Viewport] = {}
        self._cameras: dict[tuple[str, int], vtkCamera] = {}
        self._pictures: dict[tuple[int, vtkCamera], Image.Image] = {}
        self._look = look = layout.scene.look(layout.meshes[0].mesh)
        first, filters = replace(layout.meshes[0], look=look), None
        for number in sorted(self.shown | {1}):
            view = Viewport(Pane(stage.window), axes=False, filters=filters, pixel_ratio=pixel_ratio)
            view.set_dark(layout.scene.page.dark)
            view.set_background(self._background or _TRANSPARENT)
            view.draw(first if number == 1 else self._frame_of_other(layout.meshes[number - 1], first))
            self.all[number] = view
            filters = self.all[1].filters
            for layer in view.layers:
                stage.window.RemoveRenderer(layer)
        self._share_colour_range(look)

    def show(self, number: int, mesh: PageMesh) -> None:
        """Draw a mesh with other positions of its nodes in the view of a number."""
        self.all[number].draw(replace(mesh, look=self._look))
        self._pictures = {key: picture for key, picture in self._pictures.items() if key[0] != number}

    def rasters(self, layout: Layout) -> Rasters:
        """Render the panels of a page with these meshes; pictures of meshes that have not changed are used again."""
        images, axes = [], []
        for panel in layout.panels:
            camera = self._camera(panel)
            image = self._picture(panel.mesh, camera)
            if panel.wipe is not None:
                edge = round(panel.wipe.at * image.width)
                image = image.copy()
                image.paste(self._picture(panel.wipe.mesh, camera).crop((edge, 0, *image.size)), (edge, 0))
            images.append(image)
            axes.append(_axes(camera))
        colours = [self.all[number].colours for number in sorted(self.shown)]
        single = len(colours) == 1
        counts = colours[0].special_counts
        special_colours: list[Entry] = [(f"{name} ({n:,})" if single else name, colour) for name, n, colour in counts]
        values = [(one.values, one.kinds) for one in colours]
        return Rasters(images, axes, self.all[1].colouring, special_colours, values)

    def _frame_of_other(self, other: PageMesh, first: Frame) -> Frame:
        """Return the frame of another mesh than the first, with the look of the first if their hexes are equal."""
        if same_hexes(first.mesh, other.mesh):
            return other.matching(first)
        scene = self._layout.scene
        # Hex numbers apply to the first mesh only.
        show = replace(scene.show, marked=frozenset())
        scene = replace(scene, cut=replace(scene.cut, hexes=""), show=show)
        return Frame(other.mesh, other.quality, look=scene.look(other.mesh))

    def _share_colour_range(self, look: Look) -> None:
        """Extend a fitted colour range to the values of all views."""
        if declared_ends(look.colours) is None:
            lows, highs = zip(*(self.all[number].colours.ends for number in self.shown), strict=True)
            for view in self.all.values():
                view.extend_range((min(lows), max(highs)))

    def _camera(self, panel: PicturePanel) -> vtkCamera:
        """Return the camera of a panel; it includes all meshes with equal hexes in panels with the same camera."""
        comparable = self._comparable(panel.mesh)
        key = panel.camera, min(comparable)
        if key not in self._cameras:
            sharing = [other for other in self._layout.panels if other.camera == panel.camera]
            numbers = {other.mesh for other in sharing} | {other.wipe.mesh for other in sharing if other.wipe}
            places = np.concatenate([self.all[number].places for number in sorted(numbers & comparable)])
            width, height = self._layout.panel
            camera = self._cameras[key] = vtkCamera()
            aim(camera, self._layout.scene.camera_of(panel), places, width / height)
            if width < self._aspect * height:
                camera.Zoom(width / height / self._aspect)
        return self._cameras[key]

    def _comparable(self, number: int) -> set[int]:
        """Return the numbers of the meshes with the same hexes as a mesh."""
        mesh = self.all[number].frame.mesh
        return {other for other, view in self.all.items() if same_hexes(mesh, view.frame.mesh)}

    def _picture(self, number: int, camera: vtkCamera) -> Image.Image:
        """Return the picture of a mesh in the size of a panel."""
        if (number, camera) not in self._pictures:
            self._pictures[number, camera] = self._drawn(number, camera)
        return self._pictures[number, camera]

    def _drawn(self, number: int, camera: vtkCamera) -> Image.Image:
        view, window, tiles = self.all[number], self._stage.window, self._tiles
        for layer in view.layers:
            window.AddRenderer(layer)
        view.camera.DeepCopy(camera)
        CameraController.of(view).reset_depth()
        view.still()
        if tiles.fine > 1:
            window.SetMultiSamples(0)  # averaging of pixels smooths edges
        view.shade()
        # With a transparent background, colours are premultiplied by coverage.
        mode = "RGB" if self._background is not None else "RGBa"
        image, whole, around = Image.new(mode, tiles.size), vtkCamera(), tiles.around
        whole.DeepCopy(view.camera)
        for tile in tiles:
            tiles.aim(view.camera, whole, tile)
            rendered = self._render(mode, tiles.fine)
            box = around, around, around + tile.width, around + tile.height
            image.paste(rendered.crop(box), (tile.left, tile.top))
        for layer in view.layers:
            window.RemoveRenderer(layer)
        return image.convert("RGBA") if mode == "RGBa" else image

    def _render(self, mode: str, fine: int) -> Image.Image:
        """Render the stage and average its supersampled pixels."""
        pixels = self._stage.picture(transparent=self._background is None)
        image = Image.frombuffer(mode, pixels.shape[1::-1], pixels, "raw", mode, 0, 1)
        return image.reduce(fine) if fine > 1 else image


def aim(camera: vtkCamera, described: Camera, places: np.ndarray, aspect: float) -> None:
    """Set a camera as described by a scene.

    Parameters
    ----------
    camera : vtkCamera
    described : Camera
    places : (k, 3) float64
        Points that fill the picture if the scene specifies a direction.
    aspect : float
        Width of the picture by its height.
    """
    pose = described.pose
    if pose is not None:
        apply_pose(camera, pose)
        return
    camera.SetParallelProjection(described.parallel)
    look_from(camera, described.direction, described.up)
    fit(camera, places, aspect)


def _axes(camera: vtkCamera) -> np.ndarray:
    """Return the X, Y and Z axes in camera coordinates as the rows of (3, 3)."""
    matrix = camera.GetViewTransformMatrix()
    return np.array([[matrix.GetElement(row, axis) for row in range(3)] for axis in range(3)])
