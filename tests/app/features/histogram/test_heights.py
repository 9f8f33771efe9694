"""Heights of the bars of the histogram, on both scales."""

import numpy as np
import pytest
from PySide6.QtTest import QTest

from tests.app.driving import LEFT


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
