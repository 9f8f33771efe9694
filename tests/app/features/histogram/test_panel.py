"""Panel of the histogram: tooltips, legend, controls and layout."""

import numpy as np
import pytest
from PySide6.QtCore import QPoint, Qt
from PySide6.QtTest import QTest

from hexmend_app.features.histogram.axis import Axis
from hexmend_app.features.histogram.bins import distribute
from hexmend_app.features.histogram.distributions import Distributions
from tests.app.driving import LEFT, turn, type_text


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
