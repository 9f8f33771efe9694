"""Panel of the histogram: tooltips, legend, controls and layout."""

import numpy as np
import pytest
from PySide6.QtCore import QPoint, QPointF, Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QComboBox, QInputDialog

from hexmend.quality import METRICS
from hexmend_app.picture.visibility import Show
from hexmend_app.report.distribution import Distribution
from hexmend_app.scene.colour.value_range import within
from hexmend_app.shell.panels.hex_counts import HexCounts
from tests.app.driving import (
    LEFT,
    brought,
    drag,
    key,
    named,
    open_and_wait,
    open_mesh,
    press,
    smooth,
    turn,
    type_text,
    walk_to,
)
from tests.app.features.histogram.mouse import ends, point_at, valid
from tests.core.solid_lattices import mixed


def test_the_tooltip_has_the_counts_at_the_start_and_now(histogram, data):
    q, inverted = data
    axis = histogram.axis
    low, high = axis.edges[10:12]
    start = np.count_nonzero((q >= low) & (q < high) & ~inverted)
    now = np.count_nonzero((q**0.5 >= low) & (q**0.5 < high))
    assert start != now
    text = histogram.shown.describe_at(10.5)
    assert f"{axis.text(low)} – {axis.text(high)}" in text
    assert f"at the start: {start} hex" in text
    assert f"now: {now} hex" in text
    column = sum(histogram.plot.histogram.column) / 2
    assert histogram.shown.describe_at(column) == f"inverted\nnow: 0 hexes\nat the start: {inverted.sum()} hexes"
    assert histogram.shown.describe_at(-0.5) == histogram.shown.describe_at(50.5) == ""


def test_the_number_of_bins_is_set_in_the_menu(histogram):
    bins = histogram.head.bins
    histogram.head.more.menu().popup(QPoint(0, 0))
    bins.setFocus()
    QTest.keyClick(bins, Qt.Key.Key_Up)
    assert histogram.axis.bins == len(histogram.plot.histogram.series[0].counts) == 60
    histogram.head.more.menu().close()


def test_kept_distributions_are_drawn_renamed_and_removed(histogram, data, monkeypatch):
    signals = []
    histogram.legend.renamed.connect(lambda *signal: signals.append(signal))
    histogram.legend.removed.connect(lambda slot: signals.append(slot))
    half, later = valid(data[0] / 2), Distribution.of(*data)
    histogram.show_distributions(later, half, [(0, "laplacian 5", half), (3, "now", later)])
    turn()
    series = histogram.plot.histogram.series
    assert [one.name for one in series] == ["now", "at the start", "laplacian 5", "now"]
    assert len({one.colour for one in series}) == 4
    assert [one.filled for one in series] == [True, False, False, False]
    entry = histogram.legend.kept[0]
    assert entry.text() == "laplacian 5"
    monkeypatch.setattr(QInputDialog, "getText", lambda *_: (" Laplace ", True))
    entry.menu().actions()[0].trigger()
    histogram.legend.kept[3].menu().actions()[1].trigger()
    assert signals == [(0, "Laplace"), 3]
    histogram.show_distributions(later, half, [(0, "Laplace", half)])
    assert list(histogram.legend.kept) == [0]
    assert histogram.legend.y() > histogram.plot.geometry().bottom()


def test_the_line_below_counts_hexes_that_are_invalid_inside(histogram, data):
    assert histogram.summary.text() == "2,000 hexes, 0 inverted"
    histogram.show_distributions(None, valid(data[0]), inside=2)
    assert histogram.summary.text() == "2,000 hexes, 0 inverted · 2 invalid inside"


@pytest.mark.parametrize("log", [False, True])
def test_the_largest_count_is_visible_on_both_scales(histogram, log):
    histogram.head.log.setChecked(log)
    for count in (10, 900, 50):
        histogram.show_distributions(None, valid(np.concatenate([np.full(count, 0.5), [0.1]])))
        low, high = histogram.plot.plot.viewRange()[1]
        at = int(np.argmax(histogram.plot.histogram.series[0].counts))
        height = histogram.plot.height_at(at + 0.5)
        assert 0.5 < (height - low) / (high - low) < 1


def test_there_is_an_axis_if_all_hexes_are_inverted(histogram):
    histogram.show_distributions(None, Distribution.of(np.zeros(50), np.ones(50, bool)))
    assert histogram.plot.number.toPlainText() == "50 inverted"
    histogram.show_distributions(None, valid(np.full(50, 0.5)))
    assert not histogram.plot.number.isVisible()


