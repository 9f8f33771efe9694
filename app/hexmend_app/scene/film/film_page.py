"""Layout of film frames: captions above, one or two pictures and a histogram next to each other, a colour bar below."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from PIL import Image, ImageDraw

from hexmend_app.picture.appearance import Look
from hexmend_app.scene.film.film_histogram import BarCounts, count_bars, draw_histogram
from hexmend_app.scene.film.frame_parts import INK, colour_bar, letters, strip_height
from hexmend_app.scene.views.viewport import Viewport

#: Width of the histogram, as a fraction of the film width.
_CHART = 0.32

#: Smallest size of letters of a caption, as a fraction of their usual size, before a shorter caption is written.
_SMALLEST_LETTERS = 0.75


@dataclass(frozen=True)
class InitialPicture:
    """Mesh before the run, which all frames show on the left.

    Parameters
    ----------
    captions : sequence of str
        From the longest to the shortest; the first that fits is shown.
    picture : Image
    bars : BarCounts or None
        Its distribution, if the film has a histogram.
    """

    captions: Sequence[str]
    picture: Image.Image
    bars: BarCounts | None


@dataclass(frozen=True)
class FilmPage:
    """Sizes of the parts of a frame, all in pixels.

    Parameters
    ----------
    size : (width, height)
        Size of the whole frame.
    strip : int
        Height of the captions and of the colour bar; 0 if a frame is too small for them.
    bar : bool
        True if there is a colour bar.
    chart_width : int
        Width of the histogram; 0 without one.
    panels : int
        Number of pictures of the mesh: 2 with the mesh before the run.
    """

    size: tuple[int, int]
    strip: int
    bar: bool
    chart_width: int
    panels: int

    @classmethod
    def of(cls, size: tuple[int, int], look: Look, *, chart: bool, before: bool) -> FilmPage:
        """Return the layout of a frame of some size; a film without colours has neither colour bar nor histogram."""
        strip, coloured = strip_height(size), not look.colours.neutral
        chart_width = round(_CHART * size[0]) if chart and strip and coloured else 0
        return cls(size, strip, bool(strip) and coloured, chart_width, 2 if before else 1)

    @property
    def picture_size(self) -> tuple[int, int]:
        """Width and height of one picture of the mesh."""
        width, height = self.size
        return (width - self.chart_width) // self.panels, height - (2 if self.bar else 1) * self.strip

    def compose(
        self, picture: Image.Image, captions: Sequence[str], viewport: Viewport, initial: InitialPicture | None
    ) -> Image.Image:
        """Return a frame: the picture with its caption, the mesh before the run, the histogram and the colour bar.

        The captions are those of the picture, from the longest to the shortest: the first that fits is shown.
        """
        whole = Image.new("RGB", self.size, "white")
        shown = [(initial.picture, initial.captions), (picture, captions)] if initial else [(picture, captions)]
        for column, (image, texts) in enumerate(shown):
            left = column * picture.width
            whole.paste(image, (left, self.strip))
            if self.strip:
                end = self.size[0] if column == len(shown) - 1 else left + picture.width
                self._write(whole, texts, left, end)
        if self.chart_width:
            chart_size = self.chart_width, picture.height
            bars, earlier = self.bars(viewport), initial.bars if initial else None
            chart = draw_histogram(bars, viewport.colouring, chart_size, self.strip / 30, earlier)
            whole.paste(chart, (self.size[0] - self.chart_width, self.strip))
        if self.bar:
            special = viewport.colours.special_counts
            bar = colour_bar(viewport.colouring, special, (self.size[0], self.strip))
            whole.paste(bar, (0, self.size[1] - self.strip))
        return whole

    def _write(self, whole: Image.Image, texts: Sequence[str], left: int, end: int) -> None:
        """Write the first text that fits between two columns of pixels, if need be in smaller letters."""
        draw, size, left = ImageDraw.Draw(whole), 0.42 * self.strip, left + round(0.3 * self.strip)
        shares = [(end - left - 0.1 * self.strip) / draw.textlength(text, letters(size)) for text in texts]
        at = next((i for i, share in enumerate(shares) if share >= _SMALLEST_LETTERS), len(texts) - 1)
        font = letters(size * min(1.0, shares[at]))
        draw.text((left, self.strip / 2), texts[at], INK, font, anchor="lm")

    def bars(self, viewport: Viewport) -> BarCounts | None:
        """Return the counts of the histogram of the mesh shown; None without a histogram."""
        colours = viewport.colours
        return count_bars(colours.values, colours.kinds, viewport.colouring) if self.chart_width else None
