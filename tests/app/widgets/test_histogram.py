"""The histogram under the mouse."""

from itertools import pairwise

import numpy as np
import pytest
from PySide6.QtCore import QEvent, QPointF, Qt
from PySide6.QtGui import QMouseEvent
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication

from hexmend_app.widgets.histogram import QualityHistogram
from hexmend_app.widgets.histogram_plot import APART

_LEFT = Qt.MouseButton.LeftButton


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
    QTest.qWait(20)
    return widget


@pytest.fixture
def heard(histogram):
    ranges = []
    histogram.range_changed.connect(ranges.append)
    return ranges


def place(histogram, x):
    """Point of the plot's viewport at q = x."""
    view, plot = histogram._plot.view, histogram._plot.plot
    middle = view.viewRect().center().y()
    return plot.mapFromScene(view.mapViewToScene(QPointF(x, middle)))


def drag(histogram, *stations):
    """Press at the first q, move through the others in small moves, release at the last."""
    viewport = histogram._plot.plot.viewport()

    def send(kind, at, button, buttons):
        event = QMouseEvent(kind, at, viewport.mapToGlobal(at), button, buttons, Qt.KeyboardModifier.NoModifier)
        QApplication.sendEvent(viewport, event)

    points = [QPointF(place(histogram, x)) for x in stations]
    send(QEvent.Type.MouseButtonPress, points[0], _LEFT, _LEFT)
    for start, end in pairwise(points):
        for share in np.linspace(0, 1, 12)[1:]:
            send(QEvent.Type.MouseMove, start + (end - start) * float(share), Qt.MouseButton.NoButton, _LEFT)
            QTest.qWait(8)
    send(QEvent.Type.MouseButtonRelease, points[-1], _LEFT, Qt.MouseButton.NoButton)
    QTest.qWait(60)


def test_dragging_over_the_plot_selects_the_range_under_it(histogram, heard, data):
    drag(histogram, 0.3, 0.45)
    assert heard[-1] == histogram.range() == pytest.approx((0.3, 0.45), abs=0.011)
    low, high = heard[-1]
    now = data[0] ** 0.5
    inside = np.count_nonzero((now >= low) & (now <= high))
    assert histogram._text.text() == f"{inside} of 2,000 elements in {low:.2f} – {high:.2f}"


def test_dragging_backwards_and_beyond_the_ends_stays_within_zero_and_one(histogram, heard):
    drag(histogram, 0.5, -0.2)
    assert heard[-1] == pytest.approx((0, 0.5), abs=0.011)
    histogram.set_range(None)
    drag(histogram, 0.7, 1.015)
    assert heard[-1] == pytest.approx((0.7, 1), abs=0.011)


def test_an_edge_moves_alone_and_the_inside_moves_the_range(histogram, heard):
    histogram.set_range((0.3, 0.5))
    drag(histogram, 0.5, 0.7)
    assert heard[-1] == pytest.approx((0.3, 0.7), abs=0.011)
    drag(histogram, 0.45, 0.55)
    assert heard[-1] == pytest.approx((0.4, 0.8), abs=0.021)
    drag(histogram, 0.6, 1.0)
    assert heard[-1] == pytest.approx((0.6, 1.0), abs=0.021)  # keeps its width at the wall


def test_the_range_is_announced_while_dragged_but_not_at_every_move(histogram, heard):
    drag(histogram, 0.2, 0.9, 0.4, 0.8)
    assert 2 < len(heard) < 33
    assert heard[-1] == histogram.range()


def test_a_double_click_shows_all_again(histogram, heard):
    histogram.set_range((0.3, 0.5))
    # Through the window, which makes of the second press what a mouse would.
    at = histogram._plot.plot.viewport().mapTo(histogram, place(histogram, 0.8))
    QTest.mouseDClick(histogram.windowHandle(), _LEFT, pos=at)
    QTest.qWait(40)
    assert histogram.range() is None
    assert heard == [None]


def test_the_button_shows_all_again(histogram, heard):
    histogram.set_range((0.3, 0.5))
    QTest.mouseClick(histogram._all, _LEFT)
    assert heard == [None]
    assert not histogram._all.isEnabled()


def test_the_keyboard_reaches_the_same_range(histogram, heard):
    box = histogram._low.lineEdit()
    box.setFocus()
    box.selectAll()
    QTest.keyClicks(box, "0.4")
    QTest.keyClick(box, Qt.Key.Key_Return)
    assert heard == [(0.4, 1.0)]
    QTest.keyClick(histogram._high, Qt.Key.Key_Down)
    QTest.qWait(60)
    assert heard[-1] == (0.4, 0.99)


def test_setters_are_silent(histogram, heard, data):
    histogram.set_range((0.1, 0.2))
    histogram.set_current(*data)
    histogram.set_range(None)
    histogram.clear()
    QTest.qWait(60)
    assert heard == []
    assert histogram._text.text() == "No mesh is open."


def test_a_set_range_withdraws_one_that_waits_to_be_announced(histogram, heard):
    histogram._plot.view.brushed.emit((0.1, 0.2))
    histogram._plot.view.brushed.emit((0.1, 0.3))  # waits for its turn
    histogram.set_range(None)
    QTest.qWait(60)
    assert heard == [(0.1, 0.2)]


def test_hovering_tells_the_counts_then_and_now(histogram, data):
    q, inverted = data
    then = np.count_nonzero((q >= 0.5) & (q < 0.52) & ~inverted)
    now = np.count_nonzero((q**0.5 >= 0.5) & (q**0.5 < 0.52))
    assert then != now
    text = histogram.describe_at(0.511)
    assert "0.50 – 0.52" in text
    assert f"at the start: {then} element" in text
    assert f"now: {now} element" in text
    apart = histogram.describe_at(sum(APART) / 2)
    assert apart == f"inverted\nat the start: {inverted.sum()} elements\nnow: 0 elements"
    assert histogram.describe_at(-0.05) == histogram.describe_at(1.01) == ""


def test_inverted_elements_in_the_range_are_told(histogram, data):
    histogram.set_current(*data)
    histogram.set_range((0.0, 1.0))
    assert histogram._text.text().endswith(f"{data[1].sum()} of them inverted")


@pytest.mark.parametrize("scale", ["linear", "log"])
def test_the_largest_count_is_in_sight_on_both_scales(histogram, scale):
    QTest.mouseClick(histogram._scale.button(scale), _LEFT)
    for count in (10, 900, 50):
        q = np.concatenate([np.full(count, 0.5), [0.1]])
        histogram.set_initial(q, np.zeros(len(q), bool))
        histogram.set_current(q, np.zeros(len(q), bool))
        low, high = histogram._plot.plot.viewRange()[1]
        height = float(histogram._plot._heights(count))
        assert low < height < high
        assert (height - low) / (high - low) > 0.35


def test_it_has_neither_menu_nor_buttons_and_does_not_zoom(histogram):
    plot = histogram._plot.plot
    assert not plot.getPlotItem().menuEnabled()
    assert plot.getPlotItem().buttonsHidden
    before = plot.viewRange()
    QTest.mouseClick(plot.viewport(), Qt.MouseButton.RightButton, pos=place(histogram, 0.5))
    assert QApplication.activePopupWidget() is None
    assert plot.viewRange() == before
