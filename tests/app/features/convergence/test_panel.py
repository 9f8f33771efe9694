"""Convergence charts by mouse and keys."""

import numpy as np
import pytest
from PySide6.QtCore import QPointF, Qt
from PySide6.QtGui import QPainter, QPicture
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QLabel

from benchmarks.window.windows import end_run
from hexmend import METHODS, StoppingCriteria, iterate
from hexmend_app.features.convergence.convergence_plot import ConvergencePlot, describe, reason_if_blank
from hexmend_app.features.convergence.curves import CHARTS, Curve, run_start
from hexmend_app.features.convergence.panel import ConvergencePanel
from hexmend_app.state.mesh.document import MeasuredMesh
from hexmend_app.state.mesh.history import History
from hexmend_app.state.mesh.run_record import RecordedIteration, RunRecord
from hexmend_app.state.run.run_controller import Phase
from tests.app.driving import LEFT, brought, choose, click_until, drag, smooth, turn
from tests.core.grids import grid, scrambled

START = MeasuredMesh.of(grid(2))


def record(name, count, parent=None, **more):
    record = RunRecord(name, name.title(), START, parent)
    record.rows = [
        {
            "iteration": k,
            "seconds": 0.1 * k,
            "objective": None if k < 3 else 1000.0 / k,
            "q_min": 0.5 * k / count,
            "q_mean": 0.9,
            "scaled_jacobian_min": 0.2,
            "inverted": max(0, 100 - 30 * k),
            "largest_move": 1.0 / (k + 1),
            **more,
        }
        for k in range(count)
    ]
    return record


def curve(record, slot=0, start=(0.0, 0.0), shown=True, current=True, running=False):
    return Curve(record, slot, start, shown, current, running)


TRUNK = record("getme", 21)
BRANCH = record("local-sd", 9, RecordedIteration(TRUNK, 8), delta=0.01)
BOTH = (curve(TRUNK), curve(BRANCH, 1, (8.0, 0.8), current=False))


@pytest.fixture
def panel(shown):
    panel = shown(ConvergencePanel(), 640, 300)
    panel.set_curves(BOTH)
    turn()
    return panel


def place(panel, key, x, y=None):
    """Return the widget of a chart and a position in it; y in the coordinates of the axis, or the middle."""
    plot = panel.plots[key]
    (low, high) = plot.view.viewRange()[1]
    at = plot.view.mapViewToScene(QPointF(x, (low + high) / 2 if y is None else y))
    return plot.plot.viewport(), plot.plot.mapFromScene(at)


def test_quality_has_a_third_curve_on_an_axis_that_extends_to_negative_scaled_jacobians(panel):
    plot = panel.plots["quality"]
    tangled = record("mend", 6, scaled_jacobian_min=-0.5)
    panel.set_curves([curve(tangled)])
    assert plot.view.viewRange()[1][0] < -1
    assert len(plot.lines) == 3
    assert "scaled Jacobian min -0.5" in describe(plot.chart, [curve(tangled)], 3, by_time=False).replace("−", "-")
    panel.set_curves([curve(record("mend", 6, scaled_jacobian_min=0.5))])
    assert -0.5 < plot.view.viewRange()[1][0] < 0


def test_invalid_hexes_have_a_curve_in_the_chart_of_inverted_ones(panel):
    plot, mended = panel.plots["inverted"], curve(record("mend", 6, invalid=7))
    panel.set_curves([mended])
    assert len(plot.lines) == 2
    assert describe(plot.chart, [mended], 3, by_time=False).startswith("mend 3: inverted 10, invalid 7")


def test_a_logarithmic_axis_has_a_position_for_zero_and_infinity_is_a_gap(panel):
    inverted, objective = panel.plots["inverted"], panel.plots["objective"]
    heights = inverted.heights(np.array([100.0, 10.0, 0.0]))
    assert heights.tolist() == [2, 1, -1]
    assert inverted.zero == -1
    _, y = objective.lines[0].getData()
    assert np.isnan(y[:3]).all()
    assert np.isfinite(y[3:]).all()
    panel.head.log.trigger()
    assert inverted.heights(np.array([100.0, 0.0])).tolist() == [100, 0]


