"""Films as MP4 (H.264), which presentation programs play, written with PyAV."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from importlib.util import find_spec
from pathlib import Path

from PIL import Image

from hexmend.errors import FileError
from hexmend.terminal_text import install_hint

#: Constant rate factor of x264; 18 is visually almost lossless.
_QUALITY = "18"

#: Code of the colour space that players assume (ITU-T H.273): BT.709, as in HDTV.
_BT709 = 1


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
