"""The histogram under the mouse."""

from itertools import cycle, pairwise

import numpy as np
import pytest
from PySide6.QtCore import QPointF, Qt, QTimer
from PySide6.QtGui import QActionGroup
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QToolButton, QToolTip

from hexmend.quality import METRICS
from hexmend_app.features.histogram.axis import Axis
from hexmend_app.features.histogram.panel import QualityHistogram
from hexmend_app.state.look import ValueRange
from tests.app.driving import move, turn
from tests.patience import PATIENCE

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
    turn()
    return widget


@pytest.fixture
def heard(histogram):
    ranges = []
    histogram.range_changed.connect(ranges.append)
    return ranges


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


@pytest.fixture
def drag(histogram, heard, qtbot):
    """Presses at the first q, moves through the others in small moves, and releases at the last."""

    def dragged(*stations):
        viewport = histogram.plot.plot.viewport()
        points = [place(histogram, x) for x in stations]
        QTest.mousePress(viewport, _LEFT, pos=points[0])
        for start, end in pairwise(points):
            for share in np.linspace(0, 1, 12)[1:]:
                move(viewport, QPointF(start) + QPointF(end - start) * float(share), _LEFT)
        QTest.mouseRelease(viewport, _LEFT, pos=points[-1])
        qtbot.waitUntil(lambda: heard[-1:] == [histogram.range()] and nothing_waits(histogram), timeout=PATIENCE)

    return dragged


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
    QTest.mouseClick(histogram.plot.plot.viewport(), _LEFT, pos=at)
    assert asked == []  # there are none
    histogram.set_current(*data)
    QTest.mouseClick(histogram.plot.plot.viewport(), _LEFT, pos=at)
    assert asked == [True]
    QTest.mouseClick(histogram.plot.plot.viewport(), _LEFT, pos=place(histogram, 0.5))
    assert (asked, heard) == ([True], [])


def test_the_inverted_are_taken_in_or_left_out_by_a_button(histogram, heard, qtbot):
    QTest.mouseClick(histogram.ends.inverted, _LEFT)
    assert heard == [ValueRange("q", 0.0, 1.0)]
    histogram.set_range(ValueRange("q", 0.2, 0.5))
    QTest.mouseClick(histogram.ends.inverted, _LEFT)
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
    QTest.mousePress(viewport, _LEFT, pos=place(histogram, 0.2))
    for x in np.linspace(0.3, 0.9, moves):
        move(viewport, place(histogram, x), _LEFT)
    qtbot.waitUntil(lambda: nothing_waits(histogram), timeout=PATIENCE)
    assert 1 < len(heard) < moves
    assert heard[-1] == histogram.range()
    QTest.mouseRelease(viewport, _LEFT, pos=place(histogram, 0.9))


def test_a_double_click_shows_all_again(histogram, heard, qtbot):
    histogram.set_range(ValueRange("q", 0.3, 0.5))
    # Through the window, which makes of the second press what a mouse would.
    at = histogram.plot.plot.viewport().mapTo(histogram, place(histogram, 0.8))
    QTest.mouseDClick(histogram.windowHandle(), _LEFT, pos=at)
    qtbot.waitUntil(lambda: heard == [None], timeout=PATIENCE)
    assert histogram.range() is None


def test_the_button_shows_all_again(histogram, heard):
    histogram.set_range(ValueRange("q", 0.3, 0.5))
    QTest.mouseClick(histogram.ends.all, _LEFT)
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


def test_hovering_tells_the_counts_then_and_now(histogram, data):
    q, inverted = data
    then = np.count_nonzero((q >= 0.5) & (q < 0.52) & ~inverted)
    now = np.count_nonzero((q**0.5 >= 0.5) & (q**0.5 < 0.52))
    assert then != now
    text = histogram.describe_at(0.511)
    assert "0.50 – 0.52" in text
    assert f"at the start: {then} hex" in text
    assert f"now: {now} hex" in text
    apart = histogram.describe_at(sum(Axis("q").inverted) / 2)
    assert apart == f"inverted\nat the start: {inverted.sum()} hexes\nnow: 0 hexes"
    assert histogram.describe_at(-0.05) == histogram.describe_at(1.01) == ""


