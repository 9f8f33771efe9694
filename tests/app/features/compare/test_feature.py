"""Comparisons in the window, by mouse and keys: the table."""

from threading import Event

import numpy as np
import pytest
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QLabel

from hexmend import METHODS, compare
from hexmend_app.features.compare.comparison_table import ComparisonModel, ComparisonRow
from tests.app.driving import LEFT, choose, key, named, press
from tests.app.features.compare.table import (
    COLUMN,
    ENDLESS,
    SHORT,
    button,
    choose_methods,
    model,
    row,
    table_of,
)
from tests.patience import PATIENCE


@pytest.mark.slow
def test_the_table_has_the_values_of_the_core_and_the_mesh_does_not_change(compared):
    before = compared.session.document.start.mesh
    assert compared.session.document.now.mesh is before
    expected = compare(before, ["getme", "laplacian", "local-sd"], SHORT)
    for one in expected.rows:
        record = model(compared).rows[row(compared, one.method)].record
        assert record["q_min"] == one.after.q_min
        assert record["inverted"] == one.after.inverted
        assert record["iterations"] == 4
    assert [one.name for one in model(compared).rows[:4]] == ["initial", "getme", "laplacian", "local-sd"]
    corner = compared.statusBar()
    assert named(corner, QLabel, "Counts").isVisible()  # the table does not cover the counts
    best = min(expected.rows, key=lambda one: one.after.inverted).method
    cell = model(compared).index(row(compared, best), COLUMN["inverted"])
    assert cell.data(Qt.ItemDataRole.FontRole).bold()
    assert cell.data(Qt.ItemDataRole.AccessibleTextRole).endswith("best")


@pytest.mark.slow
def test_cancel_stops_after_the_current_iteration_and_keeps_the_results(comparing, qtbot, monkeypatch):
    reached, resume = Event(), Event()
    steps = METHODS["local-sd"].steps

    def paused(self, mesh):
        for number, step in enumerate(steps(self, mesh)):  # number 0 is the initial mesh
            if number == 3:
                reached.set()
                assert resume.wait(PATIENCE / 1000)
            yield step

    monkeypatch.setattr(METHODS["local-sd"], "steps", paused)
    comparison = comparing.session.comparison
    choose(comparing, "mend", ENDLESS)
    choose_methods(comparing, "local-sd", "mend")
    press(button(comparing, "Run comparison"))
    qtbot.waitUntil(reached.is_set)
    comparing.refresh()
    enabled = comparing.window_actions["compare"].isEnabled()
    press(button(comparing, "Cancel comparison"))
    status = named(comparing.features["compare"].panel, QLabel, "Comparison progress")
    ending = status.text()
    resume.set()
    assert not enabled
    assert ending == f"Stopping {METHODS['local-sd'].title} after this iteration…"
    qtbot.waitUntil(lambda: not comparison.busy)
    (one,) = comparison.results
    assert one.row.outcome == "stopped"
    assert one.row.iterations == 3
    assert comparison.interrupted
    comparing.refresh()
    assert "interrupted" in status.text()
    assert comparing.window_actions["compare"].isEnabled()


def test_a_result_replaces_the_mesh_and_can_be_undone(compared):
    before = compared.session.document.now.mesh
    assert not button(compared, "Use result").isEnabled()
    index = model(compared).index(row(compared, "laplacian"), COLUMN["inverted"])
    table = table_of(compared)
    QTest.mouseClick(table.viewport(), LEFT, pos=table.visualRect(index).center())
    press(button(compared, "Use result"))
    taken = compared.session.comparison.of("laplacian").state
    np.testing.assert_array_equal(compared.session.document.now.mesh.points, taken.mesh.points)
    assert compared.session.document.undo_title == METHODS["laplacian"].title
    key(compared, Qt.Key.Key_Z, Qt.KeyboardModifier.ControlModifier)
    assert compared.session.document.now.mesh is before


def test_a_column_has_one_number_of_decimals_and_equal_texts_are_marked_alike():
    rows = [
        ComparisonRow(name, "", {"seconds": seconds, "q_min": q, "scaled_jacobian_min": -0.5, "iterations": 9})
        for name, seconds, q in (("laplacian", 0.0123, 0.30001), ("getme", 19.522, 0.3), ("local-sd", 1.0, 0.1))
    ]
    table = ComparisonModel([])
    table.fill(rows, full=False, busy=False)
    texts = {
        one.name: [table.index(at, COLUMN[key]).data() for key in ("seconds", "q_min", "scaled_jacobian_min")]
        for at, one in enumerate(table.rows)
    }
    assert texts == {
        "laplacian": ["0.012", "0.3000", "−0.5000"],
        "getme": ["19.522", "0.3000", "−0.5000"],
        "local-sd": ["1.000", "0.1000", "−0.5000"],
    }
    bold = {
        one.name
        for at, one in enumerate(table.rows)
        if table.index(at, COLUMN["q_min"]).data(Qt.ItemDataRole.FontRole) is not None
    }
    assert bold == {"laplacian", "getme"}
