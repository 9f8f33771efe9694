"""Panel of the histogram: tooltips, legend, controls and layout."""

import numpy as np
import pytest
from PySide6.QtCore import QPoint, QPointF, Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QComboBox

from hexmend.quality import METRICS
from hexmend_app.features.histogram.axis import Axis
from hexmend_app.features.histogram.bins import distribute
from hexmend_app.features.histogram.distributions import Distributions
from hexmend_app.picture.visibility import Show
from hexmend_app.scene.colour.value_range import within
from tests.app.driving import (
    LEFT,
    brought,
    drag,
    key,
    move,
    named,
    open_and_wait,
    press,
    smooth,
    turn,
    type_text,
    walk_to,
)
from tests.app.features.histogram.mouse import ends, point_at


def test_the_tooltip_has_the_counts_at_the_start_and_now(histogram, data):
    q, inverted = data
    start = np.count_nonzero((q >= 0.5) & (q < 0.52) & ~inverted)
    now = np.count_nonzero((q**0.5 >= 0.5) & (q**0.5 < 0.52))
    assert start != now
    text = histogram.describe_at(0.511)
    assert "0.50 – 0.52" in text
    assert f"at the start: {start} hex" in text
    assert f"now: {now} hex" in text
    bar = histogram.describe_at(sum(Axis("q").inverted) / 2)
    assert bar == f"inverted\nat the start: {inverted.sum()} hexes\nnow: 0 hexes"
    assert histogram.describe_at(-0.05) == histogram.describe_at(1.01) == ""


def test_the_number_of_bins_is_set_in_the_menu(histogram, data):
    bins = histogram.head.bins
    histogram.head.more.menu().popup(QPoint(0, 0))
    bins.setFocus()
    QTest.keyClick(bins, Qt.Key.Key_Up)
    assert len(histogram.series()[0].distribution.counts) == 60
    histogram.head.more.menu().close()
    bins.setValue(200)
    assert (
        histogram.series()[0].distribution.counts.tolist() == np.histogram(data[0][~data[1]], 200, (0, 1))[0].tolist()
    )
    assert "q(H) 0.510 – 0.515" in histogram.describe_at(0.511)


def test_snapshots_are_drawn_renamed_and_removed(histogram, data):
    signals = []
    histogram.legend.renamed.connect(lambda *signal: signals.append(signal))
    histogram.legend.removed.connect(lambda slot: signals.append(slot))
    half = data[0] / 2, np.zeros(2000, bool)
    snapshots = [(0, "laplacian 5", *half), (3, "now", *data)]
    histogram.set_snapshots(snapshots)
    turn()
    assert [one.name for one in histogram.series()] == ["at the start", "now", "laplacian 5", "now"]
    assert len({one.colour for one in histogram.series()}) == 4
    assert len(histogram.plot.outlines) == 4
    assert f"laplacian 5: {np.count_nonzero((half[0] >= 0.24) & (half[0] < 0.26))} " in histogram.describe_at(0.25)
    name = histogram.legend.entries[0].name
    assert name.text() == "laplacian 5"
    QTest.mouseClick(name, LEFT)
    type_text(name, "Laplace", enter=True)
    QTest.mouseClick(histogram.legend.entries[3].cross, LEFT)
    assert signals == [(0, "Laplace"), 3]
    histogram.set_snapshots(snapshots[:1])
    turn()
    assert list(histogram.legend.entries) == [0]
    assert len(histogram.plot.outlines) == 3


def test_the_line_below_counts_hexes_that_are_invalid_inside(histogram, data):
    assert histogram.summary.text() == "2,000 hexes, 0 inverted"
    histogram.set_current(data[0], np.zeros(2000, bool), 2)
    assert histogram.summary.text() == "2,000 hexes, 0 inverted · 2 invalid inside"


# Heights of the bars of the histogram, on both scales.


@pytest.mark.parametrize("scale", ["linear", "log"])
def test_the_largest_count_is_visible_on_both_scales(histogram, scale):
    QTest.mouseClick(histogram.head.scale.button(scale), LEFT)
    for count in (10, 900, 50):
        q = np.concatenate([np.full(count, 0.5), [0.1]])
        histogram.set_initial(q, np.zeros(len(q), bool))
        histogram.set_current(q, np.zeros(len(q), bool))
        low, high = histogram.plot.plot.viewRange()[1]
        height = float(histogram.plot.heights.of(histogram.series()[0].distribution, count))
        assert low < height < high
        assert (height - low) / (high - low) > 0.35


