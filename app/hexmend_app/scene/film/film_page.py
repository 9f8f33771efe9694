"""Layout of film frames: captions above, one or two pictures and a histogram next to each other, a colour bar below."""

from __future__ import annotations

from dataclasses import dataclass

from PIL import Image, ImageDraw

from hexmend_app.picture.appearance import Look
from hexmend_app.scene.film.film_histogram import BarCounts, count_bars, draw_histogram
from hexmend_app.scene.film.frame_parts import INK, colour_bar, letters, paper, strip_height
from hexmend_app.scene.views.viewport import Viewport

#: Width of the histogram, as a fraction of the film width.
_CHART = 0.32


@dataclass(frozen=True)
class InitialPicture:
    """Mesh before the run, which all frames show on the left.

    Parameters
    ----------
    caption : str
    picture : Image
    bars : BarCounts or None
        Its distribution, if the film has a histogram.
    """

    caption: str
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
        self, picture: Image.Image, caption: str, viewport: Viewport, initial: InitialPicture | None
    ) -> Image.Image:
        """Return a frame: the picture with its caption, the mesh before the run, the histogram and the colour bar."""
        whole = paper(self.size, picture.mode)
        shown = [(initial.picture, initial.caption), (picture, caption)] if initial else [(picture, caption)]
        for column, (image, text) in enumerate(shown):
            left = column * picture.width
            whole.paste(image, (left, self.strip))
            if self.strip:
                position = (left + round(0.3 * self.strip), self.strip / 2)
                ImageDraw.Draw(whole).text(position, text, INK, letters(0.42 * self.strip), anchor="lm")
        if self.chart_width:
            chart_size = self.chart_width, picture.height
            bars, earlier = self.bars(viewport), initial.bars if initial else None
            chart = draw_histogram(bars, viewport.colouring, chart_size, self.strip / 30, picture.mode, earlier)
            whole.paste(chart, (self.size[0] - self.chart_width, self.strip))
        if self.bar:
            special = viewport.colours.special_counts
            bar = colour_bar(viewport.colouring, special, (self.size[0], self.strip), picture.mode)
            whole.paste(bar, (0, self.size[1] - self.strip))
        return whole

    def bars(self, viewport: Viewport) -> BarCounts | None:
        """Return the counts of the histogram of the mesh shown; None without a histogram."""
        colours = viewport.colours
        return count_bars(colours.values, colours.kinds, viewport.colouring) if self.chart_width else None
