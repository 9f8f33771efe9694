"""Colour bar of a page: gradient, ticks, title, and swatches of special colours; or the names of materials."""

from __future__ import annotations

from collections.abc import Sequence

from hexmend_app.picture import TextPlace
from hexmend_app.scene.page.drawing import Drawing
from hexmend_app.scene.page.layout import Layout, Rectangle
from hexmend_app.scene.page.lettering import Entry, name_entries
from hexmend_app.scene.page.rasters import Rasters

#: Sizes in font heights: gradient, tick, padding at the sides, gap between texts, swatch.
_THICK, _TICK, _PAD, _GAP, _SWATCH = 1.0, 0.25, 0.8, 0.6, 0.9

#: Height of a digit and distance of rows of swatches, in font heights.
_DIGIT, _ROW = 0.73, 1.25


def draw_bar(drawing: Drawing, layout: Layout, drawn: Rasters) -> None:
    """Draw the colour bar at its position in the layout."""
    if layout.names and layout.bar is not TextPlace.NONE:
        _draw_names(drawing, layout, drawn)
    elif layout.bar is TextPlace.BELOW:
        _draw_below(drawing, layout, drawn)
    elif layout.bar is TextPlace.RIGHT:
        _draw_right(drawing, layout, drawn)


def _draw_below(drawing: Drawing, layout: Layout, drawn: Rasters) -> None:
    letter, box, colouring = drawing.letters.height, layout.bar_place, drawn.colouring
    swatches = drawn.special_colours
    swatch_width = max(drawing.letters.width(text) for text, _ in swatches) + (_SWATCH + 0.4) * letter
    left, right = box.left + _PAD * letter, box.left + box.width - _PAD * letter - swatch_width - 2 * _GAP * letter
    top = box.top + 0.5 * letter
    if layout.long_title:
        drawing.text(left, top + letter / 2, layout.title)
        top += 1.4 * letter
    else:
        drawing.text(left, top + _THICK * letter / 2, layout.title)
        left += drawing.letters.width(layout.title) + _GAP * letter
    ends = drawing.letters.width(colouring.label(colouring.low)), drawing.letters.width(colouring.label(colouring.high))
    left, right = left + ends[0] / 2, right - ends[1] / 2
    bar = Rectangle(round(left), round(top), max(round(right - left), 1), round(_THICK * letter))
    drawing.image(colouring.table[None], bar)
    below = bar.top + bar.height
    space = (max(ends) + letter) / bar.width
    for value in colouring.ticks(space, layout.scene.bar.ticks):
        x = bar.left + bar.width * (value - colouring.low) / (colouring.high - colouring.low)
        drawing.lines((x, below, x, below + _TICK * letter))
        drawing.text(x, below + (_TICK + 0.25 + _DIGIT / 2) * letter, colouring.label(value), anchor="mm")
    side = box.left + box.width - _PAD * letter - swatch_width
    first = top + _THICK * letter / 2
    if len(swatches) > 1:
        first = box.top + (box.height - _ROW * letter * (len(swatches) - 1)) / 2
    _draw_column(drawing, swatches, side, first)


def _draw_right(drawing: Drawing, layout: Layout, drawn: Rasters) -> None:
    letter, box, colouring = drawing.letters.height, layout.bar_place, drawn.colouring
    swatches = drawn.special_colours
    left = box.left + _PAD * letter
    low = box.top + box.height - (len(swatches) * _ROW + 1.2) * letter
    bar = Rectangle(round(left), round(box.top + letter), round(_THICK * letter), max(round(low - box.top - letter), 1))
    drawing.image(colouring.table[::-1, None], bar)
    x = bar.left + bar.width
    widest = 0.0
    for value in colouring.ticks(2 * letter / bar.height, layout.scene.bar.ticks):
        y = bar.top + bar.height * (1 - (value - colouring.low) / (colouring.high - colouring.low))
        drawing.lines((x, y, x + _TICK * letter, y))
        drawing.text(x + (_TICK + 0.25) * letter, y, colouring.label(value))
        widest = max(widest, drawing.letters.width(colouring.label(value)))
    title_x = x + (_TICK + 0.25 + 0.9) * letter + widest
    share = min(1.0, bar.height / max(drawing.letters.width(layout.title), 1.0))
    drawing.text(title_x, bar.top + bar.height / 2, layout.title, anchor="mm", turned=True, share=share)
    _draw_column(drawing, swatches, left, low + 1.2 * letter)


def _draw_names(drawing: Drawing, layout: Layout, drawn: Rasters) -> None:
    """Draw the legend of materials and special colours in a column."""
    letter, box, special = drawing.letters.height, layout.bar_place, drawn.special_colours
    most = int(box.height / (_ROW * letter)) - len(special) - 2
    names = name_entries(layout.names, drawn.colouring.table, most)
    _draw_column(drawing, [(layout.title, None), *names, *special], box.left + 0.5 * letter, box.top + 0.9 * letter)


def _draw_column(drawing: Drawing, entries: Sequence[Entry], left: float, first: float) -> None:
    """Draw entries one below the other; `first` is the middle of the first row."""
    for row, entry in enumerate(entries):
        _draw_entry(drawing, left, first + row * _ROW * drawing.letters.height, entry)


def _draw_entry(drawing: Drawing, left: float, middle: float, entry: Entry) -> None:
    """Draw an entry at a height in pixels: a text, with a swatch on its left if it has a colour."""
    (text, colour), letter = entry, drawing.letters.height
    if colour is not None:
        half = _SWATCH * letter / 2
        right, top, bottom = left + 2 * half, middle - half, middle + half
        corners = [(left, top), (right, top), (right, bottom), (left, bottom)]
        drawing.fill(corners, colours=tuple(part / 255 for part in colour))
        left = right + 0.4 * letter
    drawing.text(left, middle, text)
