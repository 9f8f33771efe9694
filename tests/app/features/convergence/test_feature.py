"""Convergence charts in the window."""

from __future__ import annotations

import csv

import pytest
from PySide6.QtCore import QPointF, Qt
from PySide6.QtTest import QTest

from benchmarks.window.windows import end_run
from hexmend.run import StoppingCriteria
from hexmend_app.state.run.run_controller import Phase
from tests.app.driving import LEFT, choose, click, phase, press
from tests.patience import PATIENCE


@pytest.fixture
def panel(window, qtbot):
    window.show_panel("convergence")
    qtbot.waitUntil(window.features["convergence"].panel.isVisible, timeout=PATIENCE)
    return window.features["convergence"].panel


def run(window, qtbot, method="local-sd", iterations=8):
    choose(window, method, StoppingCriteria(max_iterations=iterations, tolerance=0))
    with qtbot.waitSignal(window.session.run.ended, timeout=PATIENCE):
        click(window, "Run")
    window.refresh()
    return window.session.run.record


def click_at(panel, key, x):
    plot = panel.plots[key]
    at = plot.plot.mapFromScene(plot.view.mapViewToScene(QPointF(x, sum(plot.view.viewRange()[1]) / 2)))
    QTest.mouseClick(plot.plot.viewport(), LEFT, Qt.KeyboardModifier.NoModifier, at)


def test_a_click_in_a_chart_selects_the_iteration_and_moves_the_marker(window, qtbot, panel):
    record = run(window, qtbot)
    assert len(panel.curves[0].columns) == 9
    click_at(panel, "inverted", 3)
    qtbot.waitUntil(lambda: window.session.timeline.shown_iteration.number == 3, timeout=PATIENCE)
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
    click(window, "Run")
    qtbot.waitUntil(phase(window, Phase.RUNNING), timeout=PATIENCE)
    qtbot.waitUntil(lambda: len(drawn) > 0, timeout=PATIENCE)
    drawn.clear()
    for _ in range(20):
        window.refresh()
    assert len(drawn) <= 1
    qtbot.waitUntil(lambda: len(drawn) >= 6, timeout=PATIENCE)
    assert drawn == sorted(drawn)
    assert drawn[-1] > drawn[0]
    end_run(window.session)
    qtbot.waitUntil(lambda: drawn[-1] == window.session.run.record.newest + 1, timeout=PATIENCE)


@pytest.mark.slow
def test_charts_are_saved_as_figures_and_values_of_all_runs_as_a_table(window, qtbot, panel, tmp_path):
    first = run(window, qtbot, "mend", 5)
    window.session.timeline.go(first, 2)
    second = run(window, qtbot, "laplacian", 3)
    panel.legend.toggled.emit(second, False)
    for kind, start in (("svg", b"<?xml"), ("pdf", b"%PDF"), ("png", b"\x89PNG")):
        path = tmp_path / f"charts.{kind}"
        assert window.features["convergence"].save(path)
        assert path.read_bytes().startswith(start)
    assert window.features["convergence"].save(tmp_path / "charts.csv")
    rows = list(csv.DictReader((tmp_path / "charts.csv").read_text().splitlines()))
    assert len(rows) == len(first.rows) + len(second.rows)
    assert float(rows[1]["gradient_norm"]) == first.rows[1]["gradient_norm"]
    assert rows[-1]["run"] == second.name
    assert rows[-1]["branch_of"] == f"{first.name} 2"
    assert rows[-1]["gradient_norm"] == ""
    assert not window.features["convergence"].save(tmp_path / "charts.xls")
    assert "Use .svg, .pdf, .png or .csv." in window.messages.messages()[-1][2]
