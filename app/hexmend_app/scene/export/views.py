"""The picture of what a window's views show."""

from __future__ import annotations

from collections.abc import Sequence

from PIL import Image

from hexmend_app.scene.export.figure import Panel, figure
from hexmend_app.scene.export.picture import picture
from hexmend_app.scene.panes import Panes


def picture_of(panes: Panes, names: Sequence[str], size: tuple[int, int], transparent: bool) -> Image.Image:
    """Draw what views show, at any size.

    Parameters
    ----------
    panes : Panes
    names : sequence of str
        What the captions of several views call them.
    size : (width, height)
        In pixels.
    transparent : bool
        Leave the background out.
    """
    first = panes.first
    how = {"filters": first.filters, "camera": first.camera, "transparent": transparent}
    if len(panes.all) == 1:
        return picture(first.frame, size, node_step=first.chosen.node_step, **how)
    panels = [Panel(name, view.frame.mesh, view.frame.figures) for name, view in zip(names, panes.all, strict=True)]
    return figure(panels, first.frame.look, size, movement=first.frame.movement, wipe=panes.wipe, **how)
