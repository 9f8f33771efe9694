"""Charts as files: size, font, titles and names."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field
from importlib import import_module
from io import BytesIO
from pathlib import Path
from typing import TYPE_CHECKING

from hexmend.errors import HexmendError, ParameterError
from hexmend.io.storage.atomic import atomic_write
from hexmend.io.storage.suffixes import suffix_for
from hexmend.parameters import Parametrised, parameter
from hexmend.terminal_text import install_hint, printable

if TYPE_CHECKING:
    from collections.abc import Iterator

    from matplotlib.artist import Artist
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

MM_PER_INCH = 25.4

#: Suffixes of figures that can be written.
FIGURE_SUFFIXES = (".svg", ".pdf", ".png")

#: Least and largest width of a figure in mm.
WIDTHS = (40.0, 1000.0)

#: The colours of Okabe and Ito, which colour-blind readers can distinguish.
COLOURS = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#000000")

#: Pixels of the largest picture.
_MAX_PIXELS = 2**26


@dataclass(frozen=True)
class ChartStyle(Parametrised):
    """Size, font, title and names of a chart.

    Parameters
    ----------
    width, height : float
        In mm; a height of 0 is chosen by the chart for its width.
    letters : float
        Font size in pt.
    resolution : float
        Pixels per inch of a PNG.
    title : str, optional
        Title in place of the chart's own.
    names : mapping of str to str
        Names to be printed, by the labels of the curves.

    Raises
    ------
    ParameterError
        For a value out of range, and for a picture of too many pixels.
    """

    width: float = parameter(170.0, low=WIDTHS[0], high=WIDTHS[1], unit="mm", help="Width of the whole figure.")
    height: float = parameter(
        0.0, low=0, high=1000, unit="mm", help="Height of the whole figure; 0: to suit the width."
    )
    letters: float = parameter(8.0, low=4, high=40, unit="pt", label="Font size", help="Size of all texts.")
    resolution: float = parameter(300.0, low=50, high=1200, unit="dpi", help="Pixels per inch of a PNG file.")
    title: str | None = None
    names: Mapping[str, str] = field(default_factory=dict)

    def __post_init__(self) -> None:
        super().__post_init__()
        if 0 < self.height < 20:
            raise ParameterError(f"height = {self.height:g} is too low: expected 0, or at least 20 mm")
        self._check_pixels(self.height or self.width)

    def _check_pixels(self, height: float) -> None:
        share = self.resolution / MM_PER_INCH
        if self.width * share * height * share > _MAX_PIXELS:
            raise ParameterError(
                f"{self.width:g} × {height:g} mm at {self.resolution:g} dpi are too many pixels: "
                f"expected at most {_MAX_PIXELS:,}"
            )

    def name(self, own: str) -> str:
        """Return the name to be printed for a curve, as plain text."""
        return plain_text(self.names.get(own) or own)

    def heading(self, own: str) -> str:
        """Return the title to be printed, as plain text."""
        return plain_text(own if self.title is None else self.title)

    def figure(self, shape: float) -> Figure:
        """Make an empty figure of this size; `shape` is height over width, used if the height is 0.

        Raises
        ------
        HexmendError
            If matplotlib is not installed, or the figure would have too many pixels.
        """
        height = self.height or shape * self.width
        self._check_pixels(height)
        return new_figure(self.width / MM_PER_INCH, height / MM_PER_INCH)


#: Draws a chart.
Draw = Callable[[ChartStyle], "Figure"]


def write_chart(path: Path, draw: Draw, style: ChartStyle | None = None) -> None:
    """Write a chart as SVG, PDF or PNG, by the path's suffix.

    Raises
    ------
    HexmendError
        For another suffix, and if matplotlib is not installed or the file cannot be written.
    """
    suffix_for(path, "a figure", FIGURE_SUFFIXES)
    style = ChartStyle() if style is None else style
    with _font_size(style):
        save_figure(draw(style), path, style.resolution)


def chart_png(draw: Draw, style: ChartStyle, dpi: float) -> bytes:
    """Return a chart as the bytes of a PNG with `dpi` pixels per inch.

    Raises
    ------
    HexmendError
        If matplotlib is not installed.
    """
    into = BytesIO()
    with _font_size(style):
        draw(style).savefig(into, dpi=dpi, format="png")
    return into.getvalue()


def add_legend(axes: Axes, named: Sequence[tuple[Artist, str]]) -> None:
    """Add a legend on the right of a chart."""
    if not named:
        return
    artists, names = zip(*named, strict=True)
    places = [str(place) for place in range(len(names))]  # matplotlib leaves out labels that begin with "_"
    legend = axes.legend(artists, places, loc="upper left", bbox_to_anchor=(1.0, 1.0), frameon=False, fontsize="small")
    for text, name in zip(legend.get_texts(), names, strict=True):
        text.set_text(name)


@contextmanager
def _font_size(style: ChartStyle) -> Iterator[None]:
    """Set the style's font size within the block."""
    check_matplotlib()
    from matplotlib import rc_context

    with rc_context({"font.size": style.letters}):
        yield


def plain_text(text: str) -> str:
    """Escape a text from outside, so that matplotlib finds no formula in it and SVG no control characters."""
    return printable(text).replace("$", r"\$")


def check_matplotlib() -> None:
    """Raise `HexmendError` if matplotlib is not installed."""
    try:
        import_module("matplotlib.figure")
    except ImportError:
        raise HexmendError(f"figures need matplotlib, which is not installed: {install_hint('app')}") from None


def new_figure(width: float, height: float) -> Figure:
    """Make an empty figure of this width and height in inches.

    Raises
    ------
    HexmendError
        If matplotlib is not installed.
    """
    check_matplotlib()
    from matplotlib.figure import Figure

    return Figure(figsize=(width, height), layout="constrained")


def save_figure(figure: Figure, path: Path, dpi: float = 160, *, outlines: bool = False) -> None:
    """Write a figure in the format of the path's suffix; equal figures give equal files.

    Parameters
    ----------
    figure : matplotlib.figure.Figure
    path : Path
    dpi : float
        Pixels per inch of a PNG.
    outlines : bool
        Write the texts of an SVG as outlines, which look the same everywhere, and not as text that can be edited.
    """
    from matplotlib import rc_context

    kind = path.suffix.lower()[1:]
    dates = {"svg": {"Date": None}, "pdf": {"CreationDate": None}}
    fonts = "path" if outlines else "none"
    # no random ids and no dates
    with atomic_write(path) as temporary, rc_context({"svg.hashsalt": "hexmend", "svg.fonttype": fonts}):
        figure.savefig(temporary, dpi=dpi, format=kind, metadata=dates.get(kind))
