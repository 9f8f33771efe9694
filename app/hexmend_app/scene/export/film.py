"""Moving pictures of a run: the mesh at iteration after iteration, with its figures."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path

import numpy as np
from PIL import Image, ImageDraw
from vtkmodules.vtkRenderingCore import vtkCamera

from hexmend.io.atomic import replacing
from hexmend.io.suffixes import suffix_for
from hexmend.movement import Moment, Movement
from hexmend_app.scene.export.frames import INK, colour_bar, letters, paper, pen_of, strip_height
from hexmend_app.scene.export.shots import Shot
from hexmend_app.scene.frame import Frame
from hexmend_app.scene.pane import Pane
from hexmend_app.scene.stage import Stage
from hexmend_app.scene.viewport import Viewport
from hexmend_app.state.look import Look, Since

#: What can be written, by suffix: all are shown by browsers.
FORMATS = {".gif": "GIF", ".png": "PNG", ".webp": "WEBP"}

#: Colours of a GIF, shared by all its frames: what a map, an edge and a shade need.
_COLOURS = 128

#: How long the first and the last frame stand, in frames.
_STAND = 8


def pictures(
    shots: Iterable[Shot],
    look: Look,
    size: tuple[int, int],
    *,
    view: str | tuple[float, float, float] = "iso",
    camera: vtkCamera | None = None,
    movement: Movement | None = None,
) -> Iterator[Image.Image]:
    """Draw frames one after another, off screen, with one camera.

    Parameters
    ----------
    shots : iterable of Shot
    look : Look
    size : (width, height)
        In pixels, caption and colour bar included.
    view : str or vector
        The direction to look from, where no camera is given.
    camera : vtkCamera, optional
        To be looked through.
    movement : Movement, optional
        Of the moment that every picture is compared with, where the look shows a movement; one since the iteration
        before is since the picture before.
    """
    width, height = size
    strip = strip_height(size)
    with Stage((width, height - (1 if look.neutral else 2) * strip)) as stage:
        viewport = Viewport(Pane(stage.window), pen=pen_of(size))
        seen_last: Moment | None = None
        for shot in shots:
            mesh, figures = shot.state.mesh, shot.state.figures
            if movement is not None:
                before = seen_last if look.traces.since is Since.ITERATION else movement.before
                now = Moment(mesh.points, figures, "the picture before")
                movement = Movement(movement.mesh, before or now, mesh.points, figures)
                seen_last = now
            first = viewport.frame is None
            viewport.draw(Frame(mesh, figures, movement, look))
            if first:
                viewport.view(view)
                if camera is not None:
                    viewport.camera.DeepCopy(camera)
                    viewport.camera.SetWindowCenter(0, 0)
            viewport.still()
            viewport.shade()
            viewport.layers[0].ResetCameraClippingRange()
            yield _framed(Image.fromarray(stage.picture()), shot, viewport, size, strip)


def _framed(seen: Image.Image, shot: Shot, viewport: Viewport, size: tuple[int, int], strip: int) -> Image.Image:
    """A caption above, and below the colour bar where there are colours."""
    whole = paper(size, seen.mode)
    whole.paste(seen, (0, strip))
    if strip:
        at = (round(0.3 * strip), strip / 2)
        ImageDraw.Draw(whole).text(at, shot.caption, INK, letters(0.42 * strip), anchor="lm")
    if strip and not viewport.frame.look.neutral:
        bar = colour_bar(viewport.colouring, viewport.colours.apart, (size[0], strip), seen.mode)
        whole.paste(bar, (0, size[1] - strip))
    return whole


def write_film(path: Path, frames: Sequence[Image.Image], rate: float) -> None:
    """Write frames as a GIF, an animated PNG or a WebP that repeats for ever; the first and the last stand longer.

    Parameters
    ----------
    path : Path
    frames : sequence of Image
        At least one.
    rate : float
        Frames a second.

    Raises
    ------
    FileError
        For a suffix that is none of `FORMATS`, or where the file cannot be written.
    """
    format = format_of(path)
    each = round(1000 / rate)
    lengths = [each] * len(frames)
    lengths[0] = lengths[-1] = _STAND * each
    if format == "GIF":
        frames = _with_one_palette(frames)
    with replacing(path) as temporary:
        first, *others = frames
        first.save(
            temporary, format=format, save_all=True, append_images=others, duration=lengths, loop=0, optimize=True
        )


def format_of(path: Path) -> str:
    """The format that a path's suffix stands for.

    Raises
    ------
    FileError
        For another suffix.
    """
    return FORMATS[suffix_for(path, "a film", FORMATS)]


def _with_one_palette(frames: Sequence[Image.Image]) -> list[Image.Image]:
    """Frames of few colours, the same for all: what does not change then takes no room."""
    some = np.concatenate([np.asarray(frames[k]).reshape(-1, 3) for k in (0, len(frames) // 2, -1)])
    colours, counts = np.unique(some, axis=0, return_counts=True)
    # By the root of how often they are seen: or the ground would leave no colours to the mesh and the bar.
    weighted = np.repeat(colours, np.ceil(np.sqrt(counts)).astype(int), axis=0)
    palette = Image.fromarray(weighted[None]).quantize(_COLOURS, method=Image.Quantize.MEDIANCUT)
    return [one.quantize(palette=palette, dither=Image.Dither.NONE) for one in frames]