def test_there_is_an_axis_if_all_hexes_are_inverted(histogram):
    histogram.set_initial(np.zeros(50), np.ones(50, bool))
    histogram.set_current(np.zeros(50), np.ones(50, bool))
    assert histogram.plot.heights.top > 0
    assert histogram.plot.numbers["now"][0].toPlainText() == "50"


@pytest.mark.parametrize("scale", ["linear", "log"])
def test_cumulative_shares_begin_with_inverted_hexes_and_end_at_100_percent(histogram, data, scale):
    q, inverted = data
    QTest.mouseClick(histogram.head.scale.button(scale), LEFT)
    histogram.head.cumulative.trigger()
    histogram.set_current(*data)
    share = 100 * (inverted.sum() + np.count_nonzero(~inverted & (q < 0.52))) / 2000
    text = histogram.describe_at(0.511)
    assert text.startswith("inverted, or q(H) up to 0.52\n")
    assert f"now: {share:.4g} %, " in text
    assert "now: 100 %, 2,000 hexes" in histogram.describe_at(0.99)
    histogram.head.cumulative.trigger()
    assert not histogram.describe_at(0.511).startswith("inverted, or")


# Distributions of the histogram, counted again for another axis or number of bins.


Q = np.random.default_rng(3).beta(6, 2, 300)
LONG = 1 + np.random.default_rng(4).gamma(2, 3, 300)
VALID = np.zeros(300, bool)


def counts(counted):
    return counted.below, counted.counts.tolist(), counted.above, counted.inverted


def test_series_are_in_the_order_of_the_legend():
    distributions = Distributions()
    assert distributions.series() == []
    distributions.set_snapshots([(0, "before", Q, VALID), (2, "later", Q**2, VALID)])
    distributions.set_current(Q, VALID)
    distributions.set_initial(Q, VALID)
    assert [one.name for one in distributions.series()] == ["at the start", "now", "before", "later"]
    assert [one.current for one in distributions.series()] == [False, True, False, False]


@pytest.mark.parametrize("change", ["the axis", "the bins"])
def test_all_distributions_are_counted_again(change):
    distributions = Distributions()
    distributions.reset("aspect-ratio")
    distributions.set_current(LONG, VALID)
    distributions.set_snapshots([(1, "kept", LONG / 2, VALID)])
    before, bins = distributions.axis, 50
    if change == "the axis":
        distributions.set_initial(LONG, VALID)
        assert distributions.axis == Axis.fitted("aspect-ratio", LONG, VALID) != before
    else:
        bins = 20
        distributions.set_bins(bins)
        assert distributions.axis == before
    now, snapshot = (series.distribution for series in distributions.series()[-2:])
    assert counts(now) == counts(distribute(LONG, VALID, distributions.axis, bins))
    assert counts(snapshot) == counts(distribute(LONG / 2, VALID, distributions.axis, bins))


def test_another_metric_removes_all_distributions():
    distributions = Distributions()
    distributions.set_initial(Q, VALID)
    distributions.set_current(Q, VALID)
    distributions.set_snapshots([(0, "one", Q, VALID)])
    distributions.reset("scaled-jacobian")
    assert distributions.axis.metric == "scaled-jacobian"
    assert distributions.series() == distributions.snapshots == []


# Ranges of values that are dragged and typed in the histogram.


def test_dragging_over_the_plot_brushes_the_range_under_it(histogram, announced, drag, data):
    drag(0.3, 0.45)
    assert announced[-1] == histogram.range()
    low, high = ends(announced[-1])
    assert (low, high) == pytest.approx((0.3, 0.45), abs=0.011)
    now = data[0] ** 0.5
    inside = np.count_nonzero((now >= low) & (now <= high))
    assert histogram.summary.text() == f"{inside} of 2,000 hexes from {low:.2f} to {high:.2f}"


def test_dragging_over_the_bar_of_inverted_hexes_includes_them(histogram, announced, drag, data):
    histogram.set_current(*data)
    drag(0.5, sum(histogram.axis.inverted) / 2)
    assert announced[-1].inverted
    now = histogram.series()[1].distribution
    low = np.count_nonzero((data[0] <= announced[-1].high) & ~data[1])
    assert histogram.summary.text().startswith(f"{low + now.inverted} of 2,000 hexes up to 0.5")
    assert histogram.summary.text().endswith(f", and the {now.inverted} inverted")
    histogram.set_range(None)
    drag(histogram.axis.inverted[0] - 0.01, histogram.axis.inverted[1])
    assert announced[-1] == Show((-np.inf, -np.inf), "q", inverted=True)
    assert histogram.summary.text() == f"{now.inverted} of 2,000 hexes, inverted only"
    drag(0.001, 1.0)
    assert announced[-1] == Show((0.0, 1.0), "q")
    assert histogram.summary.text() == f"{2000 - now.inverted:,} of 2,000 hexes, inverted hidden"


