"""The table of figures."""

import dataclasses
from types import SimpleNamespace

import pytest
from PySide6.QtCore import Qt
from PySide6.QtGui import QColor, QGuiApplication
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QMenu, QTableWidget

from hexmend.quality.summary import Summary
from hexmend_app.features.quality.statistics import ROWS, StatisticsTable, change
from hexmend_app.theme.style import BETTER, MUTED, WORSE
from tests.app.driving import named

_START = {
    "hexes": 32735,
    "nodes": 37473,
    "free_nodes": 28317,
    "inverted": 36,
    "locked_inverted": 0,
    "q_min": 0.0123456789,
    "q_mean": 0.85,
    "q_max": 0.99,
    "q_std": 0.1,
    "q_norm": 0.0,
    "scaled_jacobian_min": -0.5,
    "objective": None,
}
_NOW = _START | {
    "inverted": 0,
    "q_min": 0.5,
    "q_mean": 0.8,
    "q_norm": 0.7,
    "q_std": 0.05,
    "scaled_jacobian_min": 0.3,
    "objective": 9.5,
}
_AT = {row.key: at for at, row in enumerate(ROWS)}


@pytest.fixture
def table(shown):
    widget = shown(StatisticsTable())
    widget.set_summaries(SimpleNamespace(**_START), SimpleNamespace(**_NOW))
    return widget


def grid(table):
    return named(table, QTableWidget, "Statistics of the mesh")


def cell(table, key, column):
    return grid(table).item(_AT[key], column)


def test_what_analysts_judge_by_stands_out_where_it_is_worse(table):
    table.set_summaries(SimpleNamespace(**_NOW), SimpleNamespace(**_START))
    bold = {key for key in _AT if cell(table, key, 3).font().bold()}
    assert bold == {"inverted", "q_min", "scaled_jacobian_min"}
    for key in bold:
        assert cell(table, key, 3).foreground().color() == QColor(str(WORSE))
        assert cell(table, key, 3).data(Qt.ItemDataRole.AccessibleTextRole).endswith("worse")
    table.set_summaries(SimpleNamespace(**_START), SimpleNamespace(**_NOW))
    assert not any(cell(table, key, 3).font().bold() for key in _AT)


def test_every_figure_of_a_summary_but_the_trivial_has_a_row():
    assert {row.key for row in ROWS} == {field.name for field in dataclasses.fields(Summary)} - {"q_max"}


def test_figures_are_right_aligned_with_what_they_were_and_are(table):
    assert [cell(table, "inverted", column).text() for column in range(4)] == ["Inverted", "36", "0", "▼ 36"]
    assert cell(table, "hexes", 1).text() == "32,735"
    assert cell(table, "objective", 1).text() == "–"
    for key in _AT:
        assert all(cell(table, key, c).textAlignment() & Qt.AlignmentFlag.AlignRight for c in (1, 2, 3))


@pytest.mark.parametrize(
    ("key", "colour"),
    [("inverted", BETTER), ("q_min", BETTER), ("q_mean", WORSE), ("q_std", MUTED), ("hexes", MUTED)]
    + [("objective", BETTER), ("scaled_jacobian_min", BETTER)],
)
def test_changes_have_the_colour_of_their_sense(table, key, colour):
    assert cell(table, key, 3).foreground().color() == QColor(str(colour))


@pytest.mark.parametrize("row", [row for row in ROWS if row.better])
def test_the_reverse_of_a_change_has_the_reverse_sense_and_arrow(row):
    there, back = change(row, 0.25, 0.5), change(row, 0.5, 0.25)
    assert there == ("▲ 0.2500", row.better)
    assert back == ("▼ 0.2500", -row.better)
    assert change(row, 0.5, 0.5) == ("=", 0)
    assert change(row, 0.5, 0.5 + 1e-9)[0] == "▲ <0.0001"


def test_every_row_explains_itself(table):
    for row in ROWS:
        assert row.help in cell(table, row.key, 0).toolTip()
    assert "infinite" in cell(table, "objective", 1).toolTip()