def test_every_chart_can_be_drawn_alone(panel):
    for action in panel.head.charts.values():
        action.setChecked(False)
    assert panel.drawn == []
    for key in CHARTS:
        panel.head.charts[key].trigger()
        assert [plot.chart.key for plot in panel.drawn] == [key]
        assert panel.plots[key].isVisible()
        panel.head.charts[key].trigger()


def test_a_click_goes_to_the_iteration_of_the_current_run_or_of_the_curve_it_hits(panel):
    emitted = []
    panel.picked.connect(lambda record, number: emitted.append((record.name, number)))
    panel.resize(640, 700)
    turn()
    for where in (("objective", 4.2), ("quality", 16.0, BOTH[1].of("q_min")[8])):
        widget, at = place(panel, *where)
        QTest.mouseClick(widget, LEFT, pos=at)
    assert emitted == [("getme", 4), ("local-sd", 8)]


def test_a_drag_selects_iterations_of_one_run(panel):
    emitted = []
    panel.picked.connect(lambda record, number: emitted.append((record.name, number)))
    (widget, start), (_, end) = (place(panel, "inverted", x) for x in (2, 18))
    drag(widget, start, end)
    numbers = [number for _, number in emitted]
    assert {name for name, _ in emitted} == {"getme"}
    assert numbers == sorted(numbers)
    assert numbers[-1] == 18


def test_the_iteration_shown_is_marked_on_its_branch(panel):
    panel.set_shown(BRANCH, 3)
    assert {plot.marker.value() for plot in panel.drawn} == {11.0}
    panel.head.by_time.trigger()
    assert panel.drawn[0].marker.value() == pytest.approx(1.1)
    panel.set_shown(None)
    assert not panel.drawn[0].marker.isVisible()


def test_the_curve_of_the_objective_has_a_gap_where_a_stage_changes_it(panel):
    stages = record("recipe", 9)
    for row in stages.rows:
        row["objective_formula"] = "Σ η²" if row["iteration"] < 5 else "Σ η⁴, offset 0"
    one = curve(stages)
    x, y = one.drawn("objective", by_time=False)
    assert len(x) == len(y) == 10
    assert np.flatnonzero(np.isnan(x)).tolist() == [5]
    assert np.isnan(y[5])
    assert len(one.drawn("q_min", by_time=False)[0]) == 9
    assert describe(CHARTS["objective"], [one], 4, by_time=False) == "recipe 4: objective Σ η² 250.000"
    assert describe(CHARTS["objective"], [one], 5, by_time=False) == "recipe 5: objective Σ η⁴, offset 0 200.000"
    panel.set_curves([one])
    turn()
    _, y = panel.plots["objective"].lines[0].getData()
    assert np.isnan(y[5])


def test_the_objective_has_a_gap_where_the_minima_begin_to_rise_and_tooltips_say_so(panel):
    balanced = record("mend", 9)
    for row in balanced.rows[5:8]:
        row |= {"least": 0.2, "least_q": 0.4}
    one = curve(balanced)
    x, _ = one.drawn("objective", by_time=False)
    assert np.flatnonzero(np.isnan(x)).tolist() == [5]
    text = "objective 200.000, may rise while the minima are raised"
    assert describe(CHARTS["objective"], [one], 5, by_time=False) == f"mend 5: {text}"
    assert "may rise" not in describe(CHARTS["objective"], [one], 4, by_time=False)


def test_tooltips_give_the_values_of_each_run(panel):
    text = describe(CHARTS["quality"], BOTH, 9.8, by_time=False)
    assert text.splitlines() == [
        "getme 10: q min 0.2381, q mean 0.9000, scaled Jacobian min 0.2000",
        "local-sd 2: q min 0.1111, q mean 0.9000, scaled Jacobian min 0.2000",
    ]
    assert describe(CHARTS["objective"], BOTH[:1], 0, by_time=False) == "getme 0: objective infinite"
    assert describe(CHARTS["delta"], BOTH[:1], 4, by_time=False) == "getme 4: delta not reported"
    assert describe(CHARTS["inverted"], BOTH, 40, by_time=False) == ""
    paused = record("mend", 5)
    paused.pauses[3] = "Hex 7 inverted"
    assert describe(CHARTS["inverted"], [curve(paused)], 3, by_time=False).endswith("paused: Hex 7 inverted")
    assert " at 0.4 s: " in describe(CHARTS["inverted"], BOTH[:1], 0.41, by_time=True)