def test_inverted_elements_in_the_range_are_told(histogram, data):
    histogram.set_current(*data)
    histogram.set_range(ValueRange("q", 0.1, 0.9))
    assert histogram.words.text().endswith(" in 0.10 – 0.90")
    histogram.set_range(ValueRange("q", 0.1, 0.9, inverted=True))
    assert histogram.words.text().endswith(f" in 0.10 – 0.90, and the {data[1].sum()} inverted")


@pytest.mark.parametrize("scale", ["linear", "log"])
def test_the_largest_count_is_in_sight_on_both_scales(histogram, scale):
    QTest.mouseClick(histogram.head.scale.button(scale), _LEFT)
    for count in (10, 900, 50):
        q = np.concatenate([np.full(count, 0.5), [0.1]])
        histogram.set_initial(q, np.zeros(len(q), bool))
        histogram.set_current(q, np.zeros(len(q), bool))
        low, high = histogram.plot.plot.viewRange()[1]
        height = float(histogram.plot.heights.of(histogram.series()[0].part, count))
        assert low < height < high
        assert (height - low) / (high - low) > 0.35


@pytest.mark.parametrize("scale", ["linear", "log"])
def test_the_axis_is_that_of_the_bins_and_a_taller_bar_is_broken(histogram, scale):
    QTest.mouseClick(histogram.head.scale.button(scale), _LEFT)
    q = np.full(3000, 0.5)
    tangled, mended = np.arange(3000) >= 100, np.arange(3000) >= 2990
    histogram.set_initial(q, tangled)
    histogram.set_current(q, tangled)
    plot = histogram.plot
    top = 10**plot.heights.top if scale == "log" else plot.heights.top
    assert 100 <= top <= 150
    now, start = (plot.numbers[key][0] for key in ("now", "start"))
    assert now.toPlainText() == "2,900"
    assert now.isVisible()
    assert not start.isVisible()  # the same number twice
    bar = plot.outlines["now"].bar.path()
    assert len(bar.toSubpathPolygons()) == 2  # with a gap between them
    assert plot.heights.top < bar.boundingRect().bottom() < plot.plot.viewRange()[1][1]
    lower, upper = (piece.boundingRect() for piece in bar.toSubpathPolygons())
    assert lower.top() == plot.heights.floor
    assert lower.bottom() < upper.bottom()
    histogram.set_current(np.append(q, q[:500]), np.append(tangled, tangled[100:600]))
    assert (now.toPlainText(), start.toPlainText()) == ("3,400", "2,900")
    assert start.isVisible()
    middles = [number.mapRectToScene(number.boundingRect()).center() for number in (start, now)]
    assert all(map(plot.view.sceneBoundingRect().contains, middles))
    assert middles[0].y() < middles[1].y() - 8
    histogram.set_current(q, mended)
    assert now.toPlainText() == "10"
    if scale == "linear":
        assert not start.isVisible()  # the axis reaches up to it again
    assert len(plot.outlines["now"].bar.path().toSubpathPolygons()) == 1


def test_the_scale_changes_whatever_the_counts_were(histogram):
    q = np.full(5000, 0.5)
    histogram.set_initial(q, np.zeros(5000, bool))
    for scale in ("log", "linear", "log"):
        QTest.mouseClick(histogram.head.scale.button(scale), _LEFT)
        assert histogram.plot.heights.log == (scale == "log")
    assert histogram.plot.heights.top == pytest.approx(np.log10(5000))


def test_with_all_elements_inverted_there_is_an_axis_all_the_same(histogram):
    histogram.set_initial(np.zeros(50), np.ones(50, bool))
    histogram.set_current(np.zeros(50), np.ones(50, bool))
    assert histogram.plot.heights.top == 1
    assert histogram.plot.numbers["now"][0].toPlainText() == "50"