def test_a_click_on_the_bar_of_inverted_hexes_requests_them(histogram, announced, data):
    requests = []
    histogram.inverted_requested.connect(lambda: requests.append(True))
    bar = point_at(histogram, sum(histogram.axis.inverted) / 2)
    QTest.mouseClick(histogram.plot.plot.viewport(), LEFT, pos=bar)
    assert requests == []  # the bar is empty
    histogram.set_current(*data)
    QTest.mouseClick(histogram.plot.plot.viewport(), LEFT, pos=bar)
    assert requests == [True]
    QTest.mouseClick(histogram.plot.plot.viewport(), LEFT, pos=point_at(histogram, 0.5))
    assert (requests, announced) == ([True], [])


def test_a_drag_moves_an_end_or_the_whole_range(histogram, announced, drag):
    histogram.set_range(Show((0.3, 0.5), "q"))
    drag(0.5, 0.7)
    assert ends(announced[-1]) == pytest.approx((0.3, 0.7), abs=0.011)
    drag(0.45, 0.55)
    assert ends(announced[-1]) == pytest.approx((0.4, 0.8), abs=0.021)
    drag(0.6, 1.0)
    assert ends(announced[-1]) == (pytest.approx(0.6, abs=0.021), 1)  # keeps its width at the limit


def test_a_range_of_an_unbounded_metric_extends_to_infinity(histogram, announced, drag, condition):
    values, inverted = condition
    axis = histogram.axis
    drag(0.5, sum(axis.above) / 2)
    low = axis.low + 0.5 * (axis.high - axis.low)
    assert announced[-1] == histogram.range()
    assert (announced[-1].metric, announced[-1].high) == ("condition", np.inf)
    assert announced[-1].low == pytest.approx(low, abs=0.03 * low)
    inside = np.count_nonzero((values >= announced[-1].low) & ~inverted)
    assert histogram.summary.text() == f"{inside:,} of 2,000 hexes from {axis.end_text(announced[-1].low)}"
    assert histogram.range_row.high.text() == "∞"


def test_numbers_are_typed_in_any_notation(histogram, announced, condition, qtbot):
    typed = ((histogram.range_row.low, "2.5e0"), (histogram.range_row.high, "4"), (histogram.range_row.high, "inf"))
    for number, (box, text) in enumerate(typed, start=1):
        box.setFocus()
        type_text(box, text, enter=True)
        qtbot.waitUntil(lambda number=number: len(announced) == number)
    expected = [(2.5, np.inf), (2.5, 4.0), (2.5, np.inf)]
    assert announced == [Show(ends, "condition") for ends in expected]
    QTest.keyClick(histogram.range_row.high, Qt.Key.Key_Down)  # from infinity back to the axis
    qtbot.waitUntil(lambda: announced[-1].high == histogram.axis.high)
    box = histogram.range_row.low
    type_text(box, "1e-", enter=True)
    assert histogram.range().low == 2.5  # incomplete: dropped


def test_a_click_on_a_bar_shows_only_its_hexes(histogram, announced, data, qtbot):
    histogram.set_current(*data)
    values, inverted = data
    distribution = next(one.distribution for one in histogram.series() if one.current)
    bar, view = distribution.cells.span(1 + int(np.argmax(distribution.counts))), histogram.plot.view
    viewport = histogram.plot.plot.viewport()
    above = view.mapViewToScene(QPointF(sum(bar) / 2, 1.02 * histogram.plot.heights.top)).toPoint()
    QTest.mouseClick(viewport, LEFT, pos=above)
    assert announced == []
    inside = view.mapViewToScene(QPointF(sum(bar) / 2, 1.0)).toPoint()
    QTest.mouseClick(viewport, LEFT, pos=inside)
    qtbot.waitUntil(lambda: len(announced) == 1)
    shown = within(values, inverted, announced[0])
    low, high = (histogram.axis.low + end * (histogram.axis.high - histogram.axis.low) for end in bar)
    assert shown.sum() > 0
    assert np.array_equal(shown, (values >= low) & (values < high) & ~inverted)


