"""A scene drawn on a page: pictures of the panels, and over them what is drawn in lines and letters."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from PIL import Image

from hexmend.io.storage.atomic import atomic_write
from hexmend.io.storage.suffixes import suffix_for
from hexmend.node_step import NodeStep
from hexmend_app.scene.export.bar import draw_bar
from hexmend_app.scene.export.captions import draw_captions
from hexmend_app.scene.export.ink import Ink
from hexmend_app.scene.export.layout import Layout
from hexmend_app.scene.export.rasters import Rasters, rasters
from hexmend_app.scene.export.subject import Subject
from hexmend_app.scene.export.triad import draw_axes
from hexmend_app.scene.filters import Filters
from hexmend_app.state.scene import Scene

if TYPE_CHECKING:
    from matplotlib.figure import Figure

#: What a page can be written as, by suffix.
FORMATS = {".png": "PNG", ".tif": "TIFF", ".tiff": "TIFF", ".pdf": "pdf", ".svg": "svg"}

#: Vectors that are the same for the same page, with texts that stay texts.
_VECTORS = {"svg.hashsalt": "hexmend", "svg.fonttype": "none", "pdf.fonttype": 42, "image.composite_image": False}
_DATES = {"svg": {"Date": None}, "pdf": {"CreationDate": None}}

#: What is no ground: brighter or darker by so many steps.
_SEEN = 3


class Sheet:
    """A drawn page.

    Attributes
    ----------
    size : (width, height)
        In pixels: as the page asks for, or smaller where it is cropped.

    Parameters
    ----------
    layout : Layout
    drawn : Rasters
    """

    def __init__(self, layout: Layout, drawn: Rasters):
        self._layout, self._drawn = layout, drawn
        self.size = layout.size

    def image(self) -> Image.Image:
        """The page in pixels: RGB, or RGBA on transparent paper."""
        from matplotlib.backends.backend_agg import FigureCanvasAgg

        layout, ground = self._layout, self._layout.scene.page.ground
        page = Image.new("RGBA", layout.size, ground or (0, 0, 0, 0))
        for number, image in enumerate(self._drawn.images):
            box = layout.place(number)
            page.paste(image, (box.left, box.top))
        # Lines and letters on nothing, laid over that: an image in a figure takes matplotlib ten times its memory.
        canvas = FigureCanvasAgg(self._figure(pictures=False))
        canvas.draw()
        page.alpha_composite(Image.fromarray(np.asarray(canvas.buffer_rgba())))
        return page if ground is None else page.convert("RGB")

    def write(self, path: Path, texts: Mapping[str, str] | None = None) -> None:
        """Write the page as a whole or not at all.

        Parameters
        ----------
        path : Path
            Its suffix is one of `FORMATS`, or there is none, which stands for PNG.
        texts : mapping, optional
            Texts that a PNG carries, by keyword.

        Raises
        ------
        FileError
            For another suffix, or where the file cannot be written; the one that was there stays.
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
        how = {"dpi": (resolution, resolution)}
        if kind == "TIFF":
            how["compression"] = "tiff_lzw"
        elif texts:
            how["pnginfo"] = PngInfo()
            for keyword, text in texts.items():
                how["pnginfo"].add_itxt(keyword, text)
        self.image().save(path, format=kind, **how)

    def _write_vectors(self, path: Path, kind: str) -> None:
        from matplotlib import rc_context

        with rc_context(_VECTORS):
            figure = self._figure(pictures=True)
            ground = self._layout.scene.page.ground or "none"
            figure.savefig(path, format=kind, dpi=figure.dpi, facecolor=ground, metadata=_DATES[kind])

    def _figure(self, pictures: bool) -> Figure:
        """The page of matplotlib, on paper with the panels' pictures, or without both."""
        from matplotlib.figure import Figure

        layout, page = self._layout, self._layout.scene.page
        # A hair more than whole pixels, which rounding would else take one of.
        inches = [(side + 1e-3) / page.resolution for side in layout.size]
        figure = Figure(figsize=inches, dpi=page.resolution, facecolor="none")
        axes = figure.add_axes((0, 0, 1, 1), xlim=(0, layout.size[0]), ylim=(layout.size[1], 0), autoscale_on=False)
        axes.axis("off")
        ink = Ink(axes, layout)
        cameras = set()
        for number, (panel, image) in enumerate(zip(layout.panels, self._drawn.images, strict=True)):
            if pictures:
                ink.image(image, layout.place(number))
            if layout.scene.axes.show and panel.camera not in cameras:
                cameras.add(panel.camera)
                seen = self._drawn.axes[number]
                draw_axes(ink, layout.place(number), seen, layout.scene.axes.place, page)
        draw_captions(ink, layout)
        draw_bar(ink, layout, self._drawn)
        return figure


def draw_sheet(
    scene: Scene, subjects: Sequence[Subject], *, filters: Filters | None = None, node_step: NodeStep | None = None
) -> Sheet:
    """Draw a scene of meshes, off screen.

    Parameters
    ----------
    scene : Scene
    subjects : sequence of Subject
        At least one; the panels name them by number from 1.
    filters : Filters, optional
        Those of a view of the first mesh, whose elements are drawn: a cut by whole elements is made where the nodes are
        as a plane comes, not where they are now.
    node_step : NodeStep, optional
        A node's step that is drawn in the first mesh.

    Raises
    ------
    ParameterError
        Where the scene names hexes or meshes that there are not, or its page has no room for its panels.
    """
    layout = Layout.of(scene, subjects)
    drawn = rasters(layout, filters=filters, node_step=node_step)
    return Sheet(*_cropped(layout, drawn)) if scene.page.crop else Sheet(layout, drawn)


def format_of(path: Path) -> str:
    """The format that a path's suffix stands for; a name without one is a PNG's.

    Raises
    ------
    FileError
        For another suffix.
    """
    return FORMATS.get(suffix_for(path, "a picture", (*FORMATS, "")), "PNG")


def _cropped(layout: Layout, drawn: Rasters) -> tuple[Layout, Rasters]:
    """The page without paper that is empty in all panels at once; a page on which nothing is seen stays."""
    seen = np.logical_or.reduce([_seen(image, layout.scene.page.ground) for image in drawn.images])
    if not seen.any():
        return layout, drawn
    rows, columns = np.flatnonzero(seen.any(axis=1)), np.flatnonzero(seen.any(axis=0))
    box = int(columns[0]), int(rows[0]), int(columns[-1]) + 1, int(rows[-1]) + 1
    images = [image.crop(box) for image in drawn.images]
    return layout.cropped(images[0].size), replace(drawn, images=images)


def _seen(image: Image.Image, ground: str | None) -> np.ndarray:
    """Where something is drawn, (height, width) bool."""
    pixels = np.asarray(image).astype(np.int16)
    if ground is None:
        return pixels[..., 3] > 0
    return np.abs(pixels - np.frombuffer(bytes.fromhex(ground[1:]), np.uint8)).max(axis=2) > _SEEN