@pytest.mark.parametrize("kept", [0, 6])
def test_the_plot_has_160_pixels_in_a_low_panel(histogram, data, kept):
    histogram.resize(600, 230)
    histogram.set_kept([(slot, f"getme {slot}", *data) for slot in range(kept)])
    turn()
    assert histogram.size().height() == 230
    assert histogram.plot.height() >= 160
    space = histogram.plot.view.sceneBoundingRect()
    legend = histogram.legend.geometry()
    assert legend.right() <= histogram.plot.width()
    low, high = histogram.plot.plot.viewRange()[1]
    bars = space.height() * (histogram.plot.heights.share(1) - low) / (high - low)
    assert bars >= 80
    if kept == 0:
        assert space.height() - bars >= legend.height()  # nothing is drawn below the legend


def test_words_hold_still_and_stand_in_one_line(histogram):
    histogram.resize(600, 230)
    turn()
    before = histogram.plot.geometry()
    for chosen in (None, ValueRange("q", 0.123, 0.789, inverted=True), ValueRange("q", 0.2, 0.3)):
        histogram.set_range(chosen)
        turn()
        assert histogram.plot.geometry() == before
        assert histogram.words.height() < 2 * histogram.fontMetrics().height()
        assert histogram.words.toolTip() == histogram.words.text()


def test_it_has_neither_menu_nor_buttons_and_does_not_zoom(histogram):
    plot = histogram.plot.plot
    assert not plot.getPlotItem().menuEnabled()
    assert plot.getPlotItem().buttonsHidden
    before = plot.viewRange()
    QTest.mouseClick(plot.viewport(), Qt.MouseButton.RightButton, pos=place(histogram, 0.5))
    assert QApplication.activePopupWidget() is None
    assert plot.viewRange() == before


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


@pytest.mark.parametrize("name", METRICS)
def test_every_metric_fits_into_a_narrow_column_which_holds_its_width(histogram, name):
    narrow = histogram.minimumSizeHint().width()
    histogram.set_metric(name)
    histogram.set_initial(np.linspace(1e-6, 3.456e-5, 2000), np.zeros(2000, bool))
    assert histogram.minimumSizeHint().width() == narrow <= 270
    histogram.resize(narrow, 268)
    turn()
    for part in (*histogram.ends.parts, histogram.head.metric, histogram.head.scale, histogram.head.more):
        right = part.mapTo(histogram, part.rect().topRight()).x()
        assert 0 < right < narrow
        assert part.width() >= (part.minimumWidth() or part.minimumSizeHint().width())


def test_inverted_elements_stand_apart_whatever_the_metric(histogram):
    values, inverted = np.linspace(1.0, 1.4, 2000), np.arange(2000) % 4 == 0
    for name in METRICS:
        histogram.set_metric(name)
        histogram.set_initial(values, inverted)
        histogram.set_current(values, inverted)
        assert histogram.describe_at(sum(histogram.axis.inverted) / 2).endswith("now: 500 hexes")
        assert "inverted" in dict(histogram.axis.ticks()).values()


def test_bins_are_chosen_in_the_head_and_in_the_menu(histogram, data):
    histogram.resize(700, 360)
    turn()
    bins = histogram.head.bins
    assert bins.isVisible()
    bins.setFocus()
    QTest.keyClick(bins, Qt.Key.Key_Up)
    assert len(histogram.series()[0].part.counts) == 60
    assert len(histogram.plot.outlines["now"].curve.yData) == 60
    numbers = {action.text(): action for action in histogram.head.findChild(QActionGroup).actions()}
    numbers["200"].trigger()
    assert bins.value() == 200
    assert numbers["200"].isChecked()
    assert histogram.series()[0].part.counts.tolist() == np.histogram(data[0][~data[1]], 200, (0, 1))[0].tolist()
    assert "q(H) 0.510 – 0.515" in histogram.describe_at(0.511)


def cumulative_button(histogram):
    histogram.resize(700, 360)
    turn()
    (button,) = (b for b in histogram.findChildren(QToolButton) if b.text() == "Cumulative")
    return button


