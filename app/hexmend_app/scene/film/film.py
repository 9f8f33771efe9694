"""Films of a run: the mesh at its iterations, with figures."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path

import numpy as np
from PIL import Image, ImageDraw
from vtkmodules.vtkRenderingCore import vtkCamera

from hexmend.boundary.displacement import Displacement, ReferenceState
from hexmend.io.storage.atomic import atomic_write
from hexmend.io.storage.suffixes import suffix_for
from hexmend_app.picture.appearance import Look, Since
from hexmend_app.scene.film.film_frames import FilmFrame
from hexmend_app.scene.film.film_histogram import histogram
from hexmend_app.scene.film.frame_parts import INK, colour_bar, letters, paper, pixel_ratio_of, strip_height
from hexmend_app.scene.film.movie import check_installed, write_movie
from hexmend_app.scene.render.colour_count import count_colours
from hexmend_app.scene.render.stage import Stage
from hexmend_app.scene.views.frame import Frame
from hexmend_app.scene.views.pane import Pane
from hexmend_app.scene.views.viewport import Viewport

#: What can be written, by suffix: all are shown by browsers.
FORMATS = {".mp4": "MP4", ".gif": "GIF", ".png": "PNG", ".webp": "WEBP"}

#: Colours of a GIF, shared by all its frames: what a map, an edge and a shade need, and the colour bar, which would
#: have bands if it had to do with those.
_COLOURS, _BAR, _AXES = 116, 120, 16

#: Share of the width that a histogram has.
_CHART = 0.32

#: How long the first and the last frame stand, in frames.
_STAND = 8


def pictures(
    shots: Iterable[FilmFrame],
    look: Look,
    size: tuple[int, int],
    *,
    view: str | tuple[float, float, float] = "iso",
    camera: vtkCamera | None = None,
    movement: Displacement | None = None,
    chart: bool = False,
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
    movement : Displacement, optional
        Of the moment that every picture is compared with, where the look shows a movement; one since the iteration
        before is since the picture before.
    chart : bool
        Draw a histogram of the coloured values.
    """
    width, height = size
    strip = strip_height(size)
    chart = chart and strip > 0 and not look.neutral
    aside = round(_CHART * width) if chart else 0
    with Stage((width - aside, height - (1 if look.neutral else 2) * strip)) as stage:
        viewport = Viewport(Pane(stage.window), pixel_ratio=pixel_ratio_of(size))
        seen_last: ReferenceState | None = None
        for shot in shots:
            mesh, figures = shot.state.mesh, shot.state.figures
            if movement is not None:
                before = seen_last if look.traces.since is Since.ITERATION else movement.before
                now = ReferenceState(mesh.points, figures, "the picture before")
                movement = Displacement(movement.mesh, before or now, mesh.points, figures)
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


def _framed(seen: Image.Image, shot: FilmFrame, viewport: Viewport, size: tuple[int, int], strip: int) -> Image.Image:
    """Add a caption above, a colour bar below if there are colours, and a histogram if there is space."""
    whole = paper(size, seen.mode)
    whole.paste(seen, (0, strip))
    aside = size[0] - seen.width
    if aside:
        colours = viewport.colours
        neighbour = histogram(
            colours.values, colours.kinds, viewport.colouring, (aside, seen.height), strip / 30, seen.mode
        )
        whole.paste(neighbour, (seen.width, strip))
    if strip:
        at = (round(0.3 * strip), strip / 2)
        ImageDraw.Draw(whole).text(at, shot.caption, INK, letters(0.42 * strip), anchor="lm")
    if strip and not viewport.frame.look.neutral:
        bar = colour_bar(viewport.colouring, viewport.colours.special_counts, (size[0], strip), seen.mode)
        whole.paste(bar, (0, size[1] - strip))
    return whole


def write_film(path: Path, frames: Sequence[Image.Image], rate: float) -> None:
    """Write frames as MP4, or as a repeating GIF, PNG or WebP; the first and the last are shown longer.

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
    lengths = [1] * len(frames)
    lengths[0] = lengths[-1] = _STAND
    if format == "GIF":
        frames = _with_one_palette(frames)
    with atomic_write(path) as temporary:
        if format == "MP4":
            write_movie(temporary, frames, lengths, rate)
            return
        first, *others = frames
        first.save(
            temporary, format=format, save_all=True, append_images=others,
            duration=[round(1000 / rate) * one for one in lengths],
            loop=0, optimize=True,
        )  # fmt: skip


def format_of(path: Path) -> str:
    """Return the format of a path by its suffix.

    Raises
    ------
    FileError
        For another suffix, or where what writes it is not installed.
    """
    format = FORMATS[suffix_for(path, "a film", FORMATS)]
    if format == "MP4":
        check_installed(path)
    return format


def _with_one_palette(frames: Sequence[Image.Image]) -> list[Image.Image]:
    """Reduce all frames to one palette, so that unchanged areas take no space."""
    some = [np.asarray(frames[k].convert("RGB")) for k in (0, len(frames) // 2, -1)]
    strip = strip_height(frames[0].size)
    table = _colours([one[: len(one) - strip] for one in some], _COLOURS)
    if strip:
        table += _along(some[-1][-strip:][strip // 4])
        low, corner = len(some[-1]) - strip, 3 * strip
        table += _colours([some[-1][low - corner : low, :corner]], _AXES)
    return [_by_palette(one, table) for one in frames]


def _by_palette(frame: Image.Image, table: Sequence[tuple[int, ...]]) -> Image.Image:
    """Map a frame to the nearest colours of a table; Pillow's search confuses neighbours in a gradient."""
    from scipy.spatial import KDTree

    pixels = np.asarray(frame.convert("RGB")).astype(np.uint32)
    packed, where = np.unique(pixels[..., 0] << 16 | pixels[..., 1] << 8 | pixels[..., 2], return_inverse=True)
    unpacked = np.stack([packed >> 16, packed >> 8 & 255, packed & 255], axis=1)
    _, nearest = KDTree(np.array(table)).query(unpacked)
    answer = Image.fromarray(nearest.astype(np.uint8)[where].reshape(pixels.shape[:2]), "P")
    answer.putpalette([part for colour in table for part in colour])
    return answer


def _colours(parts: Sequence[np.ndarray], most: int) -> list[tuple[int, ...]]:
    """Return at most `most` colours that represent those of pictures (h, w, 3) best."""
    colours, counts = count_colours(np.concatenate([part.reshape(-1, 3) for part in parts]))
    # By the root of how often they are seen: or the ground would leave no colours to the mesh.
    weighted = np.repeat(colours, np.ceil(np.sqrt(counts)).astype(int), axis=0)
    chosen = Image.fromarray(weighted[None]).quantize(most, method=Image.Quantize.MEDIANCUT).convert("RGB")
    return [tuple(one) for one in count_colours(np.asarray(chosen))[0].tolist()]


def _along(line: np.ndarray) -> list[tuple[int, ...]]:
    """Sample the colours along a line of pixels (w, 3), such as a colour bar with swatches."""
    through = Counter(map(tuple, line.tolist()))
    order = list(through)
    steps = [order[round(at)] for at in np.linspace(0, len(order) - 1, min(_BAR, len(order)))]
    return list(dict.fromkeys([*steps, *(colour for colour, count in through.most_common(4))]))