def test_an_end_of_the_range_of_colours_is_dragged(histogram, announced, qtbot):
    ranges = []
    histogram.colours_dragged.connect(lambda low, high: ranges.append((low, high)))
    histogram.set_colour_range((0.2, 2.0))
    assert histogram.plot.colour_range.handles() == (0.2, 1.0)  # at the end of the axis
    viewport, start = histogram.plot.plot.viewport(), point_at(histogram, 0.2)
    move(viewport, QPointF(start), Qt.MouseButton.NoButton)
    QTest.mousePress(viewport, LEFT, pos=start)
    for x in (0.25, 0.3, 0.4):
        move(viewport, QPointF(point_at(histogram, x)), LEFT)
    QTest.mouseRelease(viewport, LEFT, pos=point_at(histogram, 0.4))
    low, high = ranges[-1]
    assert low == pytest.approx(0.4, abs=0.02)
    assert high == 2.0  # stays beyond the axis
    assert announced == []  # the hexes shown stay the same
    histogram.set_colour_range(None)
    assert not histogram.plot.colour_range.shown


# Histogram in the window: metric of the colours, brushed ranges and snapshots.


@pytest.fixture
def front_histogram(window, qtbot):
    """Return the panel, in its default size."""
    return brought(window, qtbot, "histogram")


def brush(window, qtbot, low, high):
    """Drag over the histogram, wait until the view has its range, and return the range."""
    front_histogram, view = window.features["histogram"].panel, window.session.view
    before = view.look.show.by_quality
    QApplication.processEvents()  # lays out the axis of another metric
    drag(front_histogram.plot.plot.viewport(), point_at(front_histogram, low), point_at(front_histogram, high))
    qtbot.waitUntil(lambda: front_histogram.range() == view.look.show.by_quality != before)
    window.refresh()
    return view.look.show.by_quality


def colour_by(window, metric):
    """Select the metric of the colours."""
    window.show_panel("look")
    walk_to(window, named(window.features["appearance"].panel, QComboBox, "Metric"), metric)


@pytest.mark.slow
def test_the_metric_follows_the_colours_until_a_range_or_the_user_fixes_it(window, qtbot, front_histogram):
    colour_by(window, "scaled-jacobian")
    assert front_histogram.axis.metric == "scaled-jacobian"
    assert front_histogram.head.metric_box.currentText() == "Scaled Jacobian (as colours)"
    brush(window, qtbot, 0.2, 0.5)
    colour_by(window, "skew")  # colours of the hexes in the range
    assert window.session.view.look.show.by_quality == front_histogram.range()
    assert front_histogram.axis.metric == front_histogram.range().metric == "scaled-jacobian"
    assert front_histogram.head.metric_box.currentText() == "Scaled Jacobian"
    walk_to(window, front_histogram.head.metric_box, "")
    assert front_histogram.axis.metric == "skew"
    assert front_histogram.range() is None
    walk_to(window, front_histogram.head.metric_box, "volume")
    colour_by(window, "q")
    assert front_histogram.axis.metric == "volume"


@pytest.mark.slow
def test_snapshots_are_named_after_the_iteration_and_shown_for_every_metric(window, qtbot, front_histogram, mesh_file):
    states = []
    for _ in range(2):
        smooth(qtbot, window.session, "local-sd", 1)
        window.refresh()
        front_histogram.head.keep.trigger()
        states.append(window.session.document.now)
    window.refresh()
    walk_to(window, front_histogram.head.metric_box, "condition")
    drawn = {one.name: one.distribution for one in front_histogram.series()}
    names = ["Local steepest descent 1", "Local steepest descent (2) 1"]
    assert [one.name for one in window.session.snapshots.all] == names
    for name, state in zip(names, states, strict=True):
        values = METRICS["condition"].of(state.mesh.points, state.mesh.hexes, state.figures)
        np.testing.assert_array_equal(drawn[name].values, values)
    press(front_histogram.legend.entries[1].cross)
    assert names[1] not in [one.name for one in window.session.snapshots.all]
    open_and_wait(qtbot, window, mesh_file)
    window.refresh()
    assert [one.name for one in front_histogram.series()] == ["at the start", "now"]


def test_a_click_on_the_bar_of_inverted_hexes_shows_only_them(window, front_histogram):
    QTest.mouseClick(
        front_histogram.plot.plot.viewport(),
        LEFT,
        pos=point_at(front_histogram, sum(front_histogram.axis.inverted) / 2),
    )
    window.refresh()
    assert window.canvas.viewport.shown == window.session.document.now.figures.n_inverted > 0
    key(window, Qt.Key.Key_Escape)
    assert window.canvas.viewport.shown == 4000
