"""The chart of a run."""

import numpy as np

from hexmend_app.widgets.progress_chart import ProgressChart


def test_what_is_added_is_drawn_and_in_sight(shown):
    chart = shown(ProgressChart())
    for k in range(20):
        chart.add(k, 0.01 * k, 0.5 + 0.01 * k, 100 - 5 * k)
    rows = chart.rows()
    assert rows.shape == (20, 4)
    for column, name in enumerate(("min", "mean", "inverted"), start=1):
        x, y = chart._lines[name].getOriginalDataset()
        assert np.array_equal(x, rows[:, 0])
        assert np.array_equal(y, rows[:, column])
    (left, right), (_, top) = chart._inverted.viewRange()
    assert left <= 0
    assert right >= 19
    assert top > 100


def test_a_new_run_begins_empty(shown):
    chart = shown(ProgressChart())
    chart.add(0, 0.1, 0.2, 3)
    chart.clear()
    assert len(chart.rows()) == 0
    chart.add(0, 0.1, 0.2, 3)
    assert len(chart.rows()) == 1
