"""Captions above the panels of a page."""

from __future__ import annotations

from collections.abc import Iterator
from string import ascii_lowercase
from typing import NamedTuple

import numpy as np

from hexmend_app.picture import Captions
from hexmend_app.scene.page.drawing import Drawing
from hexmend_app.scene.page.layout import Layout

#: Free space next to a caption, and between its name and its figures, in font heights.
_GAP = 0.5

#: Fractions of the font size that are tried until all captions fit.
_SHARES = np.linspace(1.0, 0.5, 6)


class _Caption(NamedTuple):
    """A caption: position in pixels from the upper left corner of the page, available width, name and figures."""

    left: float
    middle: float
    width: float
    name: str
    figures: str


def draw_captions(drawing: Drawing, layout: Layout) -> None:
    """Draw a caption above each panel, and two above a wipe, on either side of its edge.

    All captions have the largest size at which they fit; captions that do not fit at any size have the smallest size.
    """
    if not layout.captions:
        return
    captions = list(_captions(layout))
    shares = [next((one for one in _SHARES if _fits(drawing, caption, one)), 0.0) for caption in captions]
    common = min((share for share in shares if share), default=0.0)
    for caption, share in zip(captions, shares, strict=True):
        _draw(drawing, caption, common if share else _SHARES[-1])
    for number, panel in enumerate(layout.panels):
        if panel.wipe is not None:
            box = layout.place(number)
            edge = box.left + round(panel.wipe.at * box.width)
            drawing.lines((edge, box.top - layout.caption, edge, box.top + box.height))


def _captions(layout: Layout) -> Iterator[_Caption]:
    scene, meshes = layout.scene, layout.meshes
    with_figures = scene.page.figures and (layout.figures or len(layout.shown) > 1)
    for number, panel in enumerate(layout.panels):
        box = layout.place(number)
        letter = f"({ascii_lowercase[number]})" if scene.page.captions is Captions.LETTERS else ""
        first = meshes[panel.mesh - 1]
        middle = box.top - layout.caption / 2
        last = (number + 1) % layout.columns == 0
        free = box.width + last * layout.histogram_width  # a caption may extend over the histogram
        width = free if panel.wipe is None else panel.wipe.at * box.width
        name, figures = f"{letter} {panel.caption or first.name}".strip(), first.text if with_figures else ""
        yield _Caption(box.left, middle, width, name, figures)
        if panel.wipe is not None:
            other, edge = meshes[panel.wipe.mesh - 1], box.left + round(panel.wipe.at * box.width)
            name, figures = panel.wipe.caption or other.name, other.text if with_figures else ""
            yield _Caption(edge, middle, free - width, name, figures)


def _fits(drawing: Drawing, caption: _Caption, share: float) -> bool:
    letters = drawing.letters
    width = share * (letters.width(caption.name, bold=True) + letters.width(caption.figures))
    return width + (3 if caption.figures else 2) * _GAP * letters.height <= caption.width


def _draw(drawing: Drawing, caption: _Caption, share: float) -> None:
    """Draw a caption; if it does not fit, without figures and with a shortened name."""
    gap, name = _GAP * drawing.letters.height, caption.name
    figures = caption.figures if _fits(drawing, caption, share) else ""
    while name and share * drawing.letters.width(name, bold=True) + 2 * gap > caption.width:
        name = f"{name.rstrip('…')[:-1]}…" if len(name) > 2 else ""
    drawing.text(caption.left + gap, caption.middle, name, bold=True, share=share)
    if figures:
        left = caption.left + 2 * gap + share * drawing.letters.width(name, bold=True)
        drawing.text(left, caption.middle, figures, share=share)
