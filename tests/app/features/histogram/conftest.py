"""A histogram of 2,000 elements."""

from itertools import pairwise

import numpy as np
import pytest
from PySide6.QtCore import QPointF
from PySide6.QtTest import QTest

from hexmend_app.features.histogram.panel import QualityHistogram
from tests.app.driving import LEFT, move, turn
from tests.app.features.histogram.brushing import nothing_waits, place
from tests.patience import PATIENCE


@pytest.fixture
def data():
    """Quality and inversion of 2,000 elements."""
    q = np.random.default_rng(3).beta(6, 2, 2000)
    return q, q < 0.25


@pytest.fixture
def histogram(shown, data):
    widget = shown(QualityHistogram(), height=360)
    widget.set_initial(*data)
    widget.set_current(data[0] ** 0.5, np.zeros(2000, bool))
    turn()
    return widget


@pytest.fixture
def heard(histogram):
    ranges = []
    histogram.range_changed.connect(ranges.append)
    return ranges


@pytest.fixture
def drag(histogram, heard, qtbot):
    """Presses at the first q, moves through the others in small moves, and releases at the last."""

    def dragged(*stations):
        viewport = histogram.plot.plot.viewport()
        points = [place(histogram, x) for x in stations]
        QTest.mousePress(viewport, LEFT, pos=points[0])
        for start, end in pairwise(points):
            for share in np.linspace(0, 1, 12)[1:]:
                move(viewport, QPointF(start) + QPointF(end - start) * float(share), LEFT)
        QTest.mouseRelease(viewport, LEFT, pos=points[-1])
        qtbot.waitUntil(lambda: heard[-1:] == [histogram.range()] and nothing_waits(histogram), timeout=PATIENCE)

    return dragged


@pytest.fixture
def condition(histogram):
    """The histogram with another metric in it: (values, inverted) now."""
    rng = np.random.default_rng(5)
    values, inverted = 1 + rng.gamma(2, 1, 2000), rng.random(2000) < 0.1
    values[inverted] = np.inf
    histogram.set_metric("condition")
    histogram.set_initial(values, inverted)
    histogram.set_current(values, inverted)
    return values, inverted