@pytest.mark.parametrize("log", [False, True])
def test_cumulative_shares_begin_with_inverted_hexes_and_end_at_100_percent(histogram, data, log):
    q, inverted = data
    histogram.head.log.setChecked(log)
    histogram.head.cumulative.trigger()
    histogram.show_distributions(None, Distribution.of(*data))
    high = histogram.axis.edges[21]
    share = 100 * (inverted.sum() + np.count_nonzero(~inverted & (q < high))) / 2000
    text = histogram.shown.describe_at(20.5)
    assert text.startswith(f"inverted, or q(H) up to {histogram.axis.text(high)}\n")
    assert f"now: {share:.4g} %, " in text
    assert "now: 100 %, 2,000 hexes" in histogram.shown.describe_at(49.5)
    histogram.head.cumulative.trigger()
    assert not histogram.shown.describe_at(20.5).startswith("inverted, or")


# Ranges of values that are dragged and typed in the histogram.


def test_dragging_over_the_plot_brushes_the_range_under_it(histogram, announced, drag, data):
    drag(0.5, 0.65)
    assert announced[-1] == histogram.range()
    low, high = ends(announced[-1])
    assert (low, high) == pytest.approx((0.5, 0.65), abs=0.011)
    now = data[0] ** 0.5
    inside = np.count_nonzero((now >= low) & (now <= high))
    assert histogram.summary.text() == f"{inside} of 2,000 hexes shown"


def test_dragging_over_the_column_of_inverted_hexes_includes_them(histogram, announced, drag, data):
    now = Distribution.of(*data)
    histogram.show_distributions(None, now)
    column = histogram.plot.histogram.column
    drag(0.5, sum(column) / 2)
    assert announced[-1].inverted
    low = np.count_nonzero((data[0] <= announced[-1].high) & ~data[1])
    assert histogram.summary.text() == f"{low + now.inverted:,} of 2,000 hexes shown"
    histogram.set_range(None)
    drag(*column)
    assert announced[-1] == Show((-np.inf, -np.inf), "q", inverted=True)
    assert histogram.summary.text() == f"{now.inverted} of 2,000 hexes shown"


def test_a_click_on_the_column_of_inverted_hexes_requests_them(histogram, announced, data):
    requests = []
    histogram.inverted_requested.connect(lambda: requests.append(True))
    column = point_at(histogram, sum(histogram.plot.histogram.column) / 2)
    QTest.mouseClick(histogram.plot.plot.viewport(), LEFT, pos=column)
    assert requests == []  # none of now
    histogram.show_distributions(None, Distribution.of(*data))
    QTest.mouseClick(histogram.plot.plot.viewport(), LEFT, pos=column)
    assert (requests, announced) == ([True], [])


def test_a_drag_moves_an_end_or_the_whole_range(histogram, announced, drag):
    histogram.set_range(Show((0.4, 0.6), "q"))
    drag(0.6, 0.7)
    assert ends(announced[-1]) == pytest.approx((0.4, 0.7), abs=0.011)
    drag(0.5, 0.6)
    assert ends(announced[-1]) == pytest.approx((0.5, 0.8), abs=0.021)
    drag(0.65, 1.0)
    assert ends(announced[-1])[1] == 1  # the end of q


def test_a_range_of_an_unbounded_metric_extends_to_infinity(histogram, announced, drag, condition):
    values, inverted = condition
    axis = histogram.axis
    middle = axis.low + 0.5 * (axis.high - axis.low)
    drag(middle, axis.high + 0.01 * middle)
    assert announced[-1] == histogram.range()
    assert (announced[-1].metric, announced[-1].high) == ("condition", np.inf)
    assert announced[-1].low == pytest.approx(middle, abs=0.03 * middle)
    inside = np.count_nonzero((values >= announced[-1].low) & ~inverted)
    assert histogram.summary.text() == f"{inside:,} of 2,000 hexes shown"
    assert histogram.range_row.high.text() == "∞"


def test_numbers_are_typed_in_any_notation(histogram, announced, condition, qtbot):
    typed = ((histogram.range_row.low, "2.5e0"), (histogram.range_row.high, "4"), (histogram.range_row.high, "inf"))
    for number, (box, text) in enumerate(typed, start=1):
        box.setFocus()
        type_text(box, text, enter=True)
        qtbot.waitUntil(lambda number=number: len(announced) == number)
    assert announced == [Show(ends, "condition") for ends in [(2.5, np.inf), (2.5, 4.0), (2.5, np.inf)]]
    box = histogram.range_row.low
    type_text(box, "1e-", enter=True)
    assert (histogram.range().low, box.text()) == (2.5, "2.5")  # incomplete: dropped
    QTest.mouseClick(histogram.range_row.all, LEFT)
    assert announced[-1] is None


