"""Panel of the histogram: tooltips, legend, controls and layout."""

from itertools import cycle

import numpy as np
import pytest
from PySide6.QtCore import QPoint, Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QToolTip

from hexmend.quality import METRICS
from hexmend_app.features.histogram.axis import Axis
from hexmend_app.picture.visibility import Show
from tests.app.driving import LEFT, turn
from tests.app.features.histogram.mouse import point_at
from tests.patience import PATIENCE


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


@pytest.mark.parametrize("kept", [0, 6])
def test_the_plot_has_160_pixels_in_a_low_panel(histogram, data, kept):
    histogram.resize(600, 230)
    histogram.set_snapshots([(slot, f"getme {slot}", *data) for slot in range(kept)])
    turn()
    assert histogram.size().height() == 230
    assert histogram.plot.height() >= 160
    space = histogram.plot.view.sceneBoundingRect()
    legend = histogram.legend.geometry()
    assert legend.right() <= histogram.plot.width()
    low, high = histogram.plot.plot.viewRange()[1]
    bars = space.height() * (histogram.plot.heights.at_fraction(1) - low) / (high - low)
    assert bars >= 80
    if kept == 0:
        assert space.height() - bars >= legend.height()  # nothing is drawn below the legend


def test_the_summary_is_one_line_and_does_not_move_the_plot(histogram):
    histogram.resize(600, 230)
    turn()
    before = histogram.plot.geometry()
    for range in (None, Show((0.123, 0.789), "q", True), Show((0.2, 0.3), "q")):
        histogram.set_range(range)
        turn()
        assert histogram.plot.geometry() == before
        assert histogram.summary.height() < 2 * histogram.fontMetrics().height()
        assert histogram.summary.toolTip() == histogram.summary.text()


def test_the_plot_has_no_menu_and_no_buttons_and_does_not_zoom(histogram):
    plot = histogram.plot.plot
    assert not plot.getPlotItem().menuEnabled()
    assert plot.getPlotItem().buttonsHidden
    before = plot.viewRange()
    QTest.mouseClick(plot.viewport(), Qt.MouseButton.RightButton, pos=point_at(histogram, 0.5))
    assert QApplication.activePopupWidget() is None
    assert plot.viewRange() == before


@pytest.mark.parametrize("name", METRICS)
def test_every_metric_fits_a_narrow_panel_without_changing_its_width(histogram, name):
    narrow = histogram.minimumSizeHint().width()
    histogram.set_metric(name)
    histogram.set_initial(np.linspace(1e-6, 3.456e-5, 2000), np.zeros(2000, bool))
    assert histogram.minimumSizeHint().width() == narrow <= 270
    histogram.resize(narrow, 268)
    turn()
    for control in (
        *histogram.range_row.controls,
        histogram.head.metric_box,
        histogram.head.scale,
        histogram.head.more,
    ):
        right = control.mapTo(histogram, control.rect().topRight()).x()
        assert 0 < right < narrow
        assert control.width() >= (control.minimumWidth() or control.minimumSizeHint().width())


def test_inverted_hexes_have_a_separate_bar_for_every_metric(histogram):
    values, inverted = np.linspace(1.0, 1.4, 2000), np.arange(2000) % 4 == 0
    for name in METRICS:
        histogram.set_metric(name)
        histogram.set_initial(values, inverted)
        histogram.set_current(values, inverted)
        assert histogram.describe_at(sum(histogram.axis.inverted) / 2).endswith("now: 500 hexes")
        assert "inverted" in dict(histogram.axis.ticks()).values()


def test_the_number_of_bins_is_set_in_the_menu(histogram, data):
    bins = histogram.head.bins
    histogram.head.more.menu().popup(QPoint(0, 0))
    bins.setFocus()
    QTest.keyClick(bins, Qt.Key.Key_Up)
    assert len(histogram.series()[0].distribution.counts) == 60
    assert len(histogram.plot.outlines["now"].curve.yData) == 60
    histogram.head.more.menu().close()
    bins.setValue(200)
    assert (
        histogram.series()[0].distribution.counts.tolist() == np.histogram(data[0][~data[1]], 200, (0, 1))[0].tolist()
    )
    assert "q(H) 0.510 – 0.515" in histogram.describe_at(0.511)


def test_snapshots_are_drawn_renamed_and_removed(histogram, data):
    signals = []
    histogram.renamed.connect(lambda *signal: signals.append(signal))
    histogram.removed.connect(lambda slot: signals.append(slot))
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
    name.selectAll()
    QTest.keyClicks(name, "Laplace")
    QTest.keyClick(name, Qt.Key.Key_Return)
    QTest.mouseClick(histogram.legend.entries[3].cross, LEFT)
    assert signals == [(0, "Laplace"), 3]
    histogram.set_snapshots(snapshots[:1])
    turn()
    assert list(histogram.legend.entries) == [0]
    assert len(histogram.plot.outlines) == 3


def test_an_empty_name_is_ignored(histogram, data):
    signals = []
    histogram.renamed.connect(lambda *signal: signals.append(signal))
    histogram.set_snapshots([(1, "mend 4", *data)])
    turn()
    name = histogram.legend.entries[1].name
    QTest.mouseClick(name, LEFT)
    name.selectAll()
    QTest.keyClick(name, Qt.Key.Key_Backspace)
    QTest.keyClick(name, Qt.Key.Key_Return)
    assert signals == []
    assert name.text() == "mend 4"


def test_the_tooltip_has_the_counts_of_all_distributions(histogram, data, qtbot):
    histogram.set_snapshots([(0, "laplacian 5", *data)])
    turn()
    viewport = histogram.plot.plot.viewport()

    positions = cycle((0.3, 0.705))  # a tooltip appears after a mouse move, but not after every quick one

    def tooltip_shown():
        QTest.mouseMove(viewport, point_at(histogram, next(positions)))
        turn()
        return QToolTip.text() == histogram.describe_at(0.705)

    qtbot.waitUntil(tooltip_shown, timeout=PATIENCE)
    assert [row.partition(":")[0] for row in QToolTip.text().splitlines()[1:]] == ["at the start", "now", "laplacian 5"]


def test_the_axis_does_not_change_with_the_values(histogram, condition):
    before = histogram.axis, histogram.plot.plot.viewRange()[0]
    for share in (0.5, 0.2, 5.0):
        histogram.set_current(1 + share * np.linspace(0, 9, 2000), np.zeros(2000, bool))
        assert (histogram.axis, histogram.plot.plot.viewRange()[0]) == before


def test_the_line_below_counts_hexes_that_are_invalid_inside(histogram, data):
    assert histogram.summary.text() == "2,000 hexes, 0 inverted"
    histogram.set_current(data[0], np.zeros(2000, bool), 2)
    assert histogram.summary.text() == "2,000 hexes, 0 inverted · 2 invalid inside"