def test_runs_are_hidden_in_the_list(panel):
    toggled = []
    panel.runs.toggled.connect(lambda record, on: toggled.append((record, on)))
    assert [panel.runs.item(row).text() for row in range(panel.runs.count())] == ["getme", "local-sd"]
    assert [panel.runs.item(row).font().bold() for row in range(2)] == [True, False]
    panel.runs.setCurrentRow(1)
    QTest.keyClick(panel.runs, Qt.Key.Key_Space)
    assert toggled == [(BRANCH, False)]
    panel.set_curves((curve(TRUNK, running=True), curve(BRANCH, 1, (8.0, 0.8), shown=False, current=False)))
    assert len(panel.plots["objective"].lines) == 1
    panel.set_curves(())
    assert panel.runs.count() == 0
    assert not panel.head.save.isEnabled()


def test_the_last_text_of_the_axis_is_inside_the_chart(panel):
    for plot in panel.drawn:
        axis = plot.plot.getAxis("bottom")
        picture = QPicture()
        painter = QPainter(picture)
        *_, texts = axis.generateDrawSpecs(painter)
        painter.end()
        assert texts
        assert all(rect.right() + axis.scenePos().x() <= plot.plot.width() for rect, *_ in texts)


def test_axes_change_seldom_during_a_run(panel):
    growing = record("getme", 200)
    rows, growing.rows = growing.rows, growing.rows[:100]
    spans = set()
    for count in range(100, 200):
        growing.rows = rows[:count]
        panel.set_curves((curve(growing, running=True),))
        low, high = panel.drawn[0].view.viewRange()[0]
        assert high >= count - 1
        spans.add((low, high))
    assert len(spans) < 25


# Texts of empty charts.


OBJECTIVE, DELTA = CHARTS["objective"], CHARTS["delta"]


def of(inverted, name="laplacian", rows=4, **options):
    """Return a curve with a constant number of inverted hexes, and an objective if it is 0."""
    return curve(record(name, rows, objective=None if inverted else 5.0, inverted=inverted), **options)


@pytest.mark.parametrize(("inverted", "text"), [(1, "1 inverted hex"), (40, "40 inverted hexes")])
def test_charts_report_an_infinite_objective(inverted, text):
    assert reason_if_blank(OBJECTIVE, [of(inverted)]) == f"The objective is infinite: {text}."
    assert "infinite" in reason_if_blank(OBJECTIVE, [of(inverted, rows=1)])  # before the first iteration too


def test_reasons_are_unreported_quantities_and_deselected_runs():
    assert reason_if_blank(DELTA, [of(0), of(0)]) == "No run reports its delta."
    assert reason_if_blank(DELTA, [of(0, rows=1)]) == ""  # it may report it later
    assert reason_if_blank(OBJECTIVE, [of(0, shown=False)]) == "No run selected."


def test_the_reason_is_shown_in_the_chart_until_there_is_a_curve(shown):
    plot = shown(ConvergencePlot(OBJECTIVE), 400, 120)
    label = next(one for one in plot.findChildren(QLabel) if one.accessibleName().startswith("Why the chart"))
    plot.draw([of(40)], False, True)
    assert "40 inverted hexes" in label.text()
    assert label.isVisible()
    assert plot.plot.rect().contains(label.geometry())
    plot.draw([of(0)], False, True)
    assert label.text() == ""


# Values of runs as curves.


SCRAMBLED = MeasuredMesh.of(scrambled(grid(4), 0.4))


