"""Better end of each quantity of a summary, and its old keyword."""

import numpy as np

from hexmend.quality import METRICS, SUMMARY_QUANTITIES, measure


def test_counts_extremes_and_spreads_have_no_better_way_and_all_others_have():
    better = {name: figure.better for name, figure in SUMMARY_QUANTITIES.items()}
    lower, higher = ({name for name, way in better.items() if way == end} for end in (-1, 1))
    assert lower == {"inverted", "locked_inverted", "invalid", "objective"}
    assert higher == {"min_jacobian", "q_min", "q_mean", "q_norm", "scaled_jacobian_min"}
    assert set(better.values()) == {-1, 0, 1}


def test_no_metric_is_best_both_at_its_least_and_at_its_greatest():
    assert {metric.better for metric in METRICS.values()} <= {-1, 0, 1}
    assert METRICS["scaled-jacobian"].better == METRICS["q"].better == 1
    assert METRICS["condition"].better == METRICS["skew"].better == -1


def test_a_hex_so_large_that_its_volume_is_no_number_has_the_worst():
    huge = np.float64(1e200) * np.random.default_rng(1).normal(size=(8, 3))
    hexes = np.arange(8, dtype=np.int32)[None]
    with np.errstate(all="ignore"):
        values = {name: metric.of(huge, hexes, measure(huge, hexes)) for name, metric in METRICS.items()}
    assert values["jacobian"].tolist() == [-np.inf]
    assert not any(np.isnan(one).any() for one in values.values())
