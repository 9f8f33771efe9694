"""Values of runs as curves."""

import numpy as np
import pytest

from hexmend.run import StoppingCriteria, iterate
from hexmend.smoothers import METHODS
from hexmend_app.features.convergence.charts import CHARTS
from hexmend_app.features.convergence.curves import Columns, Curve, run_start
from hexmend_app.state.mesh.document import State
from hexmend_app.state.mesh.history import History, RecordedIteration, RunRecord
from tests.core.grids import grid, scrambled

START = State.of(scrambled(grid(4), 0.4))


def recorded(method, iterations=6, parent=None):
    history = History()
    record = history.begin(METHODS[method].title, START)
    record.parent = parent
    run = iterate(START.mesh, METHODS[method](), StoppingCriteria(max_iterations=iterations, tolerance=0))
    history.add(record, run.start)
    for iteration in run:
        history.add(record, iteration)
    return record


@pytest.mark.parametrize("method", ["laplacian", "local-sd", "global-nr", "mend"])
def test_columns_have_the_values_of_the_rows_and_nan_elsewhere(method):
    record = recorded(method)
    columns = Columns(record)
    columns.grow()
    assert len(columns) == len(record.rows)
    for chart in CHARTS.values():
        for key in (one.key for one in chart.quantities):
            found = columns.of(key)
            if key == "step_seconds":
                expected = [None, *np.diff([row["seconds"] for row in record.rows])]
            else:
                expected = [row.get(key) for row in record.rows]
            if key == "largest_move":
                expected[0] = None
            np.testing.assert_array_equal(found, [np.nan if one is None else one for one in expected])
            assert columns.reports(key) == np.isfinite(found).any()
    assert columns.reports("gradient_norm") == (method in ("global-nr", "mend"))


def test_columns_grow_with_the_run_however_long_it_is():
    record = RunRecord("a", "A", START, None)
    columns = Columns(record)
    for length in (1, 63, 64, 65, 500):
        while len(record.rows) < length:
            record.rows.append({"iteration": len(record.rows), "seconds": 0.5 * len(record.rows), "q_min": 0.25})
        columns.grow()
        assert len(columns) == length
        np.testing.assert_array_equal(columns.seconds, 0.5 * np.arange(length))
        assert (columns.of("q_min") == 0.25).all()
        assert np.isnan(columns.of("delta")).all()


def test_a_branch_begins_where_it_left_its_parent():
    trunk = recorded("laplacian")
    branch = recorded("local-sd", 4, RecordedIteration(trunk, 3))
    twig = recorded("getme", 2, RecordedIteration(branch, 2))
    assert run_start(trunk) == (0, 0)
    assert run_start(twig)[0] == 5
    assert run_start(twig)[1] == trunk.rows[3]["seconds"] + branch.rows[2]["seconds"]
    columns = Columns(twig)
    columns.grow()
    curve = Curve(columns, 0, run_start(twig), True, True, False, twig.numbers)
    assert curve.x(by_time=False).tolist() == [5, 6, 7]
    assert curve.nearest(5.6, by_time=False) == 1
    assert curve.nearest(-3, by_time=False) == 0
    assert curve.nearest(curve.x(by_time=True)[2] + 1, by_time=True) == 2