def recorded(method, iterations=6, parent=None):
    history = History()
    record = history.begin(METHODS[method].title, SCRAMBLED)
    record.parent = parent
    run = iterate(SCRAMBLED.mesh, METHODS[method](), StoppingCriteria(max_iterations=iterations, tolerance=0))
    history.add(record, run.start)
    for iteration in run:
        history.add(record, iteration)
    return record


@pytest.mark.parametrize("method", ["laplacian", "local-sd", "global-nr", "mend"])
def test_curves_have_the_values_of_the_rows_and_nan_elsewhere(method):
    record = recorded(method)
    drawn = Curve(record, 0)
    for chart in CHARTS.values():
        for key in (one.key for one in chart.quantities):
            found = drawn.of(key)
            if key == "step_seconds":
                expected = [None, *np.diff([row["seconds"] for row in record.rows])]
            else:
                expected = [row.get(key) for row in record.rows]
            if key == "largest_move":
                expected[0] = None
            np.testing.assert_array_equal(found, [np.nan if one is None else one for one in expected])
    assert np.isfinite(drawn.of("gradient_norm")).any() == (method in ("global-nr", "mend"))


def test_a_branch_begins_where_it_left_its_parent():
    trunk = recorded("laplacian")
    branch = recorded("local-sd", 4, RecordedIteration(trunk, 3))
    twig = recorded("getme", 2, RecordedIteration(branch, 2))
    assert run_start(trunk) == (0, 0)
    assert run_start(twig)[0] == 5
    assert run_start(twig)[1] == trunk.rows[3]["seconds"] + branch.rows[2]["seconds"]
    curve = Curve(twig, 0, run_start(twig))
    assert curve.x(by_time=False).tolist() == [5, 6, 7]
    assert curve.nearest(5.6, by_time=False) == 1
    assert curve.nearest(-3, by_time=False) == 0
    assert curve.nearest(curve.x(by_time=True)[2] + 1, by_time=True) == 2


# Convergence charts in the window.


@pytest.fixture
def docked(window, qtbot):
    return brought(window, qtbot, "convergence")


def run(window, qtbot, method="local-sd", iterations=8):
    smooth(qtbot, window.session, method, iterations)
    window.refresh()
    return window.session.run.record


@pytest.mark.slow
def test_a_click_in_a_chart_selects_the_iteration_and_moves_the_marker(window, qtbot, docked):
    record = run(window, qtbot)
    assert len(docked.curves[0].rows) == 9
    chart, at = place(docked, "inverted", 3)
    QTest.mouseClick(chart, LEFT, pos=at)
    qtbot.waitUntil(lambda: window.session.timeline.shown_iteration.number == 3)
    window.refresh()
    assert window.session.document.previews
    assert docked.plots["inverted"].marker.value() == 3
    window.session.timeline.go(record, 6)
    window.refresh()
    assert docked.plots["objective"].marker.value() == 6


@pytest.mark.slow
def test_branches_start_where_they_left_or_at_zero_and_are_deleted(window, qtbot, docked):
    first = run(window, qtbot)
    window.session.timeline.go(first, 4)
    second = run(window, qtbot, "laplacian", 3)
    starts = {one.record: one.start[0] for one in docked.curves}
    assert starts == {first: 0, second: 4}
    assert {one.record: one.current for one in docked.curves} == {first: False, second: True}
    docked.head.from_zero.trigger()
    assert [one.start[0] for one in docked.curves] == [0, 0]
    slots = {one.record: one.slot for one in docked.curves}
    window.session.timeline.delete(first)
    window.refresh()
    assert [one.record for one in docked.curves] == [second]
    third = run(window, qtbot, "getme", 2)
    assert {one.record: one.slot for one in docked.curves} == {second: slots[second], third: slots[first]}
    docked.runs.setCurrentRow(1)
    QTest.keyClick(docked.runs, Qt.Key.Key_Space)
    assert [one.shown for one in docked.curves] == [True, False]


@pytest.mark.slow
def test_charts_are_redrawn_during_a_run_by_a_timer(window, qtbot, docked):
    drawn = []
    original = docked.set_curves
    docked.set_curves = lambda curves: (drawn.append(len(curves[0].rows) if curves else 0), original(curves))
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
