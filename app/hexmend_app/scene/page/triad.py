"""The axes in a corner of a panel, in lines and letters."""

from __future__ import annotations

import numpy as np

from hexmend_app.picture import Corner, Page
from hexmend_app.scene.page.drawing import Drawing
from hexmend_app.scene.page.layout import Rectangle

#: Colours of X, Y and Z on bright paper, and on dark.
_COLOURS = (("#d1342f", "#ff7a66"), ("#2e8b57", "#5fd394"), ("#1f4fd8", "#7fa6ff"))

#: In heights of a letter: an axis, a letter's place beyond its end, a tip's length and half its width, what stays free.
_ARM, _BEYOND, _TIP, _HALF, _FREE = 2.2, 0.65, 0.75, 0.27, 0.6

#: Halo behind an axis, in line widths; halo behind a letter, in letter heights; opacity of both.
_RIM, _DISC, _BEHIND = 4.0, 0.55, 0.7

#: The share of a panel's side that the axes take at most.
_MOST = 0.3


def draw_axes(ink: Drawing, box: Rectangle, axes: np.ndarray, corner: Corner, page: Page) -> None:
    """Draw X, Y and Z as the camera sees them.

    Parameters
    ----------
    ink : Ink
    box : Box
        The panel.
    axes : (3, 3) float64
        Each axis in camera coordinates: right, up, and towards the viewer.
    corner : Corner
    page : Page
        Of its paper there is a rim around axes and letters, so that they are seen over the mesh too.
    """
    letter = ink.letters.height
    reach = _ARM + _BEYOND + 0.45
    if 2 * (reach + _FREE) * letter > 2 * _MOST * min(box.width, box.height) / 0.6:
        return  # no room for them beside the mesh
    # As much room as they take in this direction, so that they stand in the corner.
    flat = axes[:, :2] * (1, -1)
    low, high = np.minimum(flat.min(axis=0), 0), np.maximum(flat.max(axis=0), 0)
    low, high = (low * (_ARM + _BEYOND) - 0.45) * letter, (high * (_ARM + _BEYOND) + 0.45) * letter
    across, down = corner.value.split()[1], corner.value.split()[0]
    free = _FREE * letter
    x = box.left + free - low[0] if across == "left" else box.left + box.width - free - high[0]
    y = box.top + free - low[1] if down == "upper" else box.top + box.height - free - high[1]
    for axis in np.argsort(axes[:, 2]):  # what is nearer covers what is farther
        colour = _COLOURS[axis][page.dark]
        along = flat[axis]
        length = float(np.linalg.norm(along))
        end = np.array([x, y]) + _ARM * letter * along
        if length > 0.12:
            unit = along / length
            tip = min(_TIP, _ARM * length) * letter
            aside = _HALF * letter * np.array([-unit[1], unit[0]])
            base = end - tip * unit
            place = end + _BEYOND * letter * unit
            if page.ground is not None:
                ink.lines((x, y, *end), colour=page.ground, wide=_RIM)
                ink.fill(_ring(*place, _DISC * letter), page.ground, alpha=_BEHIND)
            ink.lines((x, y, *base), colour=colour, wide=1.6)
            ink.fill([tuple(end), tuple(base + aside), tuple(base - aside)], colour)
        else:
            ink.fill(_ring(x, y, 0.16 * letter), colour)
            if axes[axis, 2] < 0:
                continue  # its end is behind
            place = np.array([x - 0.55 * letter, y + 0.6 * letter])
        ink.text(*place, "XYZ"[axis], anchor="mm", bold=True, colour=colour, share=0.9)


def _ring(x: float, y: float, radius: float) -> list[tuple[float, float]]:
    """Return a circle as a polygon."""
    turn = np.linspace(0, 2 * np.pi, 24, endpoint=False)
    return [*zip((x + radius * np.cos(turn)).tolist(), (y + radius * np.sin(turn)).tolist(), strict=True)]
