"""Layout of a page: panels, captions and colour bar."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from hexmend.errors import ParameterError
from hexmend_app.picture import Captions, PicturePanel, Scene, TextPlace
from hexmend_app.picture.colours import MATERIAL, colour_quantity
from hexmend_app.picture.displacement import DISPLACEMENT_QUANTITIES
from hexmend_app.scene.colour.colouring import INVALID_COLOURS
from hexmend_app.scene.colour.material_colours import material_names
from hexmend_app.scene.page.lettering import Entry, Lettering
from hexmend_app.scene.page.page_mesh import PageMesh

#: Sizes in font heights: height of captions, gap between panels, height of the strip of a colour bar below, height of a
#: row of swatches, and width of the strip of a colour bar at the right without its numbers.
_CAPTION, _GAP, _STRIP, _ROW, _SIDE = 1.8, 0.6, 3.4, 1.25, 4.2

#: Swatches of invalid hexes, with numbers as long as they may be.
_SPECIAL: list[Entry] = [(f"{special.name} (00,000)", special.colour) for special in INVALID_COLOURS]

#: Minimum width and height of a page with a colour bar, in font heights.
_MIN_SIZE = (24.0, 12.0)

#: Width of a histogram, as a fraction of the page width.
_HISTOGRAM = 0.32

#: Minimum side of a panel, in pixels.
_MIN_PANEL = 16

#: Fraction of the page width above which the title is drawn above the colour bar.
_LONG_TITLE = 0.22


@dataclass(frozen=True)
class Rectangle:
    """Rectangle in pixels from the upper left corner of the page."""

    left: int
    top: int
    width: int
    height: int


@dataclass(frozen=True, eq=False)
class Layout:
    """Positions on a page, in whole pixels.

    Parameters
    ----------
    scene : Scene
    meshes : sequence of PageMesh
    panel : (width, height)
        Size of the picture of each panel.
    size : (width, height)
        Size of the page.
    bar : TextPlace
        Position of the colour bar; NONE if it does not fit.
    captions : bool
        Draw a caption above each panel.
    figures : bool
        Add its figures to the caption of a single mesh too.
    histogram : bool
        Draw a histogram of the coloured values on the right of the panels.
    """

    scene: Scene
    meshes: Sequence[PageMesh]
    panel: tuple[int, int]
    size: tuple[int, int]
    bar: TextPlace
    captions: bool
    figures: bool
    histogram: bool

    @classmethod
    def of(cls, scene: Scene, meshes: Sequence[PageMesh], *, figures: bool = False, histogram: bool = False) -> Layout:
        """Lay out a page; a small one has no colour bar, histogram or captions.

        Parameters
        ----------
        scene : Scene
        meshes : sequence of PageMesh
        figures : bool
            Add its figures to the caption of a single mesh too.
        histogram : bool
            Draw a histogram, if the page has a colour bar.

        Raises
        ------
        ParameterError
            If the panels do not fit.
        """
        width, height = scene.page.size
        letter, panels = Lettering(scene.page).height, scene.panels_of(len(meshes))
        bar_fits = width >= _MIN_SIZE[0] * letter and height >= _MIN_SIZE[1] * letter
        bar = scene.bar.place if bar_fits and not scene.colours.neutral else TextPlace.NONE
        if bar is TextPlace.BELOW and scene.colours.metric == MATERIAL.name:
            bar = TextPlace.RIGHT  # the names of materials need a column
        captions = scene.page.captions is not Captions.NONE and (
            len(panels) > 1 or any(panel.caption or panel.wipe for panel in panels)
        )
        for place, lines in ((bar, captions), (TextPlace.NONE, captions), (TextPlace.NONE, False)):
            with_histogram = histogram and place is not TextPlace.NONE
            layout = cls(scene, meshes, (0, 0), (width, height), place, lines, figures, with_histogram)
            outside = layout.around
            panel = (width - outside[0]) // layout.columns, (height - outside[1]) // layout.rows
            if min(panel) >= _MIN_PANEL:
                return replace(layout, panel=panel)
        raise ParameterError(
            f"the page has {width:,} × {height:,} pixels, too few for {len(panels)} panels: choose a larger page"
        )

    def cropped(self, panel: tuple[int, int]) -> Layout:
        """Return the layout with smaller panels; it stays wide enough for the colour bar."""
        extra = self.around
        width = panel[0] * self.columns + extra[0]
        if self.bar is TextPlace.BELOW:
            width = max(width, min(self.size[0], round(_MIN_SIZE[0] * self.letters.height)))
        return replace(self, panel=panel, size=(width, panel[1] * self.rows + extra[1]))

    @cached_property
    def letters(self) -> Lettering:
        """Lettering of the page."""
        return Lettering(self.scene.page)

    @cached_property
    def panels(self) -> tuple[PicturePanel, ...]:
        """Panels, row by row."""
        return self.scene.panels_of(len(self.meshes))

    @cached_property
    def shown(self) -> set[int]:
        """Numbers of the meshes in the panels."""
        return {panel.mesh for panel in self.panels} | {panel.wipe.mesh for panel in self.panels if panel.wipe}

    @property
    def columns(self) -> int:
        """Number of panels in a row."""
        count = len(self.panels)
        default = count if count <= 3 else int(np.ceil(np.sqrt(count)))
        return min(self.scene.page.columns or default, count)

    @property
    def rows(self) -> int:
        """Number of rows of panels."""
        return -(-len(self.panels) // self.columns)

    @cached_property
    def title(self) -> str:
        """Title of the colour bar."""
        metric, movement = self.scene.colours.metric, self.meshes[0].movement
        if self.scene.bar.title:
            return self.scene.bar.title
        if metric in DISPLACEMENT_QUANTITIES and movement is not None:
            return movement.title(metric)
        return colour_quantity(metric).title

    @cached_property
    def names(self) -> tuple[str, ...]:
        """Names of the materials if the colours show these, else none: a legend takes the place of the colour bar."""
        return material_names(self.meshes[0].mesh) if self.scene.colours.metric == MATERIAL.name else ()

    @property
    def long_title(self) -> bool:
        """True if the title is above the bar instead of next to it."""
        return self.letters.width(self.title) > _LONG_TITLE * self.size[0]

    @property
    def around(self) -> tuple[int, int]:
        """Total width and height of the page outside its panels, in pixels."""
        letter, margin = self.letters.height, 2 * self.scene.page.pixels_of(self.scene.page.margin)
        gap = round(_GAP * letter)
        width = margin + gap * (self.columns - 1) + self.histogram_width
        height = margin + gap * (self.rows - 1) + self.rows * self.caption
        if self.bar is TextPlace.BELOW:
            height += self.strip
        elif self.bar is TextPlace.RIGHT:
            width += self.strip
        return width, height

    @property
    def histogram_width(self) -> int:
        """Width of the histogram in pixels; 0 without one."""
        return round(_HISTOGRAM * self.size[0]) if self.histogram else 0

    @property
    def caption(self) -> int:
        """Height of a caption in pixels."""
        return round(_CAPTION * self.letters.height) if self.captions else 0

    @cached_property
    def strip(self) -> int:
        """Height of the strip of the colour bar below the panels, or its width at the right, in pixels."""
        swatches = 3 if self.scene.colours.metric == "q-change" else len(_SPECIAL)
        if self.bar is TextPlace.RIGHT:
            width = max(_SIDE + self.letters.em("0.0000"), 2 + max(self.letters.em(text) for text, _ in _SPECIAL))
            width = max([width, *(3 + self.letters.em(name) for name in self.names)])
            return round(width * self.letters.height)
        return round(max(_STRIP + 1.4 * self.long_title, _ROW * swatches + 0.8) * self.letters.height)

    def place(self, number: int) -> Rectangle:
        """Return the rectangle of the picture of a panel, by its number from 0."""
        row, column = divmod(number, self.columns)
        margin, gap = self.scene.page.pixels_of(self.scene.page.margin), round(_GAP * self.letters.height)
        indent = (self.size[0] - self.around[0] - self.panel[0] * self.columns) // 2
        left = margin + indent + column * (self.panel[0] + gap)
        return Rectangle(left, margin + row * (self.panel[1] + gap + self.caption) + self.caption, *self.panel)

    @property
    def histogram_place(self) -> Rectangle:
        """Rectangle of the histogram, on the right of the panels."""
        first, last = self.place(0), self.place(len(self.panels) - 1)
        left = first.left + self.columns * first.width + (self.columns - 1) * round(_GAP * self.letters.height)
        return Rectangle(left, first.top, self.histogram_width, last.top + last.height - first.top)

    @property
    def bar_place(self) -> Rectangle:
        """Rectangle of the strip of the colour bar."""
        margin, (width, height) = self.scene.page.pixels_of(self.scene.page.margin), self.size
        if self.bar is TextPlace.RIGHT:
            return Rectangle(width - margin - self.strip, margin, self.strip, height - 2 * margin)
        return Rectangle(margin, height - margin - self.strip, width - 2 * margin, self.strip)