def test_a_click_on_a_bar_shows_only_its_hexes(histogram, announced, data, qtbot):
    values, inverted = data
    histogram.show_distributions(None, Distribution.of(*data))
    bin, view = int(np.argmax(histogram.plot.histogram.series[0].counts)), histogram.plot.view
    viewport, top = histogram.plot.plot.viewport(), histogram.plot.height_at(bin + 0.5)
    QTest.mouseClick(viewport, LEFT, pos=view.mapViewToScene(QPointF(bin + 0.5, 1.05 * top)).toPoint())
    assert announced == []
    QTest.mouseClick(viewport, LEFT, pos=view.mapViewToScene(QPointF(bin + 0.5, 0.5 * top)).toPoint())
    qtbot.waitUntil(lambda: len(announced) == 1)
    low, high = histogram.axis.edges[bin : bin + 2]
    assert np.array_equal(within(values, inverted, announced[0]), (values >= low) & (values < high) & ~inverted)


# Histogram in the window: metric of the colours, brushed ranges and kept distributions.


@pytest.fixture
def front_histogram(window, qtbot):
    """Return the panel, in its default size."""
    return brought(window, qtbot, "histogram")


def brush(window, qtbot, low, high):
    """Drag over a share of the histogram, wait until the view has its range, and return the range."""
    panel, view = window.features["histogram"].panel, window.session.view
    before = view.look.show.by_quality
    QApplication.processEvents()  # lays out the axis of another metric
    axis = panel.axis
    points = [point_at(panel, axis.low + share * (axis.high - axis.low)) for share in (low, high)]
    drag(panel.plot.plot.viewport(), *points)
    qtbot.waitUntil(lambda: panel.range() == view.look.show.by_quality != before)
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
        press(front_histogram.head.keep)
        states.append(window.session.document.now)
    window.refresh()
    walk_to(window, front_histogram.head.metric_box, "condition")
    drawn = {one.name: one.distribution for one in front_histogram.shown.shown}
    names = ["Local steepest descent 1", "Local steepest descent (2) 1"]
    assert [one.name for one in window.session.snapshots.all] == names
    for name, state in zip(names, states, strict=True):
        values = METRICS["condition"].of(state.mesh.points, state.mesh.hexes, state.quality)
        np.testing.assert_array_equal(drawn[name].values, Distribution.of(values, state.quality.inverted).values)
    front_histogram.legend.kept[1].menu().actions()[1].trigger()
    assert names[1] not in [one.name for one in window.session.snapshots.all]
    open_and_wait(qtbot, window, mesh_file)
    window.refresh()
    assert [one.name for one in front_histogram.shown.shown] == ["now", "at the start"]


def test_a_click_on_the_column_of_inverted_hexes_shows_only_them(window, front_histogram):
    QTest.mouseClick(
        front_histogram.plot.plot.viewport(),
        LEFT,
        pos=point_at(front_histogram, sum(front_histogram.plot.histogram.column) / 2),
    )
    window.refresh()
    assert window.canvas.viewport.shown == window.session.document.now.quality.n_inverted > 0
    key(window, Qt.Key.Key_Escape)
    assert window.canvas.viewport.shown == 4000


@pytest.mark.slow
def test_the_cells_of_one_kind_are_counted(window, qtbot, front_histogram, tmp_path):
    head = front_histogram.head
    assert not head.kind_box.isVisible()  # of a mesh of hexes only
    open_mesh(qtbot, window, tmp_path / "mixed.vtu", mixed(3))
    assert front_histogram.summary.text() == "72 cells, 0 inverted"
    assert [head.kind_box.itemText(k) for k in range(head.kind_box.count())] == [
        "All cells", "Hexes", "Wedges", "Pyramids", "Tetrahedra",
    ]  # fmt: skip
    walk_to(window, head.kind_box, "pyramid")
    assert front_histogram.summary.text() == "30 pyramids, 0 inverted"
    walk_to(window, head.kind_box, "")
    walk_to(window, head.metric_box, "skew")
    assert front_histogram.summary.text() == "12 cells, 0 inverted"  # others have none
    texts = [label.text() for label in window.findChildren(HexCounts)]
    assert "12 hexes, 18 wedges, 30 pyramids, 12 tetrahedra" in texts[0]
