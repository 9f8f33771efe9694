"""Colour bar of a page: gradient, ticks, title, and swatches of special colours; or the names of materials."""

from __future__ import annotations

from hexmend_app.picture import TextPlace
from hexmend_app.scene.page.drawing import Drawing
from hexmend_app.scene.page.layout import Layout, Rectangle
from hexmend_app.scene.page.name_legend import MOST_BELOW, entry_width, rows_of
from hexmend_app.scene.render.rasters import Rasters

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
    swatches = [_text(name, count) for name, count, _ in drawn.special_colours]
    swatch_width = max(map(drawing.letters.width, swatches)) + (_SWATCH + 0.4) * letter
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
    _swatches(drawing, drawn, side, first, swatches)


def _draw_right(drawing: Drawing, layout: Layout, drawn: Rasters) -> None:
    letter, box, colouring = drawing.letters.height, layout.bar_place, drawn.colouring
    swatches = [_text(name, count) for name, count, _ in drawn.special_colours]
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
    _swatches(drawing, drawn, left, low + 1.2 * letter, swatches)


def _draw_names(drawing: Drawing, layout: Layout, drawn: Rasters) -> None:
    """Draw the legend of materials and special colours: in rows below the panels, or in a column at the right."""
    letter, box = drawing.letters.height, layout.bar_place
    special = [(_text(name, count), colour) for name, count, colour in drawn.special_colours]
    if layout.bar is TextPlace.BELOW:
        rows = rows_of(drawing.letters, layout.legend(MOST_BELOW, special), layout.legend_width)
    else:
        most = int(box.height / (_ROW * letter)) - len(special) - 2
        rows = [[entry] for entry in layout.legend(most, special)]
    for row, entries in enumerate(rows):
        x, middle = box.left + 0.5 * letter, box.top + (0.9 + _ROW * row) * letter
        for entry in entries:
            text, colour = entry
            if colour is None:
                drawing.text(x, middle, text)
            else:
                _swatch(drawing, x, middle, colour, text)
            x += entry_width(drawing.letters, entry)


def _swatches(drawing: Drawing, drawn: Rasters, left: float, first: float, texts: list[str]) -> None:
    """Draw one row for each special colour; `first` is the middle of the first row."""
    for row, ((_, _, colour), text) in enumerate(zip(drawn.special_colours, texts, strict=True)):
        _swatch(drawing, left, first + row * _ROW * drawing.letters.height, colour, text)


def _swatch(drawing: Drawing, left: float, middle: float, colour: tuple[int, int, int], text: str) -> None:
    """Draw a swatch with a text on its right, at a height in pixels."""
    letter = drawing.letters.height
    half = _SWATCH * letter / 2
    right, top, bottom = left + 2 * half, middle - half, middle + half
    rgb = tuple(part / 255 for part in colour)
    drawing.fill([(left, top), (right, top), (right, bottom), (left, bottom)], colours=rgb)
    drawing.text(right + 0.4 * letter, middle, text)


def _text(name: str, count: int | None) -> str:
    return name if count is None else f"{name} ({count:,})"
