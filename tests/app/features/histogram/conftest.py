"""Histogram of 2,000 hexes."""

from itertools import pairwise

import numpy as np
import pytest
from PySide6.QtCore import QPointF
from PySide6.QtTest import QTest

from hexmend_app.features.histogram.panel import QualityHistogram
from hexmend_app.report.distribution import Distribution
from tests.app.driving import LEFT, heard_from, move, turn
from tests.app.features.histogram.mouse import point_at, valid


@pytest.fixture
def data():
    """Return q (2000,) and inversion (2000,) bool of 2,000 hexes."""
    q = np.random.default_rng(3).beta(6, 2, 2000)
    return q, q < 0.25


@pytest.fixture
def histogram(shown, data):
    widget = shown(QualityHistogram(), height=360)
    widget.show_distributions(Distribution.of(*data), valid(data[0] ** 0.5))
    turn()
    return widget


@pytest.fixture
def announced(histogram):
    """Return a list of the ranges that the histogram announces."""
    return heard_from(histogram.range_changed)


@pytest.fixture
def drag(histogram, announced, qtbot):
    """Return a function that drags the mouse from the first position through the others to the last."""

    def drag_through(*positions):
        viewport = histogram.plot.plot.viewport()
        points = [point_at(histogram, x) for x in positions]
        QTest.mousePress(viewport, LEFT, pos=points[0])
        for start, end in pairwise(points):
            for share in np.linspace(0, 1, 12)[1:]:
                move(viewport, QPointF(start) + QPointF(end - start) * float(share), LEFT)
        QTest.mouseRelease(viewport, LEFT, pos=points[-1])
        qtbot.waitUntil(lambda: announced[-1:] == [histogram.range()])

    return drag_through


@pytest.fixture
def condition(histogram):
    """Change the metric of the histogram to the condition number, and return values and inversion of now."""
    rng = np.random.default_rng(5)
    values, inverted = 1 + rng.gamma(2, 1, 2000), rng.random(2000) < 0.1
    values[inverted] = np.inf
    histogram.set_metric("condition")
    histogram.show_distributions(None, Distribution.of(values, inverted))
    return values, inverted
