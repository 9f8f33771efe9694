"""What stands above the panels of a page."""

from __future__ import annotations

import numpy as np

from hexmend_app.scene.export.ink import Ink
from hexmend_app.scene.export.layout import Layout
from hexmend_app.state.scene import Captions

#: What stays free beside a caption, and between a name and what is said of it, in heights of a letter.
_GAP = 0.5

#: Shares of the page's letters that are tried until a caption fits.
_SHARES = np.linspace(1.0, 0.5, 6)


def draw_captions(ink: Ink, layout: Layout) -> None:
    """Write above each panel what it shows; above a wipe, on either side of its edge."""
    if not layout.captions:
        return
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
        _write(ink, box.left, middle, room, f"{letter} {panel.caption or first.name}".strip(), said)
        if panel.wipe is not None:
            other, edge = subjects[panel.wipe.mesh - 1], box.left + round(panel.wipe.at * box.width)
            _write(ink, edge, middle, box.width - room, panel.wipe.caption or other.name, other.said if figures else "")
            ink.lines((edge, box.top - layout.caption, edge, box.top + box.height))


def _write(ink: Ink, left: float, middle: float, room: float, name: str, said: str) -> None:
    gap = _GAP * ink.letters.height
    for share in _SHARES:
        wide = share * (ink.letters.width(name, bold=True) + ink.letters.width(said)) + (3 if said else 2) * gap
        if wide <= room:
            break
    else:
        said = ""
        while name and share * ink.letters.width(name, bold=True) + 2 * gap > room:
            name = f"{name.rstrip('…')[:-1]}…" if len(name) > 2 else ""
    ink.text(left + gap, middle, name, bold=True, share=share)
    if said:
        ink.text(left + 2 * gap + share * ink.letters.width(name, bold=True), middle, said, share=share)


def _letter(number: int) -> str:
    return "abcdefghijklmnopqrstuvwxyz"[number]
