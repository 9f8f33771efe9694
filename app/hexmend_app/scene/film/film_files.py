"""Files of films: MP4, and animated GIF, PNG and WebP."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from importlib.util import find_spec
from pathlib import Path

import numpy as np
from PIL import Image

from hexmend.errors import FileError
from hexmend.io.storage.atomic import atomic_write
from hexmend.io.storage.suffixes import suffix_for
from hexmend.terminal_text import install_hint
from hexmend_app.scene.colour.colouring import INVALID_COLOURS

#: Film formats by suffix; browsers show all of them.
FORMATS = {".mp4": "MP4", ".gif": "GIF", ".png": "PNG", ".webp": "WEBP"}

#: Duration of the first and the last frame, in frames.
_PAUSE = 8

#: Constant rate factor of x264; 18 is visually almost lossless.
_QUALITY = "18"

#: Code of the colour space that players assume (ITU-T H.273): BT.709, as in HDTV.
_BT709 = 1


def write_film(path: Path, frames: Sequence[Image.Image], rate: float, *, poster: bool = False) -> None:
    """Write frames as MP4, or as a repeating GIF, PNG or WebP; the first and the last are shown longer.

    Parameters
    ----------
    path : Path
    frames : sequence of Image
        At least one frame.
    rate : float
        Frames per second.
    poster : bool
        Begin with the last frame for a moment: it is what programs show that do not play the film.

    Raises
    ------
    FileError
        For a suffix that is not in `FORMATS`, or if the file cannot be written.
    """
    format = format_of(path)
    lengths = [1] * len(frames)
    lengths[0] = lengths[-1] = _PAUSE
    if format == "GIF":
        frames = _with_one_palette(frames)
    if poster:
        frames, lengths = [frames[-1], *frames], [1, *lengths]
    with atomic_write(path) as temporary:
        if format == "MP4":
            write_movie(temporary, frames, lengths, rate)
            return
        first, *others = frames
        first.save(
            temporary, format=format, save_all=True, append_images=others,
            duration=[round(1000 / rate) * length for length in lengths],
            loop=0, optimize=True,
        )  # fmt: skip


def format_of(path: Path) -> str:
    """Return the format of a path by its suffix.

    Raises
    ------
    FileError
        For another suffix, or if the library for the format is not installed.
    """
    format = FORMATS[suffix_for(path, "a film", FORMATS)]
    if format == "MP4":
        check_installed(path)
    return format


def _with_one_palette(frames: Sequence[Image.Image]) -> list[Image.Image]:
    """Reduce all frames to a common palette that has those of invalid hexes; unchanged areas take no space."""
    sample = np.concatenate([np.asarray(frames[k].convert("RGB")) for k in (0, len(frames) // 2, -1)])
    special = [special.colour for special in INVALID_COLOURS]
    palette = Image.fromarray(sample).quantize(256 - len(special), method=Image.Quantize.MAXCOVERAGE, kmeans=1)
    palette.putpalette([*palette.getpalette(), *(part for colour in special for part in colour)])
    return [frame.convert("RGB").quantize(palette=palette, dither=Image.Dither.NONE) for frame in frames]


def check_installed(path: Path) -> None:
    """Raise `FileError` if PyAV is missing."""
    if find_spec("av") is None:
        raise FileError(
            path,
            "a film cannot be written as .mp4 without PyAV",
            f"For .mp4 {install_hint('film')} (its FFmpeg is under the GPL, hence no part of [app]), or use .gif, "
            ".webp or .png.",
        )


def write_movie(path: Path, frames: Sequence[Image.Image], lengths: Sequence[int], rate: float) -> None:
    """Write frames as MP4; a side of odd length is padded by a white pixel, as H.264 requires.

    Parameters
    ----------
    path : Path
        Path of a temporary file; the caller replaces an existing file atomically.
    frames : sequence of Image
    lengths : sequence of int
        Duration of each frame, in frames.
    rate : float
        Frames per second.
    """
    import av

    width, height = (side + side % 2 for side in frames[0].size)
    with av.open(str(path), "w", format="mp4", options={"movflags": "+faststart"}) as container:
        stream = container.add_stream("libx264", rate=Fraction(rate).limit_denominator(1000))
        stream.width, stream.height, stream.pix_fmt = width, height, "yuv420p"
        stream.options = {"crf": _QUALITY, "preset": "medium"}
        codec = stream.codec_context
        codec.colorspace = codec.color_primaries = codec.color_trc = codec.color_range = _BT709
        for image, length in zip(frames, lengths, strict=True):
            whole = Image.new("RGB", (width, height), "white")
            whole.paste(image.convert("RGB"), (0, 0))
            for _ in range(length):
                frame = av.VideoFrame.from_image(whole)
                frame = frame.reformat(format="yuv420p", dst_colorspace="ITU709", dst_color_range="MPEG")
                container.mux(stream.encode(frame))
        container.mux(stream.encode())
