"""Positions in a histogram, for the mouse, and the ranges brushed there."""

from PySide6.QtCore import QPointF, QTimer


def ends(range):
    assert range.metric == "q"
    return range.low, range.high


def point_at(histogram, x):
    """Return the point of the plot's viewport at q = x."""
    view, plot = histogram.plot.view, histogram.plot.plot
    middle = view.viewRect().center().y()
    return plot.mapFromScene(view.mapViewToScene(QPointF(x, middle)))


def nothing_pending(histogram):
    """Return True if no range is waiting to be announced."""
    return not any(timer.isActive() for timer in histogram.findChildren(QTimer))
