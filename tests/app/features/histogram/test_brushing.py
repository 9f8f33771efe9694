"""A range of values is dragged and typed in the histogram."""

import numpy as np
import pytest
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest

from hexmend_app.picture.appearance import ValueRange
from tests.app.driving import LEFT, move
from tests.app.features.histogram.brushing import ends, nothing_waits, place
from tests.patience import PATIENCE


def test_dragging_over_the_plot_selects_the_range_under_it(histogram, heard, drag, data):
    drag(0.3, 0.45)
    assert heard[-1] == histogram.range()
    low, high = ends(heard[-1])
    assert (low, high) == pytest.approx((0.3, 0.45), abs=0.011)
    now = data[0] ** 0.5
    inside = np.count_nonzero((now >= low) & (now <= high))
    assert histogram.words.text() == f"{inside} of 2,000 hexes in {low:.2f} – {high:.2f}"


def test_dragging_backwards_and_beyond_the_ends_stays_within_zero_and_one(histogram, heard, drag):
    drag(0.5, -0.05)
    assert ends(heard[-1]) == (0, pytest.approx(0.5, abs=0.011))
    histogram.set_range(None)
    drag(0.7, 1.015)
    assert ends(heard[-1]) == (pytest.approx(0.7, abs=0.011), 1)


def test_dragging_over_the_bar_of_the_inverted_takes_them_in(histogram, heard, drag, data):
    histogram.set_current(*data)
    drag(0.5, sum(histogram.axis.inverted) / 2)
    assert heard[-1].inverted
    now = histogram.series()[1].part
    low = np.count_nonzero((data[0] <= heard[-1].high) & ~data[1])
    assert histogram.words.text().startswith(f"{low + now.inverted} of 2,000 hexes up to 0.5")
    assert histogram.words.text().endswith(f", and the {now.inverted} inverted")
    histogram.set_range(None)
    drag(histogram.axis.inverted[0] - 0.01, histogram.axis.inverted[1])
    assert heard[-1] == ValueRange("q", -np.inf, -np.inf, inverted=True)
    assert histogram.words.text() == f"{now.inverted} of 2,000 hexes, the inverted ones"
    drag(0.001, 1.0)
    assert heard[-1] == ValueRange("q", 0.0, 1.0)
    assert histogram.words.text() == f"{2000 - now.inverted:,} of 2,000 hexes, all but the inverted ones"


def test_a_click_on_the_bar_of_the_inverted_asks_for_them(histogram, heard, data):
    asked = []
    histogram.inverted_requested.connect(lambda: asked.append(True))
    at = place(histogram, sum(histogram.axis.inverted) / 2)
    QTest.mouseClick(histogram.plot.plot.viewport(), LEFT, pos=at)
    assert asked == []  # there are none
    histogram.set_current(*data)
    QTest.mouseClick(histogram.plot.plot.viewport(), LEFT, pos=at)
    assert asked == [True]
    QTest.mouseClick(histogram.plot.plot.viewport(), LEFT, pos=place(histogram, 0.5))
    assert (asked, heard) == ([True], [])


def test_the_inverted_are_taken_in_or_left_out_by_a_button(histogram, heard, qtbot):
    QTest.mouseClick(histogram.ends.inverted, LEFT)
    assert heard == [ValueRange("q", 0.0, 1.0)]
    histogram.set_range(ValueRange("q", 0.2, 0.5))
    QTest.mouseClick(histogram.ends.inverted, LEFT)
    qtbot.waitUntil(lambda: heard[-1] == ValueRange("q", 0.2, 0.5, inverted=True), timeout=PATIENCE)
    histogram.set_range(None)
    assert histogram.ends.inverted.isChecked()


def test_typing_one_end_leaves_the_other_where_it_was_brushed(histogram, heard, qtbot):
    histogram.head.bins.setValue(200)
    histogram.plot.view.brushed.emit((0.3049, 0.6))
    brushed = heard[-1]
    assert histogram.ends.low.text() == "0.305"
    box = histogram.ends.high
    box.setFocus()
    box.selectAll()
    QTest.keyClicks(box, "0.7")
    QTest.keyClick(box, Qt.Key.Key_Return)
    qtbot.waitUntil(lambda: heard[-1] == ValueRange("q", brushed.low, 0.7), timeout=PATIENCE)


def test_an_edge_moves_alone_and_the_inside_moves_the_range(histogram, heard, drag):
    histogram.set_range(ValueRange("q", 0.3, 0.5))
    drag(0.5, 0.7)
    assert ends(heard[-1]) == pytest.approx((0.3, 0.7), abs=0.011)
    drag(0.45, 0.55)
    assert ends(heard[-1]) == pytest.approx((0.4, 0.8), abs=0.021)
    drag(0.6, 1.0)
    assert ends(heard[-1]) == (pytest.approx(0.6, abs=0.021), 1)  # keeps its width at the wall


def test_the_range_is_announced_while_dragged_but_not_at_every_move(histogram, heard, qtbot):
    viewport, moves = histogram.plot.plot.viewport(), 60
    QTest.mousePress(viewport, LEFT, pos=place(histogram, 0.2))
    for x in np.linspace(0.3, 0.9, moves):
        move(viewport, place(histogram, x), LEFT)
    qtbot.waitUntil(lambda: nothing_waits(histogram), timeout=PATIENCE)
    assert 1 < len(heard) < moves
    assert heard[-1] == histogram.range()
    QTest.mouseRelease(viewport, LEFT, pos=place(histogram, 0.9))


