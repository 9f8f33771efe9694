"""Pictures of a mesh at any size, drawn off screen, with a colour bar that is as sharp as the picture."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np
from PIL import Image, ImageDraw, ImageFont
from vtkmodules.vtkRenderingCore import vtkCamera

from hexmend.io.atomic import replacing
from hexmend.io.suffixes import suffix_for
from hexmend.node_step import NodeStep
from hexmend_app.scene.colours import Colouring
from hexmend_app.scene.filters import Filters
from hexmend_app.scene.frame import Frame
from hexmend_app.scene.pane import Pane
from hexmend_app.scene.stage import Stage
from hexmend_app.scene.viewport import Viewport

INK = (31, 38, 48)

#: What a picture can be written as.
SUFFIXES = (".png",)

#: Height of a picture up to which thin lines are a pixel wide.
_ONE_PIXEL = 900

#: Width and height in pixels below which there is no room for the colour bar.
_SMALLEST_WITH_BAR = (320, 160)


def picture(
    frame: Frame,
    size: tuple[int, int],
    *,
    filters: Filters | None = None,
    node_step: NodeStep | None = None,
    view: str | tuple[float, float, float] = "iso",
    camera: vtkCamera | None = None,
    transparent: bool = False,
    bar: bool = True,
) -> Image.Image:
    """Draw a frame.

    Parameters
    ----------
    frame : Frame
    size : (width, height)
        In pixels, the colour bar included.
    filters : Filters, optional
        Those of a view of the mesh, whose elements are drawn: a cut by whole elements is made where the nodes are as a
        plane comes, not where they are now.
    node_step : NodeStep, optional
        A node's step that is drawn too.
    view : str or vector
        The direction to look from, where no camera is given.
    camera : vtkCamera, optional
        To be looked through.
    transparent : bool
        Leave the background out.
    bar : bool
        Draw the colour bar below; a picture too small for it has none, nor one without colours.
    """
    width, height = size
    strip = strip_height(size) if bar and not frame.look.neutral else 0
    with Stage((width, height - strip)) as stage:
        viewport = Viewport(Pane(stage.window), filters=filters, pen=pen_of(size))
        viewport.draw(frame)
        viewport.chosen.show_node_step(node_step)
        viewport.view(view)
        if camera is not None:
            viewport.camera.DeepCopy(camera)
            viewport.camera.SetWindowCenter(0, 0)
            viewport.layers[0].ResetCameraClippingRange()
        viewport.still()
        viewport.shade()
        image = Image.fromarray(stage.picture(transparent))
    if not strip:
        return image
    whole = paper(size, image.mode)
    whole.paste(image, (0, 0))
    whole.paste(colour_bar(viewport.colouring, viewport.colours.apart, (width, strip), image.mode), (0, height - strip))
    return whole


def check_picture(path: Path) -> None:
    """Raise `FileError` for a suffix that no picture has; a name without one is taken as it is."""
    suffix_for(path, "a picture", (*SUFFIXES, ""))


def write_picture(path: Path, image: Image.Image) -> None:
    """Write a picture as a whole or not at all.

    Raises
    ------
    FileError
        For a suffix that no picture has, or where the file cannot be written; the one that was there stays.
    """
    check_picture(path)
    with replacing(path) as temporary:
        image.save(temporary, format="PNG")


def paper(size: tuple[int, int], mode: str) -> Image.Image:
    """Nothing, in a picture of so many pixels: white, or transparent in the mode RGBA."""
    return Image.new(mode, size, (255, 255, 255, 0) if mode == "RGBA" else (255, 255, 255))


def pen_of(size: tuple[int, int]) -> float:
    """How many pixels wide a thin line is in a picture of so many: on paper all sizes of it look alike."""
    width, height = size
    return max(1.0, min(height, width * 5 / 8) / _ONE_PIXEL)


def strip_height(size: tuple[int, int]) -> int:
    """How high the colour bar is in a picture of so many pixels; 0 where there is no room for it."""
    width, height = size
    room = width >= _SMALLEST_WITH_BAR[0] and height >= _SMALLEST_WITH_BAR[1]
    return max(30, round(0.075 * min(height, width * 5 / 8))) if room else 0


def colour_bar(
    colouring: Colouring, apart: Sequence[tuple[str, int | None, tuple]], size: tuple[int, int], mode: str = "RGB"
) -> Image.Image:
    """The colours from the lowest value to the highest, ticks, the swatches of what is set apart.

    Parameters
    ----------
    colouring : Colouring
    apart : sequence of (name, number of elements or None, colour)
        None leaves the number out.
    size : (width, height)
        In pixels.
    mode : str
        Of the picture: RGB or RGBA.
    """
    width, height = size
    image = paper(size, mode)
    draw = ImageDraw.Draw(image)
    unit = height / 30
    font = letters(11 * unit)
    low, high, title = colouring.low, colouring.high, colouring.title
    left, right = round(20 * unit + font.getlength(title)), width - round(150 * unit)
    top, bottom = round(3 * unit), round(14 * unit)
    gradient = Image.fromarray(np.ascontiguousarray(colouring.table[None])).resize((max(1, right - left), bottom - top))
    image.paste(gradient, (left, top))
    draw.text((round(8 * unit), (top + bottom) / 2), title, INK, font, anchor="lm")
    for k in range(6):
        x, value = left + (right - left) * k / 5, low + (high - low) * k / 5
        draw.line((x, bottom, x, bottom + 2 * unit), INK, max(1, round(unit)))
        draw.text((x, bottom + 3 * unit), colouring.label(value), INK, font, anchor="mt")
    swatch, side = right + round(24 * unit), (11 if len(apart) == 1 else 7) * unit
    small = font if len(apart) == 1 else letters(8 * unit)
    for row, (name, count, colour) in enumerate(apart):
        above = top + round(9 * unit) * row
        draw.rectangle((swatch, above, swatch + round(side), above + round(side)), colour)
        text = name if count is None else f"{name} ({count:,})"
        draw.text((swatch + round(17 * unit), above + side / 2), text, INK, small, anchor="lm")
    return image


def letters(size: float, bold: bool = False) -> ImageFont.FreeTypeFont:
    """A font of so many pixels that comes with matplotlib, so that pictures look the same everywhere."""
    import matplotlib as mpl

    name = "DejaVuSans-Bold.ttf" if bold else "DejaVuSans.ttf"
    return ImageFont.truetype(str(Path(mpl.get_data_path()) / "fonts/ttf" / name), max(8, round(size)))
