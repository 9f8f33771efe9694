"""Orientation axes in a corner of a panel."""

from __future__ import annotations

import numpy as np

from hexmend_app.picture import Corner, Page
from hexmend_app.scene.page.drawing import Drawing
from hexmend_app.scene.page.layout import Rectangle

#: Colours of X, Y and Z on a bright and on a dark background.
_COLOURS = (("#d1342f", "#ff7a66"), ("#2e8b57", "#5fd394"), ("#1f4fd8", "#7fa6ff"))

#: Sizes in font heights: axis, distance of the letter from its end, length and half width of its tip, free margin.
_ARM, _BEYOND, _TIP, _HALF, _FREE = 2.2, 0.65, 0.75, 0.27, 0.6

#: Halo behind an axis, in line widths; halo behind a letter, in letter heights; opacity of both.
_HALO, _DISC, _HALO_OPACITY = 4.0, 0.55, 0.7

#: Maximum size of the axes, as a fraction of the shorter side of a panel.
_MAX_SIZE = 0.3


def draw_axes(drawing: Drawing, box: Rectangle, axes: np.ndarray, corner: Corner, page: Page) -> None:
    """Draw the X, Y and Z axes in the orientation of the camera.

    Parameters
    ----------
    drawing : Drawing
    box : Rectangle
        Rectangle of the panel.
    axes : (3, 3) float64
        Each axis in camera coordinates: right, up, and towards the viewer.
    corner : Corner
    page : Page
        Page whose background colour is used for a halo, which makes the axes visible in front of the mesh.
    """
    letter = drawing.letters.height
    reach = _ARM + _BEYOND + 0.45
    if 2 * (reach + _FREE) * letter > 2 * _MAX_SIZE * min(box.width, box.height) / 0.6:
        return  # the panel is too small
    # Extent of the axes in this orientation, for placing them in the corner.
    flat = axes[:, :2] * (1, -1)
    low, high = np.minimum(flat.min(axis=0), 0), np.maximum(flat.max(axis=0), 0)
    low, high = (low * (_ARM + _BEYOND) - 0.45) * letter, (high * (_ARM + _BEYOND) + 0.45) * letter
    across, down = corner.value.split()[1], corner.value.split()[0]
    free = _FREE * letter
    x = box.left + free - low[0] if across == "left" else box.left + box.width - free - high[0]
    y = box.top + free - low[1] if down == "upper" else box.top + box.height - free - high[1]
    for axis in np.argsort(axes[:, 2]):  # nearer axes are drawn over farther axes
        colour = _COLOURS[axis][page.dark]
        along = flat[axis]
        length = float(np.linalg.norm(along))
        end = np.array([x, y]) + _ARM * letter * along
        if length > 0.12:
            unit = along / length
            tip = min(_TIP, _ARM * length) * letter
            sideways = _HALF * letter * np.array([-unit[1], unit[0]])
            base = end - tip * unit
            place = end + _BEYOND * letter * unit
            if page.ground is not None:
                drawing.lines((x, y, *end), colour=page.ground, width=_HALO)
                drawing.fill(_circle(place[0], place[1], _DISC * letter), page.ground, alpha=_HALO_OPACITY)
            drawing.lines((x, y, *base), colour=colour, width=1.6)
            drawing.fill([tuple(end), tuple(base + sideways), tuple(base - sideways)], colour)
        else:
            drawing.fill(_circle(x, y, 0.16 * letter), colour)
            if axes[axis, 2] < 0:
                continue  # its end points away from the viewer
            place = np.array([x - 0.55 * letter, y + 0.6 * letter])
        drawing.text(place[0], place[1], "XYZ"[axis], anchor="mm", bold=True, colour=colour, share=0.9)


def _circle(x: float, y: float, radius: float) -> list[tuple[float, float]]:
    """Return a circle as a polygon."""
    angle = np.linspace(0, 2 * np.pi, 24, endpoint=False)
    return [*zip((x + radius * np.cos(angle)).tolist(), (y + radius * np.sin(angle)).tolist(), strict=True)]
