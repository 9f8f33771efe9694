"""Layout of a page: panels, captions and colour bar."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from hexmend.boundary.displacement import DISPLACEMENT_QUANTITIES, hex_quantity
from hexmend.errors import ParameterError
from hexmend_app.picture import Captions, PicturePanel, Scene, TextPlace
from hexmend_app.scene.page.lettering import Lettering
from hexmend_app.scene.page.page_mesh import PageMesh

#: In heights of a letter: of captions, between panels, of a strip with the colour bar below, of a row of swatches, and
#: of the strip at the right without its numbers.
_CAPTION, _GAP, _STRIP, _ROW, _SIDE = 1.8, 0.6, 3.4, 1.25, 4.2

#: Width and height in letters below which a page has no room for the colour bar.
_SPACE = (24.0, 12.0)

#: Pixels that a panel has at least.
_LEAST = 16

#: The share of the bar's strip beyond which its title stands above it.
_LONG_TITLE = 0.22


@dataclass(frozen=True)
class Rectangle:
    """A rectangle in pixels from the upper left corner of the page."""

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
    subjects : sequence of Subject
    panel : (width, height)
        Of each panel's picture.
    size : (width, height)
        Of the page.
    bar : Place
        Position of the colour bar; none if it does not fit.
    captions : bool
        Draw a caption above each panel.
    """

    scene: Scene
    subjects: Sequence[PageMesh]
    panel: tuple[int, int]
    size: tuple[int, int]
    bar: TextPlace
    captions: bool

    @classmethod
    def of(cls, scene: Scene, subjects: Sequence[PageMesh]) -> Layout:
        """Lay out a page; a small one has no colour bar or captions.

        Raises
        ------
        ParameterError
            If the panels do not fit.
        """
        width, height = scene.page.size
        letter, panels = Lettering(scene.page).height, scene.panels_of(len(subjects))
        space = width >= _SPACE[0] * letter and height >= _SPACE[1] * letter
        bar = TextPlace.NONE if scene.colours.neutral or not space else scene.bar.place
        captions = scene.page.captions is not Captions.NONE and (
            len(panels) > 1 or any(panel.caption or panel.wipe for panel in panels)
        )
        for place, lines in ((bar, captions), (TextPlace.NONE, captions), (TextPlace.NONE, False)):
            layout = cls(scene, subjects, (0, 0), (width, height), place, lines)
            around = layout.around
            panel = (width - around[0]) // layout.columns, (height - around[1]) // layout.rows
            if min(panel) >= _LEAST:
                return replace(layout, panel=panel)
        raise ParameterError(
            f"the page has {width:,} × {height:,} pixels, too few for {len(panels)} panels: choose a larger page"
        )

    def cropped(self, panel: tuple[int, int]) -> Layout:
        """Return the layout with smaller panels; it stays wide enough for the colour bar."""
        extra = self.around
        width = panel[0] * self.columns + extra[0]
        if self.bar is TextPlace.BELOW:
            width = max(width, min(self.size[0], round(_SPACE[0] * self.letters.height)))
        return replace(self, panel=panel, size=(width, panel[1] * self.rows + extra[1]))

    @cached_property
    def letters(self) -> Lettering:
        """The lettering."""
        return Lettering(self.scene.page)

    @cached_property
    def panels(self) -> tuple[PicturePanel, ...]:
        """The panels, row by row."""
        return self.scene.panels_of(len(self.subjects))

    @property
    def columns(self) -> int:
        """Panels in a row."""
        count = len(self.panels)
        few = count if count <= 3 else int(np.ceil(np.sqrt(count)))
        return min(self.scene.page.columns or few, count)

    @property
    def rows(self) -> int:
        """Rows of panels."""
        return -(-len(self.panels) // self.columns)

    @cached_property
    def title(self) -> str:
        """Title of the colour bar."""
        metric, movement = self.scene.colours.metric, self.subjects[0].movement
        known = (
            movement.title(metric)
            if metric in DISPLACEMENT_QUANTITIES and movement is not None
            else hex_quantity(metric).title
        )
        return self.scene.bar.title or known

    @property
    def long_title(self) -> bool:
        """True if the title is above the bar instead of next to it."""
        return self.letters.width(self.title) > _LONG_TITLE * self.size[0]

    @property
    def around(self) -> tuple[int, int]:
        """Width and height of the page outside panels, in pixels."""
        letter, margin = self.letters.height, 2 * self.scene.page.pixels_of(self.scene.page.margin)
        gap = round(_GAP * letter)
        wide, high = margin + gap * (self.columns - 1), margin + gap * (self.rows - 1) + self.rows * self.caption
        if self.bar is TextPlace.BELOW:
            high += self.strip
        elif self.bar is TextPlace.RIGHT:
            wide += self.strip
        return wide, high

    @property
    def caption(self) -> int:
        """Height of a line above a panel."""
        return round(_CAPTION * self.letters.height) if self.captions else 0

    @cached_property
    def strip(self) -> int:
        """Height of the colour bar's strip below, or its width at the right."""
        swatches = 3 if self.scene.colours.metric == "q-change" else 1
        if self.bar is TextPlace.RIGHT:
            wide = max(_SIDE + self.letters.em("0.0000"), 2 + self.letters.em("inverted (00,000)"))
            return round(wide * self.letters.height)
        return round(max(_STRIP + 1.4 * self.long_title, _ROW * swatches + 0.8) * self.letters.height)

    def place(self, number: int) -> Rectangle:
        """Return the rectangle of a panel's picture, by its number from 0."""
        row, column = divmod(number, self.columns)
        margin, gap = self.scene.page.pixels_of(self.scene.page.margin), round(_GAP * self.letters.height)
        aside = (self.size[0] - self.around[0] - self.panel[0] * self.columns) // 2
        left = margin + aside + column * (self.panel[0] + gap)
        return Rectangle(left, margin + row * (self.panel[1] + gap + self.caption) + self.caption, *self.panel)

    @property
    def bar_place(self) -> Rectangle:
        """Rectangle of the colour bar."""
        margin, (width, height) = self.scene.page.pixels_of(self.scene.page.margin), self.size
        if self.bar is TextPlace.RIGHT:
            return Rectangle(width - margin - self.strip, margin, self.strip, height - 2 * margin)
        return Rectangle(margin, height - margin - self.strip, width - 2 * margin, self.strip)
