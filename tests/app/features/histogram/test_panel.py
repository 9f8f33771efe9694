"""Panel of the histogram: tooltips, legend, controls and layout."""

import numpy as np
from PySide6.QtCore import QPoint, Qt
from PySide6.QtTest import QTest

from hexmend.quality import METRICS
from hexmend_app.features.histogram.axis import Axis
from tests.app.driving import LEFT, turn


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
    name.selectAll()
    QTest.keyClicks(name, "Laplace")
    QTest.keyClick(name, Qt.Key.Key_Return)
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
