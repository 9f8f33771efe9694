"""The histogram under the mouse: what is told, named and offered."""

from itertools import cycle

import numpy as np
import pytest
from PySide6.QtCore import Qt
from PySide6.QtGui import QActionGroup
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QToolTip

from hexmend.quality import METRICS
from hexmend_app.features.histogram.axis import Axis
from hexmend_app.picture.appearance import ValueRange
from tests.app.driving import LEFT, turn
from tests.app.features.histogram.brushing import place
from tests.patience import PATIENCE


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


@pytest.mark.parametrize("name", METRICS)
def test_every_metric_fits_into_a_narrow_column_which_holds_its_width(histogram, name):
    narrow = histogram.minimumSizeHint().width()
    histogram.set_metric(name)
    histogram.set_initial(np.linspace(1e-6, 3.456e-5, 2000), np.zeros(2000, bool))
    assert histogram.minimumSizeHint().width() == narrow <= 270
    histogram.resize(narrow, 268)
    turn()
    for part in (*histogram.ends.parts, histogram.head.metric_box, histogram.head.scale, histogram.head.more):
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
    QTest.mouseClick(name, LEFT)
    name.selectAll()
    QTest.keyClicks(name, "Laplace")
    QTest.keyClick(name, Qt.Key.Key_Return)
    QTest.mouseClick(histogram.legend.entries[3].cross, LEFT)
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
    QTest.mouseClick(name, LEFT)
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