def test_control_c_copies_full_precision_for_a_spreadsheet(table):
    grid(table).setFocus()
    QTest.keyClick(grid(table), Qt.Key.Key_C, Qt.KeyboardModifier.ControlModifier)
    lines = [line.split("\t") for line in QGuiApplication.clipboard().text().splitlines()]
    assert len(lines) == len(ROWS) + 1
    assert all(len(line) == 3 for line in lines)
    by_title = {line[0]: line[1:] for line in lines}
    assert by_title["q min"] == ["0.0123456789", "0.5"]
    assert by_title["Hexes"] == ["32735", "32735"]
    assert by_title["Objective Σ η²"] == ["", "9.5"]


def test_the_context_menu_copies(table, qtbot):
    QGuiApplication.clipboard().setText("before")
    grid(table).customContextMenuRequested.emit(grid(table).viewport().rect().center())
    menu = QApplication.activePopupWidget()
    assert isinstance(menu, QMenu)
    QTest.keyClick(menu, Qt.Key.Key_Down)
    QTest.keyClick(menu, Qt.Key.Key_Return)
    qtbot.waitUntil(lambda: QGuiApplication.clipboard().text() == table.text())


def test_nothing_is_cut_off_in_a_narrow_panel(table):
    assert table.sizeHint().width() <= 360
    table.resize(table.sizeHint())
    view = grid(table)
    for at in range(view.rowCount()):
        for column in range(view.columnCount()):
            need = view.fontMetrics().horizontalAdvance(view.item(at, column).text())
            assert need < view.columnWidth(column)
    assert view.verticalScrollBar().maximum() == view.horizontalScrollBar().maximum() == 0


def test_no_mesh_clears_the_figures(table):
    table.set_summaries(None, None)
    assert all(cell(table, key, column).text() == "" for key in _AT for column in (1, 2, 3))


@pytest.fixture
def tangled(table):
    """The table with inverted elements now, and what it asked for."""
    table.set_summaries(SimpleNamespace(**_START), SimpleNamespace(**_NOW | {"inverted": 12, "locked_inverted": 3}))
    asked = []
    table.isolate_requested.connect(asked.append)
    return table, asked


def click(table, key, column):
    place = grid(table).visualItemRect(cell(table, key, column)).center()
    QTest.mouseMove(grid(table).viewport(), place)
    QTest.mouseClick(grid(table).viewport(), Qt.MouseButton.LeftButton, pos=place)


def test_the_numbers_of_inverted_and_locked_elements_are_links(tangled):
    table, asked = tangled
    for key in ("inverted", "locked_inverted", "hexes"):
        click(table, key, 2)
    click(table, "inverted", 1)  # at the start, of which there is no picture
    assert asked == ["inverted", "locked"]
    assert cell(table, "inverted", 2).font().underline()
    assert "Show only the locked hexes" in cell(table, "locked_inverted", 2).toolTip()


def test_links_are_reached_by_keys(tangled):
    table, asked = tangled
    grid(table).setFocus()
    grid(table).setCurrentCell(_AT["inverted"], 0)
    QTest.keyClick(grid(table), Qt.Key.Key_Return)
    QTest.keyClick(grid(table), Qt.Key.Key_Down)
    QTest.keyClick(grid(table), Qt.Key.Key_Enter)
    QTest.keyClick(grid(table), Qt.Key.Key_Down)
    QTest.keyClick(grid(table), Qt.Key.Key_Enter)
    assert asked == ["inverted", "locked"]


def test_where_there_are_none_there_is_no_link(tangled):
    table, asked = tangled
    table.set_summaries(SimpleNamespace(**_START), SimpleNamespace(**_NOW))
    click(table, "inverted", 2)
    grid(table).setCurrentCell(_AT["inverted"], 0)
    QTest.keyClick(grid(table), Qt.Key.Key_Return)
    assert asked == []
    assert not cell(table, "inverted", 2).font().underline()
    assert "determinant" in cell(table, "inverted", 2).toolTip()
