"""Access to the display of a node's step in a window."""

from html import unescape

import numpy as np
import pyqtgraph as pg
from PySide6.QtWidgets import QLabel


def shown_step(window):
    return window.canvas.viewport.overlay_layers.selection.node_step


def drawn_trials(plot):
    """Return number, alpha and height of each trial that a `NodePlot` draws."""
    items = plot.findChild(pg.PlotWidget).getPlotItem().items
    dots = next(item for item in items if isinstance(item, pg.ScatterPlotItem))
    return [(spot.data(), spot.pos().x(), spot.pos().y()) for spot in dots.points() if spot.data()]


def wait_for_step(window, qtbot, method, node=None):
    window.refresh()
    qtbot.waitUntil(
        lambda: (
            shown_step(window) is not None
            and shown_step(window).method == method
            and shown_step(window).node == (window.session.selection.node if node is None else node)
        )
    )
    window.refresh()
    return shown_step(window)


def count_pixels(image, role, dark=False):
    """Count the pixels of a picture, (h, w, 3), that have the colour of a role."""
    colour = [int(role.of(dark)[k : k + 2], 16) for k in (1, 3, 5)]
    return int((np.abs(image[..., :3].astype(int) - colour).max(axis=2) < 12).sum())


def texts(window):
    window.refresh()
    panel = window.features["node_step"].panel
    labels = " ".join(unescape(label.text()) for label in panel.findChildren(QLabel) if label.isVisible())
    return labels + (panel.figures.toPlainText().replace("\xa0", " ") if panel.figures.isVisible() else "")


def wait_for_text(window, qtbot, text):
    qtbot.waitUntil(lambda: text in texts(window))
