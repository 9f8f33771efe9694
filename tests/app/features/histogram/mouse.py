"""Positions in a histogram, for the mouse, and the distributions and ranges there."""

import numpy as np
from PySide6.QtCore import QPointF

from hexmend_app.report.distribution import Distribution


def valid(values):
    """Return a distribution without inverted hexes."""
    return Distribution.of(values, np.zeros(len(values), bool))


def ends(range):
    assert range.metric == "q"
    return range.low, range.high


def point_at(histogram, x):
    """Return the point of the plot's viewport at a value, or at a number of bins left of the axis if it is negative."""
    view, plot = histogram.plot.view, histogram.plot.plot
    axis = histogram.axis
    x = x if x < 0 else axis.bins * (x - axis.low) / (axis.high - axis.low)
    middle = view.viewRect().center().y()
    return plot.mapFromScene(view.mapViewToScene(QPointF(x, middle)))
