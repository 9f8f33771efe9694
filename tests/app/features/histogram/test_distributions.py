"""Distributions of the histogram, counted again for another axis or number of bins."""

import numpy as np
import pytest

from hexmend_app.features.histogram.axis import Axis
from hexmend_app.features.histogram.bins import distribute
from hexmend_app.features.histogram.distributions import Distributions

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
