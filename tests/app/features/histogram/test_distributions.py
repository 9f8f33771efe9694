"""What the histogram draws, counted anew where its axis or its bins are others."""

import numpy as np
import pytest

from hexmend_app.features.histogram.axis import Axis
from hexmend_app.features.histogram.bins import distribute
from hexmend_app.features.histogram.distributions import Distributions

Q = np.random.default_rng(3).beta(6, 2, 300)
LONG = 1 + np.random.default_rng(4).gamma(2, 3, 300)
SOUND = np.zeros(300, bool)


def counts(part):
    return part.below, part.counts.tolist(), part.above, part.inverted


def test_series_stand_in_the_order_of_the_legend():
    distributions = Distributions()
    assert distributions.series() == []
    distributions.set_kept([(0, "before", Q, SOUND), (2, "later", Q**2, SOUND)])
    distributions.set_current(Q, SOUND)
    distributions.set_initial(Q, SOUND)
    assert [one.name for one in distributions.series()] == ["at the start", "now", "before", "later"]
    assert [one.current for one in distributions.series()] == [False, True, False, False]


@pytest.mark.parametrize("change", ["the axis", "the bins"])
def test_all_are_counted_anew(change):
    distributions = Distributions()
    distributions.begin("aspect-ratio")
    distributions.set_current(LONG, SOUND)
    distributions.set_kept([(1, "kept", LONG / 2, SOUND)])
    before, bins = distributions.axis, 50
    if change == "the axis":
        distributions.set_initial(LONG, SOUND)
        assert distributions.axis == Axis.fitted("aspect-ratio", LONG, SOUND) != before
    else:
        bins = 20
        distributions.divide(bins)
        assert distributions.axis == before
    now, kept = (one.part for one in distributions.series()[-2:])
    assert counts(now) == counts(distribute(LONG, SOUND, distributions.axis, bins))
    assert counts(kept) == counts(distribute(LONG / 2, SOUND, distributions.axis, bins))


def test_what_is_kept_already_is_not_counted_again():
    distributions = Distributions()
    distributions.set_kept([(0, "one", Q, SOUND)])
    ((_, _, part),) = distributions.kept
    distributions.set_kept([(0, "renamed", Q, SOUND), (1, "other", Q, SOUND)])
    assert [(slot, name) for slot, name, _ in distributions.kept] == [(0, "renamed"), (1, "other")]
    assert distributions.kept[0][2] is part


def test_another_metric_begins_with_nothing():
    distributions = Distributions()
    distributions.set_initial(Q, SOUND)
    distributions.set_current(Q, SOUND)
    distributions.set_kept([(0, "one", Q, SOUND)])
    distributions.begin("scaled-jacobian")
    assert distributions.axis.metric == "scaled-jacobian"
    assert distributions.series() == distributions.kept == []


def test_lengths_must_agree():
    with pytest.raises(ValueError, match="same length"):
        Distributions().set_initial(Q, SOUND[1:])
