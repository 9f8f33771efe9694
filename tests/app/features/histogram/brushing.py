"""Where in a histogram the mouse is, and what it has chosen there."""

from PySide6.QtCore import QPointF, QTimer


def ends(chosen):
    assert chosen.metric == "q"
    return chosen.low, chosen.high


def place(histogram, x):
    """Point of the plot's viewport at q = x."""
    view, plot = histogram.plot.view, histogram.plot.plot
    middle = view.viewRect().center().y()
    return plot.mapFromScene(view.mapViewToScene(QPointF(x, middle)))


def nothing_waits(histogram):
    """Whether no range waits for its turn to be announced."""
    return not any(timer.isActive() for timer in histogram.findChildren(QTimer))
