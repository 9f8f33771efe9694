"""Captions above the panels of a page."""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from hexmend_app.picture import Captions
from hexmend_app.scene.page.drawing import Drawing
from hexmend_app.scene.page.layout import Layout

#: Free space next to a caption, and between a name and its figures, in heights of a letter.
_GAP = 0.5

#: Shares of the page's letters that are tried until a caption fits.
_SHARES = np.linspace(1.0, 0.5, 6)


class _Caption(NamedTuple):
    """A name with figures, and its position, in pixels from the upper left corner of the page."""

    left: float
    middle: float
    space: float
    name: str
    sentence: str


def draw_captions(ink: Drawing, layout: Layout) -> None:
    """Write a caption above each panel; above a wipe, one on each side of its edge.

    Letters have one size, at which all captions fit; one for which there is no such size is written as small as can be.
    """
    if not layout.captions:
        return
    captions = list(_captions(layout))
    shares = [_share(ink, one) for one in captions]
    common = min((share for share in shares if share), default=0.0)
    for one, share in zip(captions, shares, strict=True):
        _write(ink, one, common if share else _SHARES[-1])
    for number, panel in enumerate(layout.panels):
        if panel.wipe is not None:
            box = layout.place(number)
            edge = box.left + round(panel.wipe.at * box.width)
            ink.lines((edge, box.top - layout.caption, edge, box.top + box.height))


def _captions(layout: Layout) -> Iterator[_Caption]:
    scene, subjects = layout.scene, layout.subjects
    shown = {one for panel in layout.panels for one in (panel.mesh, panel.wipe.mesh if panel.wipe else panel.mesh)}
    figures = scene.page.figures and len(shown) > 1
    for number, panel in enumerate(layout.panels):
        box = layout.place(number)
        letter = f"({_letter(number)})" if scene.page.captions is Captions.LETTERS else ""
        first = subjects[panel.mesh - 1]
        middle = box.top - layout.caption / 2
        free_space = box.width if panel.wipe is None else panel.wipe.at * box.width
        figures_text = first.text if figures else ""
        yield _Caption(box.left, middle, free_space, f"{letter} {panel.caption or first.name}".strip(), figures_text)
        if panel.wipe is not None:
            other, edge = subjects[panel.wipe.mesh - 1], box.left + round(panel.wipe.at * box.width)
            name, figures_text = panel.wipe.caption or other.name, other.text if figures else ""
            yield _Caption(edge, middle, box.width - free_space, name, figures_text)


def _share(ink: Drawing, one: _Caption) -> float:
    """Return the greatest share with which a caption fits, 0 if none does."""
    return next((share for share in _SHARES if _fits(ink, one, share)), 0.0)


def _fits(ink: Drawing, one: _Caption, share: float) -> bool:
    letters = ink.letters
    wide = share * (letters.width(one.name, bold=True) + letters.width(one.sentence))
    return wide + (3 if one.sentence else 2) * _GAP * letters.height <= one.space


def _write(ink: Drawing, one: _Caption, share: float) -> None:
    """Write a caption; if it does not fit, without figures and with a shortened name."""
    gap, name = _GAP * ink.letters.height, one.name
    message = one.sentence if _fits(ink, one, share) else ""
    while name and share * ink.letters.width(name, bold=True) + 2 * gap > one.space:
        name = f"{name.rstrip('…')[:-1]}…" if len(name) > 2 else ""
    ink.text(one.left + gap, one.middle, name, bold=True, share=share)
    if message:
        ink.text(one.left + 2 * gap + share * ink.letters.width(name, bold=True), one.middle, message, share=share)


def _letter(number: int) -> str:
    return "abcdefghijklmnopqrstuvwxyz"[number]