def test_a_double_click_shows_all_again(histogram, heard, qtbot):
    histogram.set_range(ValueRange("q", 0.3, 0.5))
    # Through the window, which makes of the second press what a mouse would.
    at = histogram.plot.plot.viewport().mapTo(histogram, place(histogram, 0.8))
    QTest.mouseDClick(histogram.windowHandle(), LEFT, pos=at)
    qtbot.waitUntil(lambda: heard == [None], timeout=PATIENCE)
    assert histogram.range() is None


def test_the_button_shows_all_again(histogram, heard):
    histogram.set_range(ValueRange("q", 0.3, 0.5))
    QTest.mouseClick(histogram.ends.all, LEFT)
    assert heard == [None]
    assert not histogram.ends.all.isEnabled()


def test_the_keyboard_reaches_the_same_range(histogram, heard, qtbot):
    box = histogram.ends.low.lineEdit()
    box.setFocus()
    box.selectAll()
    QTest.keyClicks(box, "0.4")
    QTest.keyClick(box, Qt.Key.Key_Return)
    assert heard == [ValueRange("q", 0.4, 1.0)]
    QTest.keyClick(histogram.ends.high, Qt.Key.Key_Down)
    qtbot.waitUntil(lambda: heard[-1] == ValueRange("q", 0.4, 0.99), timeout=PATIENCE)


def test_setters_are_silent(histogram, heard, data, qtbot):
    histogram.set_range(ValueRange("q", 0.1, 0.2))
    histogram.set_current(*data)
    histogram.set_range(None)
    histogram.set_metric("scaled-jacobian")
    qtbot.waitUntil(lambda: nothing_waits(histogram), timeout=PATIENCE)
    assert heard == []
    assert histogram.words.text() == "No mesh is open."


def test_a_range_that_waits_is_none_once_its_metric_is_no_more_drawn(histogram, heard, qtbot):
    histogram.plot.view.brushed.emit((0.1, 0.2))
    histogram.plot.view.brushed.emit((0.1, 0.3))  # waits for its turn
    histogram.set_metric("scaled-jacobian")
    qtbot.waitUntil(lambda: len(heard) == 2, timeout=PATIENCE)
    assert heard[-1] is None


def test_a_set_range_withdraws_one_that_waits_to_be_announced(histogram, heard, qtbot):
    histogram.plot.view.brushed.emit((0.1, 0.2))
    histogram.plot.view.brushed.emit((0.1, 0.3))  # waits for its turn
    histogram.set_range(None)
    qtbot.waitUntil(lambda: nothing_waits(histogram), timeout=PATIENCE)
    assert [ends(one) for one in heard] == [pytest.approx((0.1, 0.2))]


def test_inverted_elements_in_the_range_are_told(histogram, data):
    histogram.set_current(*data)
    histogram.set_range(ValueRange("q", 0.1, 0.9))
    assert histogram.words.text().endswith(" in 0.10 – 0.90")
    histogram.set_range(ValueRange("q", 0.1, 0.9, inverted=True))
    assert histogram.words.text().endswith(f" in 0.10 – 0.90, and the {data[1].sum()} inverted")


def test_another_metric_is_brushed_to_its_end_and_beyond(histogram, heard, drag, condition):
    values, inverted = condition
    axis = histogram.axis
    drag(0.5, sum(axis.above) / 2)
    low = axis.low + 0.5 * (axis.high - axis.low)
    assert heard[-1] == histogram.range()
    assert (heard[-1].metric, heard[-1].high) == ("condition", np.inf)
    assert heard[-1].low == pytest.approx(low, abs=0.03 * low)
    inside = np.count_nonzero((values >= heard[-1].low) & ~inverted)
    words = f"{inside:,} of 2,000 hexes from {axis.end(heard[-1].low)}"
    assert histogram.words.text() == words
    assert histogram.ends.high.text() == "∞"


def test_numbers_of_another_metric_are_typed_in_any_notation(histogram, heard, condition, qtbot):
    typed = ((histogram.ends.low, "2.5e0"), (histogram.ends.high, "4"), (histogram.ends.high, "inf"))
    for number, (box, text) in enumerate(typed, start=1):
        box.setFocus()
        box.selectAll()
        QTest.keyClicks(box, text)
        QTest.keyClick(box, Qt.Key.Key_Return)
        qtbot.waitUntil(lambda number=number: len(heard) == number, timeout=PATIENCE)
    expected = [(2.5, np.inf), (2.5, 4.0), (2.5, np.inf)]
    assert heard == [ValueRange("condition", *ends) for ends in expected]
    QTest.keyClick(histogram.ends.high, Qt.Key.Key_Down)  # from infinity back to the axis
    qtbot.waitUntil(lambda: heard[-1].high == histogram.axis.high, timeout=PATIENCE)
    box = histogram.ends.low
    box.selectAll()
    QTest.keyClicks(box, "1e-")
    QTest.keyClick(box, Qt.Key.Key_Return)
    assert histogram.range().low == 2.5  # not finished: given up


def test_a_range_of_another_metric_is_not_shown(histogram, heard, condition):
    histogram.set_range(ValueRange("q", 0.1, 0.2))
    assert histogram.range() is None
    assert not histogram.ends.all.isEnabled()
