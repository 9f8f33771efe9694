"""Results of all runs in a table of dots."""

import numpy as np
import pytest
from PySide6.QtCore import QRectF, Qt
from PySide6.QtTest import QTest

from hexmend import METHODS, StoppingCriteria
from hexmend_app.features.runs.run_table import FIRST, NAME, QUANTITIES, SETTINGS, RunRow, RunTable
from hexmend_app.features.runs.runs_panel import axis_of, place
from hexmend_app.state.mesh.document import State
from hexmend_app.state.run.run_controller import Phase
from hexmend_app.theme.palette import BLUE, MUTED
from tests.app.driving import phase
from tests.core.grids import displaced

GIVEN = {"inverted": 0, "invalid": 0, "q_min": 0.4, "q_mean": 0.89, "scaled_jacobian_min": 0.2}
ROW_HELP = "Every other result is worse in at least one key figure."


def run(window, qtbot, name, stop, **values):
    """Run a method from the mesh at the start."""
    window.session.commands.reset()
    window.session.run.start(METHODS[name](**values), stop)
    qtbot.waitUntil(phase(window, Phase.FINISHED))
    return window.session.timeline.record


@pytest.fixture
def three(window, qtbot):
    """Run three methods, of which the second is as good as the first in no figure, and show the panel."""
    records = [
        run(window, qtbot, "local-sd", StoppingCriteria(max_iterations=8)),
        run(window, qtbot, "local-sd", StoppingCriteria(max_iterations=1), p=4),
        run(window, qtbot, "laplacian", StoppingCriteria(max_iterations=3, keep_last=True)),
    ]
    window.show_panel("runs")
    window.refresh()
    return records


def panel(window):
    return window.features["runs"].panel


def texts(window, column):
    model = panel(window).model
    return [model.index(row, column).data() for row in range(model.rowCount())]


def click(window, row):
    table = panel(window).table
    at = table.visualRect(panel(window).model.index(row, NAME)).center()
    QTest.mouseClick(table.viewport(), Qt.MouseButton.LeftButton, pos=at)
    window.refresh()


@pytest.mark.slow
def test_all_runs_are_listed_beside_the_mesh_at_the_start(window, three):
    assert texts(window, NAME) == ["At the start", *(record.name for record in three)]
    assert texts(window, SETTINGS) == [
        "",
        "max_iterations=8",
        "p=4, max_iterations=1",
        "max_iterations=3, keep_last=True",
    ]
    start = window.session.document.start.summary
    for column, quantity in enumerate(QUANTITIES, FIRST):
        summaries = [start, *(record.end.summary for record in three)]
        values = [getattr(summary, quantity.key) for summary in summaries]
        rows = panel(window).model.rows
        assert [row.figures[quantity.key] for row in rows] == values
        assert texts(window, column)[0] == texts(window, column)[0].strip() != ""


@pytest.mark.slow
def test_dominated_runs_are_grey_and_say_which_are_as_good(window, three):
    rows = panel(window).model.rows
    assert three[0].name in rows[2].dominated_by
    assert not rows[1].dominated_by
    index = panel(window).model.index
    assert index(2, NAME).data(Qt.ItemDataRole.ForegroundRole).color().name() == str(MUTED)
    assert three[0].name in index(2, NAME).data(Qt.ItemDataRole.ToolTipRole)
    assert index(2, NAME).data(Qt.ItemDataRole.AccessibleTextRole) == f"{three[1].name}, dominated"
    assert ROW_HELP in index(1, NAME).data(Qt.ItemDataRole.ToolTipRole)


def test_a_click_shows_the_result_of_a_run(window, three):
    timeline = window.session.timeline
    click(window, 1)
    assert (timeline.shown_iteration.record, timeline.shown_iteration.number) == (three[0], three[0].result)
    click(window, 3)
    assert timeline.shown_iteration.record is three[2]
    assert panel(window).table.currentIndex().row() == 3
    click(window, 0)
    now = window.session.document.now
    assert now.mesh.points is window.session.document.start.mesh.points
    QTest.keyClick(panel(window).table, Qt.Key.Key_Down)
    QTest.keyClick(panel(window).table, Qt.Key.Key_Return)
    assert timeline.shown_iteration.record is three[0]


@pytest.mark.slow
def test_a_click_shows_the_mesh_at_the_start_even_if_no_run_began_there(window, qtbot):
    session = window.session
    start = session.document.start
    moved = displaced(start.mesh, np.flatnonzero(start.mesh.free)[0], 1e-3)
    session.commands.adopt_positions("move a node", State.of(moved))
    session.run.start(METHODS["local-sd"](), StoppingCriteria(max_iterations=2))
    qtbot.waitUntil(phase(window, Phase.FINISHED))
    window.show_panel("runs")
    window.refresh()
    click(window, 0)
    assert session.document.now is start
    assert panel(window).table.currentIndex().row() == 0
    click(window, 1)
    session.commands.tag("new", [1])
    click(window, 0)
    assert session.document.now.mesh.points is start.mesh.points
    assert session.document.now.mesh.hex_sets["new"].tolist() == [1]
    click(window, 1)
    assert session.timeline.shown_iteration.number == session.timeline.record.result


def test_the_dots_are_between_the_smallest_and_the_largest_value():
    model = RunTable()
    model.fill(
        [
            RunRow(None, "start", "", GIVEN, MUTED),
            *(RunRow(object(), "", "", GIVEN | {"q_min": q}, BLUE) for q in (0.3, 0.5)),
        ]
    )
    axis = axis_of(QRectF(0, 0, 160, 20))
    column = FIRST + [one.key for one in QUANTITIES].index("q_min")
    places = [place(model, row, column, axis) for row in range(3)]
    assert places[1:] == [axis.left(), axis.right()]
    assert places[0] == pytest.approx(axis.center().x())


def test_a_dominated_run_does_not_stretch_the_axis():
    model, axis = RunTable(), axis_of(QRectF(0, 0, 160, 20))
    column = FIRST + [one.key for one in QUANTITIES].index("q_min")
    best = RunRow(object(), "good", "", GIVEN | {"q_min": 0.5}, BLUE)
    worst = RunRow(object(), "bad", "", GIVEN | {"q_min": 0.0}, BLUE, dominated_by=("good",))
    model.fill([RunRow(None, "start", "", GIVEN, MUTED), best, worst])
    assert model.range_of("q_min") == (0.4, 0.5)
    assert [place(model, row, column, axis) for row in range(3)] == [axis.left(), axis.right(), axis.left()]
