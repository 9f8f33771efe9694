"""Values of runs as curves."""

import numpy as np
import pytest
from PySide6.QtCore import QPointF, Qt
from PySide6.QtTest import QTest

from benchmarks.window.windows import end_run
from hexmend import METHODS, StoppingCriteria, iterate
from hexmend_app.features.convergence.charts import CHARTS
from hexmend_app.features.convergence.curves import Columns, Curve, run_start
from hexmend_app.state.mesh.document import State
from hexmend_app.state.mesh.history import History, RecordedIteration, RunRecord
from hexmend_app.state.run.run_controller import Phase
from tests.app.driving import LEFT, brought, choose, click_until, press, smooth
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


# Convergence charts in the window.


@pytest.fixture
def panel(window, qtbot):
    return brought(window, qtbot, "convergence")


def run(window, qtbot, method="local-sd", iterations=8):
    smooth(qtbot, window.session, method, iterations)
    window.refresh()
    return window.session.run.record


def click_at(panel, key, x):
    plot = panel.plots[key]
    at = plot.plot.mapFromScene(plot.view.mapViewToScene(QPointF(x, sum(plot.view.viewRange()[1]) / 2)))
    QTest.mouseClick(plot.plot.viewport(), LEFT, Qt.KeyboardModifier.NoModifier, at)


@pytest.mark.slow
def test_a_click_in_a_chart_selects_the_iteration_and_moves_the_marker(window, qtbot, panel):
    record = run(window, qtbot)
    assert len(panel.curves[0].columns) == 9
    click_at(panel, "inverted", 3)
    qtbot.waitUntil(lambda: window.session.timeline.shown_iteration.number == 3)
    window.refresh()
    assert window.session.document.previews
    assert panel.plots["inverted"].marker.value() == 3
    window.session.timeline.go(record, 6)
    window.refresh()
    assert panel.plots["objective"].marker.value() == 6


@pytest.mark.slow
def test_branches_start_where_they_left_or_at_zero_and_are_deleted(window, qtbot, panel):
    first = run(window, qtbot)
    window.session.timeline.go(first, 4)
    second = run(window, qtbot, "laplacian", 3)
    starts = {one.record: one.start[0] for one in panel.curves}
    assert starts == {first: 0, second: 4}
    assert {one.record: one.current for one in panel.curves} == {first: False, second: True}
    panel.head.from_zero.trigger()
    assert [one.start[0] for one in panel.curves] == [0, 0]
    slots = {one.record: one.slot for one in panel.curves}
    press(panel.legend.rows[first].cross)
    assert [one.record for one in panel.curves] == [second]
    third = run(window, qtbot, "getme", 2)
    assert {one.record: one.slot for one in panel.curves} == {second: slots[second], third: slots[first]}
    box = panel.legend.rows[third].box
    QTest.keyClick(box, Qt.Key.Key_Space)
    assert [one.shown for one in panel.curves] == [True, False]


@pytest.mark.slow
def test_charts_are_redrawn_during_a_run_by_a_timer(window, qtbot, panel):
    drawn = []
    original = panel.set_curves
    panel.set_curves = lambda curves: (drawn.append(len(curves[0].columns) if curves else 0), original(curves))
    choose(window, "local-sd", StoppingCriteria(max_iterations=100_000, tolerance=0))
    click_until(window, qtbot, "Run", Phase.RUNNING)
    qtbot.waitUntil(lambda: len(drawn) > 0)
    drawn.clear()
    for _ in range(20):
        window.refresh()
    assert len(drawn) <= 1
    qtbot.waitUntil(lambda: len(drawn) >= 6)
    assert drawn == sorted(drawn)
    assert drawn[-1] > drawn[0]
    end_run(window.session)
    qtbot.waitUntil(lambda: drawn[-1] == window.session.run.record.newest + 1)
