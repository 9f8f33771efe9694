"""Positions in a histogram, for the mouse, and the ranges brushed there."""

from PySide6.QtCore import QPointF


def ends(range):
    assert range.metric == "q"
    return range.low, range.high


def point_at(histogram, x):
    """Return the point of the plot's viewport at q = x."""
    view, plot = histogram.plot.view, histogram.plot.plot
    middle = view.viewRect().center().y()
    return plot.mapFromScene(view.mapViewToScene(QPointF(x, middle)))
