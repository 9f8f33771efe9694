"""What stands above the panels of a page."""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from hexmend_app.scene.export.ink import Ink
from hexmend_app.scene.export.layout import Layout
from hexmend_app.state.scene import Captions

#: What stays free beside a caption, and between a name and what is said of it, in heights of a letter.
_GAP = 0.5

#: Shares of the page's letters that are tried until a caption fits.
_SHARES = np.linspace(1.0, 0.5, 6)


class _Caption(NamedTuple):
    """A name with what is said of it, and its place, in pixels from the page's upper left corner."""

    left: float
    middle: float
    room: float
    name: str
    said: str


def draw_captions(ink: Ink, layout: Layout) -> None:
    """Write above each panel what it shows; above a wipe, on either side of its edge.

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
        room = box.width if panel.wipe is None else panel.wipe.at * box.width
        said = first.said if figures else ""
        yield _Caption(box.left, middle, room, f"{letter} {panel.caption or first.name}".strip(), said)
        if panel.wipe is not None:
            other, edge = subjects[panel.wipe.mesh - 1], box.left + round(panel.wipe.at * box.width)
            name, said = panel.wipe.caption or other.name, other.said if figures else ""
            yield _Caption(edge, middle, box.width - room, name, said)


def _share(ink: Ink, one: _Caption) -> float:
    """The greatest share that lets a caption fit, 0 where none does."""
    return next((share for share in _SHARES if _fits(ink, one, share)), 0.0)


def _fits(ink: Ink, one: _Caption, share: float) -> bool:
    letters = ink.letters
    wide = share * (letters.width(one.name, bold=True) + letters.width(one.said))
    return wide + (3 if one.said else 2) * _GAP * letters.height <= one.room


def _write(ink: Ink, one: _Caption, share: float) -> None:
    """Write a caption; where it does not fit, without what is said, and as much of the name as there is room for."""
    gap, name = _GAP * ink.letters.height, one.name
    said = one.said if _fits(ink, one, share) else ""
    while name and share * ink.letters.width(name, bold=True) + 2 * gap > one.room:
        name = f"{name.rstrip('…')[:-1]}…" if len(name) > 2 else ""
    ink.text(one.left + gap, one.middle, name, bold=True, share=share)
    if said:
        ink.text(one.left + 2 * gap + share * ink.letters.width(name, bold=True), one.middle, said, share=share)


def _letter(number: int) -> str:
    return "abcdefghijklmnopqrstuvwxyz"[number]
