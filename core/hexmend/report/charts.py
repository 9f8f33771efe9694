"""Charts as files: how large they are, with what letters, and what is called what."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field
from importlib import import_module
from io import BytesIO
from pathlib import Path
from typing import TYPE_CHECKING, Protocol

from hexmend.errors import HexmendError, ParameterError
from hexmend.io.storage.atomic import atomic_write
from hexmend.io.storage.suffixes import suffix_for
from hexmend.parameters import Parametrised, parameter
from hexmend.terminal_text import printable

if TYPE_CHECKING:
    from collections.abc import Iterator

    from matplotlib.artist import Artist
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

MM_PER_INCH = 25.4

#: Kinds of figure that can be written.
FIGURE_SUFFIXES = (".svg", ".pdf", ".png")

#: Widths in mm that a figure can have: from less than a column to a poster.
WIDTHS = (40.0, 1000.0)

#: Pixels of the largest picture.
_MOST_PIXELS = 2**26


@dataclass(frozen=True)
class ChartStyle(Parametrised):
    """What a chart is like on paper, and what is called what in it.

    Parameters
    ----------
    width, height : float
        In mm; a height of 0 is the chart's own for its width.
    letters : float
        In pt.
    resolution : float
        Of PNG, in pixels per inch.
    title : str, optional
        Instead of the chart's own.
    names : mapping of str to str
        What curves are called, by what they call themselves.

    Raises
    ------
    ParameterError
        For a value out of range, and for a picture of too many pixels.
    """

    width: float = parameter(170.0, low=WIDTHS[0], high=WIDTHS[1], unit="mm", help="Of the whole figure.")
    height: float = parameter(0.0, low=0, high=1000, unit="mm", help="Of the whole figure; 0 as its width suits.")
    letters: float = parameter(8.0, low=4, high=40, unit="pt", help="The size of all that is written.")
    resolution: float = parameter(300.0, low=50, high=1200, unit="dpi", help="Pixels per inch of a PNG.")
    title: str | None = None
    names: Mapping[str, str] = field(default_factory=dict)

    def __post_init__(self) -> None:
        super().__post_init__()
        if 0 < self.height < 20:
            raise ParameterError(f"height = {self.height:g} is too low: expected 0, or at least 20 mm")
        self._check_pixels(self.height or self.width)

    def _check_pixels(self, height: float) -> None:
        share = self.resolution / MM_PER_INCH
        if self.width * share * height * share > _MOST_PIXELS:
            raise ParameterError(
                f"{self.width:g} × {height:g} mm at {self.resolution:g} dpi are too many pixels: "
                f"expected at most {_MOST_PIXELS:,}"
            )

    def name(self, own: str) -> str:
        """What is written for a curve: plain text, whatever is in it."""
        return plain(self.names.get(own) or own)

    def heading(self, own: str) -> str:
        """What is written above the chart."""
        return plain(own if self.title is None else self.title)

    def figure(self, shape: float) -> Figure:
        """An empty figure of this size; `shape` is its height by its width where it has none of its own.

        Raises
        ------
        HexmendError
            Where matplotlib is missing, and where it has too many pixels.
        """
        height = self.height or shape * self.width
        self._check_pixels(height)
        return new_figure(self.width / MM_PER_INCH, height / MM_PER_INCH)


class Chart(Protocol):
    """What is drawn in a style: its own title, and what its curves call themselves, each once."""

    title: str

    @property
    def names(self) -> list[str]:
        """Of its curves."""

    def draw(self, style: ChartStyle) -> Figure:
        """The figure."""


#: Draws a chart.
Draw = Callable[[ChartStyle], "Figure"]


def write_chart(path: Path, draw: Draw, style: ChartStyle | None = None) -> None:
    """Write a chart, as SVG, PDF or PNG by the path's suffix, as a whole or not at all.

    Raises
    ------
    HexmendError
        For another suffix, and where matplotlib is missing or the file cannot be written.
    """
    check_figure(path)
    style = ChartStyle() if style is None else style
    with _written(style):
        save_figure(draw(style), path, style.resolution)


def chart_png(draw: Draw, style: ChartStyle, dpi: float) -> bytes:
    """A chart as the bytes of a PNG of so many pixels per inch.

    Raises
    ------
    HexmendError
        Where matplotlib is missing.
    """
    into = BytesIO()
    with _written(style):
        draw(style).savefig(into, dpi=dpi, format="png")
    return into.getvalue()


def add_legend(axes: Axes, named: Sequence[tuple[Artist, str]]) -> None:
    """Say on the right of a chart what is what, whatever letter a name begins with."""
    if not named:
        return
    artists, names = zip(*named, strict=True)
    places = [str(place) for place in range(len(names))]  # a label with "_" before it would be left out
    legend = axes.legend(artists, places, loc="upper left", bbox_to_anchor=(1.0, 1.0), frameon=False, fontsize="small")
    for text, name in zip(legend.get_texts(), names, strict=True):
        text.set_text(name)


@contextmanager
def _written(style: ChartStyle) -> Iterator[None]:
    """Letters of the style's size."""
    check_matplotlib()
    from matplotlib import rc_context

    with rc_context({"font.size": style.letters}):
        yield


def plain(text: str) -> str:
    """A text in which matplotlib finds no formula, and nothing that it or SVG cannot hold: names come from files."""
    return printable(text).replace("$", r"\$")


def check_figure(path: Path) -> None:
    """Raise `FileError` for a suffix that no figure has."""
    suffix_for(path, "a figure", FIGURE_SUFFIXES)


def check_matplotlib() -> None:
    """Raise `HexmendError` where matplotlib is missing."""
    try:
        import_module("matplotlib.figure")
    except ImportError:
        raise HexmendError(
            "figures need matplotlib, which is not installed: run  pip install 'hexmend[report]'"
        ) from None


def new_figure(width: float, height: float) -> Figure:
    """An empty figure of so many inches.

    Raises
    ------
    HexmendError
        Where matplotlib is missing.
    """
    check_matplotlib()
    from matplotlib.figure import Figure

    return Figure(figsize=(width, height), layout="constrained")


def save_figure(figure: Figure, path: Path, dpi: float = 160, *, outlines: bool = False) -> None:
    """Write a figure as a whole or not at all, as its path's suffix says; equal figures make equal files.

    Texts of an SVG stay texts, which can be found and edited, or are `outlines`, which look the same everywhere.
    """
    from matplotlib import rc_context

    kind = path.suffix.lower()[1:]
    dates = {"svg": {"Date": None}, "pdf": {"CreationDate": None}}
    how = {"svg.hashsalt": "hexmend", "svg.fonttype": "path" if outlines else "none"}
    with atomic_write(path) as temporary, rc_context(how):  # names that are not drawn by lot, and no date
        figure.savefig(temporary, dpi=dpi, format=kind, metadata=dates.get(kind))
