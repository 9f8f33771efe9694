"""Pages of scenes: pictures of the panels, with lines and texts over them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from PIL import Image, ImageChops

from hexmend.io.storage.atomic import atomic_write
from hexmend.io.storage.suffixes import suffix_for
from hexmend_app.picture import Corner, Scene
from hexmend_app.scene.page.drawing import Drawing
from hexmend_app.scene.page.layout import Layout, Rectangle
from hexmend_app.scene.page.page_captions import draw_captions
from hexmend_app.scene.page.page_colour_bar import draw_bar
from hexmend_app.scene.page.page_histogram import draw_histogram
from hexmend_app.scene.page.page_mesh import PageMesh
from hexmend_app.scene.page.rasters import Rasters, rasters
from hexmend_app.state.node_step import NodeStep

if TYPE_CHECKING:
    from matplotlib.figure import Figure

#: Formats of page files, by suffix.
FORMATS = {".png": "PNG", ".tif": "TIFF", ".tiff": "TIFF", ".pdf": "pdf", ".svg": "svg"}

#: Settings of vector formats: reproducible files, in which texts remain texts.
_VECTORS: Any = {"svg.hashsalt": "hexmend", "svg.fonttype": "none", "pdf.fonttype": 42, "image.composite_image": False}
_DATES = {"svg": {"Date": None}, "pdf": {"CreationDate": None}}

#: Difference from the background above which a pixel counts as drawn, 0 to 255.
_THRESHOLD = 3

#: Colours of X, Y and Z on a bright and on a dark background.
_COLOURS = (("#d1342f", "#ff7a66"), ("#2e8b57", "#5fd394"), ("#1f4fd8", "#7fa6ff"))

#: Sizes in font heights: axis, distance of the letter from its end, free margin around the letters.
_ARM, _BEYOND, _FREE = 2.2, 0.65, 1.0

#: Maximum size of the axes, as a fraction of the shorter side of a panel.
_MAX_SIZE = 0.5

#: Length below which an axis is left out, relative to one in the plane of the picture.
_SHORTEST = 0.12


class PageRenderer:
    """A drawn page, which can be returned as an image or written to a file.

    Attributes
    ----------
    size : (width, height)
        Size in pixels; smaller than the page of the scene if the page is cropped.

    Parameters
    ----------
    layout : Layout
    drawn : Rasters
    """

    def __init__(self, layout: Layout, drawn: Rasters):
        self._layout, self._drawn = layout, drawn
        self.size = layout.size

    def image(self) -> Image.Image:
        """Return the page as an image: RGB, or RGBA with a transparent background."""
        from matplotlib.backends.backend_agg import FigureCanvasAgg

        layout, ground = self._layout, self._layout.scene.page.ground
        page = Image.new("RGBA", layout.size, ground or (0, 0, 0, 0))
        for number, image in enumerate(self._drawn.images):
            box = layout.place(number)
            page.paste(image, (box.left, box.top))
        # Draw lines and letters separately: an image in a figure takes ten times its memory in matplotlib.
        canvas = FigureCanvasAgg(self._figure(pictures=False))
        canvas.draw()
        page.alpha_composite(Image.fromarray(np.asarray(canvas.buffer_rgba())))
        return page if ground is None else page.convert("RGB")

    def write(self, path: Path, texts: Mapping[str, str] | None = None) -> None:
        """Write the page atomically.

        Parameters
        ----------
        path : Path
            Path with a suffix of `FORMATS`; without a suffix, the format is PNG.
        texts : mapping, optional
            Text metadata of a PNG, by keyword.

        Raises
        ------
        FileError
            For another suffix, or if the file cannot be written; an existing file is left unchanged.
        """
        kind = format_of(path)
        with atomic_write(path) as temporary:
            if kind in _DATES:
                self._write_vectors(temporary, kind)
            else:
                self._write_pixels(temporary, kind, texts or {})

    def _write_pixels(self, path: Path, kind: str, texts: Mapping[str, str]) -> None:
        from PIL.PngImagePlugin import PngInfo

        resolution = self._layout.scene.page.resolution
        options: dict[str, Any] = {"dpi": (resolution, resolution)}
        if kind == "TIFF":
            options["compression"] = "tiff_lzw"
        elif texts:
            options["pnginfo"] = PngInfo()
            for keyword, text in texts.items():
                options["pnginfo"].add_itxt(keyword, text)
        self.image().save(path, format=kind, **options)

    def _write_vectors(self, path: Path, kind: str) -> None:
        from matplotlib import rc_context

        with rc_context(_VECTORS):
            figure = self._figure(pictures=True)
            ground = self._layout.scene.page.ground or "none"
            figure.savefig(path, format=kind, dpi=figure.dpi, facecolor=ground, metadata=_DATES[kind])

    def _figure(self, pictures: bool) -> Figure:
        """Draw the page with matplotlib, with or without the pictures of its panels."""
        from matplotlib.figure import Figure

        layout, page = self._layout, self._layout.scene.page
        # Slightly more than whole pixels, so that rounding does not drop a pixel.
        width, height = ((side + 1e-3) / page.resolution for side in layout.size)
        figure = Figure(figsize=(width, height), dpi=page.resolution, facecolor="none")
        drawing = Drawing(figure, layout)
        cameras = set()
        for number, (panel, image) in enumerate(zip(layout.panels, self._drawn.images, strict=True)):
            if pictures:
                drawing.image(image, layout.place(number))
            if layout.scene.axes.show and panel.camera not in cameras:
                cameras.add(panel.camera)
                draw_axes(drawing, layout.place(number), self._drawn.axes[number], layout.scene.axes.place)
        draw_captions(drawing, layout)
        draw_histogram(drawing, layout, self._drawn)
        draw_bar(drawing, layout, self._drawn)
        return figure


def draw_page(scene: Scene, meshes: Sequence[PageMesh], *, node_step: NodeStep | None = None) -> PageRenderer:
    """Draw the page of a scene off screen.

    Parameters
    ----------
    scene : Scene
    meshes : sequence of PageMesh
        At least one mesh; panels refer to them by number from 1.
    node_step : NodeStep, optional
        Node step to draw in the first mesh.

    Raises
    ------
    ParameterError
        If the scene names hexes or meshes that do not exist, or its page is too small for its panels.
    """
    layout = Layout.of(scene, meshes)
    drawn = rasters(layout, node_step=node_step)
    return PageRenderer(*_cropped(layout, drawn)) if scene.page.crop else PageRenderer(layout, drawn)


def format_of(path: Path) -> str:
    """Return the format of a path by its suffix; PNG if it has none.

    Raises
    ------
    FileError
        For another suffix.
    """
    return FORMATS.get(suffix_for(path, "a picture", (*FORMATS, "")), "PNG")


def _cropped(layout: Layout, drawn: Rasters) -> tuple[Layout, Rasters]:
    """Crop margins that are empty in all panels; an empty page is not cropped."""
    boxes = [box for image in drawn.images if (box := _box_of_drawn(image, layout.scene.page.ground))]
    if not boxes:
        return layout, drawn
    left, top, right, bottom = zip(*boxes, strict=True)
    box = min(left), min(top), max(right), max(bottom)
    images = [image.crop(box) for image in drawn.images]
    return layout.cropped(images[0].size), replace(drawn, images=images)


def _box_of_drawn(image: Image.Image, ground: str | None) -> tuple[int, int, int, int] | None:
    """Return the left, upper, right and lower end of the drawn pixels; None if there are none."""
    if ground is None:
        return image.getchannel("A").getbbox()
    difference = ImageChops.difference(image, Image.new(image.mode, image.size, ground))
    return difference.point(lambda value: value > _THRESHOLD).getbbox()


def draw_axes(drawing: Drawing, box: Rectangle, axes: np.ndarray, corner: Corner) -> None:
    """Draw the X, Y and Z axes in the orientation of the camera.

    Parameters
    ----------
    drawing : Drawing
    box : Rectangle
        Rectangle of the panel.
    axes : (3, 3) float64
        Each axis in camera coordinates: right, up, and towards the viewer.
    corner : Corner
    """
    letter, flat = drawing.letters.height, axes[:, :2] * (1, -1)
    if (_ARM + _BEYOND + _FREE) * letter > _MAX_SIZE * min(box.width, box.height):
        return  # the panel is too small
    # Extent of the axes in this orientation, for placing them in the corner.
    low = (np.minimum(flat.min(axis=0), 0) * (_ARM + _BEYOND) - _FREE) * letter
    high = (np.maximum(flat.max(axis=0), 0) * (_ARM + _BEYOND) + _FREE) * letter
    down, across = corner.value.split()
    x = box.left - low[0] if across == "left" else box.left + box.width - high[0]
    y = box.top - low[1] if down == "upper" else box.top + box.height - high[1]
    for axis in np.argsort(axes[:, 2]):  # nearer axes are drawn over farther axes
        (u, v), colour = flat[axis] * letter, _COLOURS[axis][drawing.dark]
        if np.linalg.norm(flat[axis]) < _SHORTEST:
            continue  # it points to the viewer or away
        drawing.arrow((x, y), (x + _ARM * u, y + _ARM * v), colour)
        place = x + (_ARM + _BEYOND) * u, y + (_ARM + _BEYOND) * v
        drawing.text(*place, "XYZ"[axis], anchor="mm", bold=True, colour=colour, share=0.9, halo=True)
