"""Which way each figure of a summary is better."""

from hexmend.quality import METRICS
from hexmend.quality.summary import FIGURES


def test_counts_extremes_and_spreads_have_no_better_way_and_all_others_have():
    better = {name: figure.better for name, figure in FIGURES.items()}
    assert {name for name, way in better.items() if way == -1} == {"inverted", "locked_inverted", "objective"}
    assert {name for name, way in better.items() if way == 1} == {"q_min", "q_mean", "q_norm", "scaled_jacobian_min"}
    assert set(better.values()) == {-1, 0, 1}


def test_no_metric_is_best_both_at_its_least_and_at_its_greatest():
    assert {metric.better for metric in METRICS.values()} <= {-1, 0, 1}
    assert METRICS["scaled-jacobian"].better == METRICS["q"].better == 1
    assert METRICS["condition"].better == METRICS["skew"].better == -1