@pytest.mark.parametrize("scale", ["linear", "log"])
def test_cumulative_shares_begin_with_the_inverted_and_end_at_all(histogram, data, scale):
    q, inverted = data
    QTest.mouseClick(histogram.head.scale.button(scale), _LEFT)
    QTest.mouseClick(cumulative_button(histogram), _LEFT)
    histogram.set_current(*data)
    share = 100 * (inverted.sum() + np.count_nonzero(~inverted & (q < 0.52))) / 2000
    text = histogram.describe_at(0.511)
    assert text.startswith("inverted, or q(H) up to 0.52\n")
    assert f"now: {share:.4g} %, " in text
    assert "now: 100 %, 2,000 hexes" in histogram.describe_at(0.99)
    curve = histogram.plot.outlines["now"].curve.yData
    assert curve[-1] == (2.0 if scale == "log" else 100)
    assert np.diff(curve).min() >= 0
    assert histogram.plot.numbers["now"][0].toPlainText() == f"{inverted.mean() * 100:.3g} %"
    low, high = histogram.plot.plot.viewRange()[1]
    assert low <= curve[0] < curve[-1] < high
    QTest.mouseClick(cumulative_button(histogram), _LEFT)
    assert histogram.plot.outlines["now"].curve.yData.max() < (3 if scale == "log" else 200)


def test_what_is_kept_is_drawn_named_renamed_and_removed(histogram, data):
    wishes = []
    histogram.renamed.connect(lambda *wish: wishes.append(wish))
    histogram.removed.connect(lambda slot: wishes.append(slot))
    half = data[0] / 2, np.zeros(2000, bool)
    kept = [(0, "laplacian 5", *half), (3, "now", *data)]
    histogram.set_kept(kept)
    turn()
    assert [one.name for one in histogram.series()] == ["at the start", "now", "laplacian 5", "now"]
    assert len({one.colour for one in histogram.series()}) == 4
    assert len(histogram.plot.outlines) == 4
    assert f"laplacian 5: {np.count_nonzero((half[0] >= 0.24) & (half[0] < 0.26))} " in histogram.describe_at(0.25)
    name = histogram.legend.entries[0].name
    assert name.text() == "laplacian 5"
    QTest.mouseClick(name, _LEFT)
    name.selectAll()
    QTest.keyClicks(name, "Laplace")
    QTest.keyClick(name, Qt.Key.Key_Return)
    QTest.mouseClick(histogram.legend.entries[3].cross, _LEFT)
    assert wishes == [(0, "Laplace"), 3]
    histogram.set_kept(kept[:1])
    turn()
    assert list(histogram.legend.entries) == [0]
    assert len(histogram.plot.outlines) == 3


def test_an_empty_name_is_no_name(histogram, data):
    wishes = []
    histogram.renamed.connect(lambda *wish: wishes.append(wish))
    histogram.set_kept([(1, "mend 4", *data)])
    turn()
    name = histogram.legend.entries[1].name
    QTest.mouseClick(name, _LEFT)
    name.selectAll()
    QTest.keyClick(name, Qt.Key.Key_Backspace)
    QTest.keyClick(name, Qt.Key.Key_Return)
    assert wishes == []
    assert name.text() == "mend 4"


def test_the_tooltip_over_the_plot_counts_all_that_is_drawn(histogram, data, qtbot):
    histogram.set_kept([(0, "laplacian 5", *data)])
    turn()
    viewport = histogram.plot.plot.viewport()

    way = cycle((0.3, 0.705))  # a tooltip comes as the mouse moves, and of moves in haste not with each

    def told():
        QTest.mouseMove(viewport, place(histogram, next(way)))
        turn()
        return QToolTip.text() == histogram.describe_at(0.705)

    qtbot.waitUntil(told, timeout=PATIENCE)
    assert [row.partition(":")[0] for row in QToolTip.text().splitlines()[1:]] == ["at the start", "now", "laplacian 5"]


def test_the_axis_holds_still_while_values_change(histogram, condition):
    before = histogram.axis, histogram.plot.plot.viewRange()[0]
    for share in (0.5, 0.2, 5.0):
        histogram.set_current(1 + share * np.linspace(0, 9, 2000), np.zeros(2000, bool))
        assert (histogram.axis, histogram.plot.plot.viewRange()[0]) == before
